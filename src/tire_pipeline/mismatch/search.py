"""The search: screen all effects, refit the best sets jointly, accept only what passes every gate."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import combinations
from typing import Any

import numpy as np
from scipy.stats import wilcoxon

from tire_pipeline.mismatch import settings
from tire_pipeline.mismatch.blocks import sweeps
from tire_pipeline.mismatch.candidates import Variant, screening_columns, variants
from tire_pipeline.mismatch.data import Data
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.gram import System
from tire_pipeline.mismatch.noise import Noise, estimate_noise, refined
from tire_pipeline.mismatch.nuisance import largest_force, make_nuisance
from tire_pipeline.mismatch.refit import Fit, objective, refit, residual
from tire_pipeline.mismatch.simulate import Change, simulate

Array = np.ndarray


@dataclass(frozen=True)
class Gates:
    """What one effect of a set has to show for itself.

    Parameters
    ----------
    gain : float
        Nats by which the set is likelier with it, after the price of its parameters.
    p_value : float
        Wilcoxon over sweeps: held-out error with and without it.
    share : float
        Share of the held-out mismatch that it removes.
    loose, frozen : float
        The gain with coefficients nearly free, and with coefficients frozen.
    in_bounds : bool
    """

    name: str
    gain: float
    p_value: float
    share: float
    loose: float
    frozen: float
    in_bounds: bool
    blocks: int
    least_gain: float

    def why_not(self, level: float) -> str:
        """Return the first gate that is shut, in words."""
        if self.gain <= self.least_gain:
            return "does not pay for itself"
        if self.p_value >= level:
            return f"held-out sweeps are not better with it (p {self.p_value:.2g})"
        if self.share <= settings.LEAST_SHARE:
            return f"removes only {100.0 * self.share:.1f}% of the mismatch"
        if self.loose <= settings.LEAST_GAIN:
            return "a refit of the coefficients explains as much"
        return "its parameters are outside of physical bounds"

    def passed(self, level: float) -> bool:
        """Whether all gates are open."""
        return (
            self.gain > self.least_gain
            and self.p_value < level
            and self.share > settings.LEAST_SHARE
            and self.loose > settings.LEAST_GAIN
            and self.in_bounds
        )


@dataclass
class Search:
    """State of a search over one recording."""

    data: Data
    noise: dict[str, Noise]
    block: Array
    system: System
    loose: System
    inflation: float
    variants: list[Variant]
    absent: dict[str, str]
    largest: dict[str, float]
    misfit: float
    fit: Fit
    frozen: System = None  # type: ignore[assignment]
    columns: dict[str, Array] = field(default_factory=dict)
    sizes: dict[str, tuple[int, int]] = field(default_factory=dict)
    gates: list[Gates] = field(default_factory=list)
    screened: dict[str, float] = field(default_factory=dict)
    refused: dict[str, str] = field(default_factory=dict)
    log: list[str] = field(default_factory=list)

    @property
    def price(self) -> float:
        """Nats that one more parameter costs."""
        rows = self.data.size * len(self.data.outputs)
        return 0.5 * float(np.log(max(rows / self.inflation, 8.0)))


def begin(data: Data) -> Search:
    """Estimate noise and misfit, and set up the sums."""
    rest = {o: data.recorded[o] - data.base[o] for o in data.outputs}
    noise = estimate_noise(data, rest)
    block = sweeps(data)
    found, absent = variants(data)
    search = Search(
        data=data,
        noise=noise,
        block=block,
        system=None,  # type: ignore[arg-type]
        loose=None,  # type: ignore[arg-type]
        inflation=1.0,
        variants=found,
        absent=absent,
        largest={o: largest_force(data, o) for o in data.outputs},
        misfit=settings.MISFIT_SHARES[-1],
        fit=Fit([], []),
    )
    _assemble(search)
    return search


def _assemble(search: Search) -> None:
    """Build the nuisance columns, and the system with noise estimated without what they explain."""
    data = search.data
    nuisance = make_nuisance(data)
    search.columns = {o: np.hstack([nuisance.coefficients[o], nuisance.flexible[o]]) for o in data.outputs}
    search.sizes = {
        o: (nuisance.coefficients[o].shape[1], nuisance.flexible[o].shape[1]) for o in data.outputs
    }
    _weigh(search)
    renoise(search, search.fit)


def _scale(search: Search, share: float, factor: float = 1.0) -> dict[str, Array]:
    """Prior standard deviations of the nuisance columns for a size of the flexible form."""
    move = factor * max(settings.COEFFICIENT_SHARE, settings.COEFFICIENT_PART * share)
    return {o: np.r_[np.full(c, move), np.full(m, share)] for o, (c, m) in search.sizes.items()}


def _weigh(search: Search) -> None:
    """Whiten by the noise as it is known now."""
    start = _scale(search, settings.MISFIT_SHARES[0])
    search.system = System(search.data, search.noise, search.block, search.columns, start)
    rescale(search)


def renoise(search: Search, fit: Fit) -> None:
    """Estimate the noise again from what a fit and the nuisance leave: what they explain is not noise."""
    rest = residual(search.data, fit.changes)
    c = search.loose.fitted(rest, fit.columns if fit.labels else None)
    calm = {o: r - search.columns[o] @ c[o] for o, r in rest.items()}
    first = estimate_noise(search.data, calm)
    search.noise = {o: refined(search.data, n, calm[o]) for o, n in first.items()}
    _weigh(search)


def rescale(search: Search) -> None:
    """Take the likeliest size of the flexible form for what the accepted effects leave."""
    base = search.system
    sums = base.sums(residual(search.data, search.fit.changes))
    best = (-np.inf, settings.MISFIT_SHARES[0])
    for share in settings.MISFIT_SHARES:
        trial = base.rescaled(_scale(search, share))
        _, _, left = trial.reduce(sums)
        value = -0.5 * left / search.inflation - 0.5 * trial.log_determinant()
        best = max(best, (value, share))
    search.misfit = best[1]
    search.system = base.rescaled(_scale(search, best[1]))
    search.loose = base.rescaled(_scale(search, max(best[1], 0.009), settings.LOOSE))
    search.frozen = base.rescaled(_scale(search, best[1], 1e-3))
    search.inflation = _inflation(search)


def _inflation(search: Search) -> float:
    """How many whitened samples make one independent one: size and colour that the noise model missed."""
    left = search.loose.left(residual(search.data, search.fit.changes), search.fit.columns or None)
    total, weight = 0.0, 0.0
    for white in left.values():
        size = float(np.median(white**2) / 0.4549)
        x = np.clip(white, -4.0 * np.sqrt(size), 4.0 * np.sqrt(size))
        colour = 1.0
        if search.data.time is not None:
            lags = [float(np.mean(x[k:] * x[:-k])) / max(float(np.mean(x**2)), 1e-12) for k in range(1, 13)]
            for value in lags:
                if value < 0.02:
                    break
                colour += 2.0 * value
        total += max(size, 0.5) * colour
        weight += 1.0
    return float(np.clip(total / weight, 1.0, 25.0))


def screen(search: Search, extra: System | None = None) -> list[tuple[float, Variant]]:
    """Score each form against what the accepted effects leave: nats after the price of its parameters."""
    system = extra or search.system
    rest = residual(search.data, search.fit.changes)
    own = search.fit.columns if search.fit.labels else None
    out = []
    for v in search.variants:
        if v.name in search.fit.names:
            continue
        columns = screening_columns(search.data, search.fit.changes, v)
        if columns[search.data.outputs[0]].shape[1] == 0:
            continue
        joined = columns if own is None else {o: np.hstack([own[o], columns[o]]) for o in columns}
        skip = 0 if own is None else own[search.data.outputs[0]].shape[1]
        info, score, _ = system.reduce(system.sums(rest, joined))
        gain = best_gain(info, score, skip, search)
        out.append((gain, v))
    out.sort(key=lambda t: -t[0])
    for gain, v in out:
        search.screened[v.name] = max(search.screened.get(v.name, -np.inf), gain)
    return out


def best_gain(info: Array, score: Array, skip: int, search: Search) -> float:
    """Return the best gain over nested choices of the columns after the first ``skip``."""
    k = score.size
    if skip:
        head = info[:skip, :skip] + 1e-9 * np.diag(np.diag(info)[:skip]) + 1e-12 * np.eye(skip)
        solved = np.linalg.solve(head, np.column_stack([info[:skip, skip:], score[:skip]]))
        score = score[skip:] - info[skip:, :skip] @ solved[:, -1]
        info = info[skip:, skip:] - info[skip:, :skip] @ solved[:, :-1]
        k -= skip
    size = np.sqrt(np.maximum(np.diag(info), 0.0))
    live = np.flatnonzero(size > 1e-3)
    if live.size == 0:
        return -np.inf
    m = info[np.ix_(live, live)] / size[live][:, None] / size[live][None, :]
    s = score[live] / size[live]
    chosen: list[int] = []
    best, quality = -np.inf, 0.0
    for _ in range(live.size):
        trials = []
        for j in range(live.size):
            if j in chosen:
                continue
            c = [*chosen, j]
            sub = m[np.ix_(c, c)] + 1e-6 * np.eye(len(c))
            trials.append((float(s[c] @ np.linalg.solve(sub, s[c])), j))
        quality, j = max(trials)
        chosen.append(j)
        best = max(best, 0.5 * quality / search.inflation - search.price * len(chosen))
    return best


def gain_of(search: Search, fit: Fit, against: float) -> float:
    """Nats by which a fit is likelier than an objective without its effects, parameters paid."""
    return 0.5 * (against - fit.objective) / search.inflation - search.price * fit.parameters


def prune(search: Search, fit: Fit) -> Fit:
    """Drop parameters that do not pay for themselves, smallest t first."""
    for _ in range(8):
        if not fit.labels or fit.sums is None:
            return fit
        t2 = []
        for row, (i, name) in enumerate(fit.labels):
            effect = catalogue()[fit.changes[i][0]]
            zero = effect.zeros(search.data)[name]
            variance = max(float(fit.covariance[row, row]), 1e-300)
            t2.append((fit.changes[i][1][name] - zero) ** 2 / variance / search.inflation)
        order = np.argsort(t2)
        dropped = False
        for row in order:
            i, name = fit.labels[row]
            if len(fit.free[i]) < 2 or name in {"reference", "lag", "moment", "length", "radius"}:
                continue
            if name in catalogue()[fit.names[i]].needed:
                continue
            if (fit.names[i] == "combined_slip" and zero_of(search, fit, i, name) == 0.0) or t2[
                row
            ] > 2.0 * search.price:
                continue
            changes = [(n, dict(p)) for n, p in fit.changes]
            changes[i][1][name] = catalogue()[changes[i][0]].zeros(search.data)[name]
            free = [tuple(f for f in fs if (j, f) != (i, name)) for j, fs in enumerate(fit.free)]
            shorter = [Variant(n, p, f) for (n, p), f in zip(changes, free, strict=True)]
            trial = refit(search.system, shorter, steps=2, start=changes)
            if 0.5 * (trial.objective - fit.objective) / search.inflation < search.price:
                fit, dropped = trial, True
                break
        if not dropped:
            return fit
    return fit


def zero_of(search: Search, fit: Fit, index: int, name: str) -> float:
    """Return the value of a parameter at which its effect is absent."""
    return catalogue()[fit.names[index]].zeros(search.data)[name]


def shape_columns(data: Data, changes: Sequence[Change], index: int) -> dict[str, Array]:
    """Columns for what the form of an accepted effect may get wrong: its own part times own inputs."""
    whole = simulate(data, changes)
    without = simulate(data, [c for j, c in enumerate(changes) if j != index])
    load = data.load_excess(data.get("normal_load"))
    load = load / max(float(np.max(np.abs(load))), 1e-9)
    out = {}
    for o in data.outputs:
        part = whole[o] - without[o]
        slip = np.abs(data.get("slip_angle" if o == "fy" else "slip_ratio"))
        use = slip / (slip + max(float(np.quantile(slip, 0.9)) / 3.0, 1e-6))
        use = 2.0 * use / max(float(use.max()), 1e-9) - 1.0
        columns = [part * use, part * load, part * (2.0 * use**2 - 1.0), part * use * load, part]
        if catalogue()[changes[index][0]].dynamic:
            shift = 0.5 / settings.SHAPE_SHARE
            columns += [shift * _change(data, whole[o]), shift * _change(data, part)]
        out[o] = np.column_stack(columns)
    return out


def _change(data: Data, x: Array) -> Array:
    """Change of a force over one sample: what half a sample of time shift could do, twice."""
    d = np.zeros_like(x)
    d[1:-1] = 0.5 * (x[2:] - x[:-2])
    d[data.start] = 0.0
    d[np.flatnonzero(data.start)[1:] - 1] = 0.0
    return d


def with_shapes(search: Search, system: System, changes: Sequence[Change], skip: int | None = None) -> System:
    """Extend a system by the shape columns of the effects, but not of number ``skip``."""
    parts = [shape_columns(search.data, changes, i) for i in range(len(changes)) if i != skip]
    if not parts:
        return system
    columns = {o: np.hstack([p[o] for p in parts]) for o in search.data.outputs}
    scale = {o: np.full(c.shape[1], settings.SHAPE_SHARE) for o, c in columns.items()}
    return system.extended(columns, scale)


def gates_of(search: Search, fit: Fit) -> list[Gates]:
    """Judge each effect of a set: the set with it against the set without it, refitted."""
    out = []
    rest = residual(search.data, fit.changes)
    total = _mismatch(search, residual(search.data, []))
    for i, name in enumerate(fit.names):
        others = [
            Variant(n, p, f)
            for j, ((n, p), f) in enumerate(zip(fit.changes, fit.free, strict=True))
            if j != i
        ]
        start = [c for j, c in enumerate(fit.changes) if j != i]
        system = with_shapes(search, search.system, fit.changes, i)
        loose = with_shapes(search, search.loose, fit.changes, i)
        frozen = with_shapes(search, search.frozen, fit.changes, i)
        count = len(fit.free[i]) + (name == "nonuniformity")
        reduced = refit(search.system, others, steps=3, start=start) if others else Fit([], [])
        rest_without = residual(search.data, reduced.changes)
        gains = []
        for s in (system, loose, frozen):
            with_it = s.reduce(s.sums(rest, fit.columns if fit.labels else None))
            without = s.reduce(s.sums(rest_without, reduced.columns if reduced.labels else None))
            gain = 0.5 * (_best(without) - _best(with_it)) / search.inflation - search.price * count
            gains.append(float(gain))
        own = catalogue()[name].own_inputs or (name == "camber" and search.data.knows_camber)
        judge = frozen
        shown = _shown(search, fit, i)
        before, first = judge.held_out(rest_without, reduced.columns if reduced.labels else None, shown)
        _after, second = judge.held_out(rest, fit.columns if fit.labels else None, shown)
        out.append(
            Gates(
                name=name,
                gain=gains[0],
                p_value=_wilcoxon(first, second),
                share=(_mismatch(search, rest_without) - _mismatch(search, rest)) / max(total, 1e-12),
                loose=gains[0] if own else gains[1],
                frozen=gains[2],
                in_bounds=not fit.at_bound,
                blocks=before.size,
                least_gain=settings.LEAST_GAIN if len(fit.names) == 1 else settings.LEAST_GAIN_MORE,
            )
        )
    return out


def _mismatch(search: Search, rest: dict[str, Array]) -> float:
    """Mean square of a residual over the noise, outputs added."""
    return float(sum(np.mean(r**2) / search.noise[o].floor ** 2 for o, r in rest.items()))


def _shown(search: Search, fit: Fit, index: int) -> Array:
    """Return the sweeps in which an effect shows: by what it does in the fit, not by how well it does it."""
    whole = simulate(search.data, fit.changes)
    without = simulate(search.data, [c for j, c in enumerate(fit.changes) if j != index])
    energy = np.zeros(search.system.count)
    for o in search.data.outputs:
        part = (whole[o] - without[o]) / search.noise[o].sigma
        energy += np.bincount(search.block, part**2, search.system.count)
    shown = energy > 0.1 * np.mean(energy)
    return np.flatnonzero(shown)


def _best(reduced: tuple[Array, Array, float]) -> float:
    info, score, left = reduced
    if score.size == 0:
        return left
    return left - float(score @ np.linalg.lstsq(info, score, rcond=1e-12)[0])


def _wilcoxon(before: Array, after: Array) -> float:
    d = before - after
    if d.size < 5 or np.all(d == 0.0):
        return 1.0
    return float(wilcoxon(d, alternative="greater").pvalue)


def _accepted(search: Search, fit: Fit) -> tuple[bool, list[Gates]]:
    """Whether all effects of a set pass, Holm-corrected."""
    gates = gates_of(search, fit)
    count = len({v.name for v in search.variants})
    ordered = sorted(g.p_value for g in gates)
    levels = {p: settings.LEVEL / max(count - k, 1) for k, p in enumerate(ordered)}
    return all(g.passed(levels[g.p_value]) for g in gates), gates


def run(search: Search) -> None:
    """Find the effects; the result is in ``search.fit`` and ``search.gates``."""
    empty = objective(search.system, [])
    for _ in range(settings.MOST_EFFECTS):
        extra = with_shapes(search, search.system, search.fit.changes) if search.fit.changes else None
        ranked = screen(search, extra)
        search.log.append("screen: " + ", ".join(f"{v.name} {g:.0f}" for g, v in ranked[:8]))
        ranked = [(g, v) for g, v in ranked if g > 2.0]
        if not ranked:
            break
        fits = _refined(search, ranked)
        if not fits:
            break
        fits.sort(key=lambda f: -gain_of(search, f, empty))
        search.log.append(
            "refit: " + ", ".join(f"{'+'.join(f.names)} {gain_of(search, f, empty):.0f}" for f in fits[:6])
        )
        if not _take(search, fits) and not _take(search, _pairs(search, fits)):
            break
        rescale(search)
        empty = objective(search.system, [])
        search.fit = _again(search, search.fit)
    _eliminate(search)


def _again(search: Search, fit: Fit) -> Fit:
    forms = [Variant(n, p, f) for (n, p), f in zip(fit.changes, fit.free, strict=True)]
    return refit(search.system, forms, steps=3, start=fit.changes)


def _refined(search: Search, ranked: list[tuple[float, Variant]]) -> list[Fit]:
    """Refit the best forms jointly with the accepted effects; the best pairs too."""
    now = [Variant(n, p, f) for (n, p), f in zip(search.fit.changes, search.fit.free, strict=True)]
    best = ranked[0][0]
    seen: dict[str, int] = {}
    chosen: list[Any] = []
    for gain, v in ranked:
        if gain < 0.25 * best - 5.0 or seen.get(v.name, 0) >= 2 or len(chosen) >= 9:
            continue
        seen[v.name] = seen.get(v.name, 0) + 1
        chosen.append(v)
    fits = []
    for v in chosen:
        fit = refit(search.system, [*now, v], start=[*search.fit.changes, (v.name, v.start)])
        fits.append(prune(search, fit))
    return fits


def _pairs(search: Search, fits: list[Fit]) -> list[Fit]:
    """Refit pairs of the most promising effects: two can mask each other."""
    if len(search.fit.names) + 2 > settings.MOST_EFFECTS:
        return []
    now = [Variant(n, p, f) for (n, p), f in zip(search.fit.changes, search.fit.free, strict=True)]
    best: dict[str, Fit] = {}
    for fit in fits:
        best.setdefault(fit.names[-1], fit)
    out = []
    for first, second in combinations(list(best)[:4], 2):
        forms = [Variant(name, best[name].changes[-1][1], best[name].free[-1]) for name in (first, second)]
        start = [*search.fit.changes, *(best[name].changes[-1] for name in (first, second))]
        out.append(prune(search, refit(search.system, [*now, *forms], start=start)))
    empty = objective(search.system, [])
    out.sort(key=lambda f: -gain_of(search, f, empty))
    search.log.append(
        "pairs: " + ", ".join(f"{'+'.join(f.names)} {gain_of(search, f, empty):.0f}" for f in out[:4])
    )
    return out


def _take(search: Search, fits: list[Fit]) -> bool:
    """Accept the likeliest set that passes all gates; near ties go by the fit with frozen coefficients."""
    empty = objective(search.system, [])
    fits = [f for f in fits if _visible(search, f) and gain_of(search, f, empty) > settings.LEAST_GAIN]
    if not fits:
        return False
    best = gain_of(search, fits[0], empty)
    tied = [f for f in fits if gain_of(search, f, empty) > best - settings.TIE]
    tied.sort(key=lambda f: (_rank(f), objective(search.frozen, f.changes)))
    for tried, fit in enumerate([*tied, *(f for f in fits if all(f is not t for t in tied))]):
        if gain_of(search, fit, empty) < 0.75 * best - settings.TIE or tried >= 4:
            break
        ok, gates = _accepted(search, fit)
        search.log.append(
            "gates: "
            + "; ".join(
                f"{g.name} gain {g.gain:.1f} loose {g.loose:.1f} frozen {g.frozen:.1f} p "
                f"{g.p_value:.1g} share {g.share:.3f}" + ("" if g.in_bounds else " bound")
                for g in gates
            )
        )
        for g in gates:
            if not g.passed(settings.LEVEL):
                search.refused[g.name] = g.why_not(settings.LEVEL)
        if ok:
            search.fit, search.gates = fit, gates
            return True
    return False


def _rank(fit: Fit) -> int:
    """Return how many effects of a set are the less usual of two that look the same."""
    return sum(catalogue()[name].unusual for name in fit.names)


def _visible(search: Search, fit: Fit) -> bool:
    """Whether each effect of a set removes its least share of the mismatch."""
    total = _mismatch(search, residual(search.data, []))
    left = _mismatch(search, residual(search.data, fit.changes))
    for i in range(len(fit.names)):
        without = [c for j, c in enumerate(fit.changes) if j != i]
        if _mismatch(search, residual(search.data, without)) - left < settings.LEAST_SHARE * total:
            return False
    return True


def _eliminate(search: Search) -> None:
    """Backward: drop effects that no longer pass once the others are in."""
    while search.fit.names:
        ok, gates = _accepted(search, search.fit)
        search.gates = gates
        if ok:
            return
        worst = int(np.argmin([g.gain if g.passed(settings.LEVEL) else g.gain - 1e6 for g in gates]))
        forms = [
            Variant(n, p, f)
            for j, ((n, p), f) in enumerate(zip(search.fit.changes, search.fit.free, strict=True))
            if j != worst
        ]
        start = [c for j, c in enumerate(search.fit.changes) if j != worst]
        search.log.append(f"dropped {search.fit.names[worst]}")
        search.fit = refit(search.system, forms, start=start) if forms else Fit([], [])
    search.gates = []
