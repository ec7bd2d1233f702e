"""The gates: what one effect of a set has to show for itself."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy

from tire_pipeline.mismatch import settings
from tire_pipeline.mismatch.discrepancy.gram import System
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.refit import Fit, moved, objective, refit
from tire_pipeline.mismatch.inference.screening import without
from tire_pipeline.mismatch.inference.search_state import Search, noise_beside, of_noise
from tire_pipeline.mismatch.inference.shapes import with_shapes
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray
_PARTS = (1.0, 0.3, 0.1)
"""Parts of a step that are tried."""
_EITHER, _WHOLE, _RATIO = 0.4, 0.1, 0.1
"""Weights of the tests over held-out sweeps: each of the first two, the one with all that may be off, and the
likelihood ratio."""


@dataclass(frozen=True)
class Gates:
    """What one effect of a set has to show for itself.

    Parameters
    ----------
    gain : float
        Log evidence by which the set is likelier with it, after the price of its parameters.
    p_value : float
        Wilcoxon over sweeps: held-out error with and without it.
    share : float
        Share of the mismatch that it removes, the others refitted without it or as they stand.
    loose, frozen : float
        The gain with coefficients nearly free, and with coefficients frozen.
    free : bool
        True if the gain with coefficients nearly free is not asked for.
    in_bounds : bool
    blocks : int
        Number of sweeps.
    least_gain, least_share : float
        What ``gain`` and ``share`` have to exceed.
    least_loose : float
        What ``loose`` has to exceed, unless ``free``.
    """

    name: str
    gain: float
    p_value: float
    share: float
    loose: float
    frozen: float
    free: bool
    in_bounds: bool
    blocks: int
    least_gain: float
    least_share: float
    least_loose: float

    @property
    def explains_most(self) -> bool:
        """Whether it has plain evidence, and most of the mismatch goes with it: without it nothing agrees."""
        return self.gain > settings.REMAINDER_LOG_EVIDENCE and self.share > 0.5

    def why_not(self, level: float) -> str:
        """Return the first gate that is shut, in words."""
        if self.gain <= self.least_gain:
            return "does not pay for itself"
        if self.p_value >= level:
            asked = f"p {self.p_value:.2g} of {self.blocks} sweeps, {level:.2g} is asked for"
            return f"held-out sweeps do not show it surely ({asked})"
        if self.share <= self.least_share:
            return f"removes only {100.0 * self.share:.1f}% of the mismatch"
        if not self.free and self.loose <= self.least_loose:
            return "a refit of the coefficients explains as much"
        if self.frozen <= settings.LEAST_GAIN:
            return "with the coefficients as they are it explains nothing"
        return "its parameters are outside of physical bounds"

    def passed(self, level: float) -> bool:
        """Whether all gates are open."""
        return (
            self.gain > self.least_gain
            and self.p_value < level
            and self.share > self.least_share
            and (self.free or self.loose > self.least_loose)
            and self.frozen > settings.LEAST_GAIN
            and self.in_bounds
        )


def gates_of(search: Search, fit: Fit) -> list[Gates]:
    """Judge each effect of a set: the set with it against the set without it, refitted."""
    out = []
    rest = residual(search.data, fit.changes)
    floors = floors_of(search, fit)
    total = max(mismatch_of(residual(search.data, []), floors), 1e-12)
    for i, name in enumerate(fit.names):
        system = with_shapes(search, search.system, fit.changes, i)
        loose = with_shapes(search, search.loose, fit.changes, i)
        frozen = with_shapes(search, search.frozen, fit.changes, i)
        count = len(fit.free[i]) + catalogue()[name].choices
        reduced = without(search, fit, i)
        rest_without = residual(search.data, reduced.changes)
        gains = []
        for s in (system, loose, frozen):
            less = _least(search, s, reduced, rest_without) - _least(search, s, fit, rest)
            gains.append(0.5 * less / search.inflation - search.price * count)
        held = residual(search.data, fit.others(i))
        part = _part(held, rest)
        own_part = _shown(search, part)
        removed = max(_removed(search, floors, r, rest, own_part[1]) for r in (rest_without, held))
        share = removed / total
        there = min(mismatch_of(r, floors) for r in (rest_without, held))
        out.append(
            Gates(
                name=name,
                gain=gains[0],
                p_value=_joint(search, own_part, (rest_without, reduced), (rest, fit)),
                share=share,
                loose=gains[1],
                frozen=gains[2],
                free=of_coefficients(name) or name in search.likelier,
                in_bounds=not fit.at_bound,
                blocks=search.system.count,
                least_gain=_least_gain(fit.names, i, share),
                least_share=least_share(fit.names, i, gains[0], there / total)
                * part_of_samples(search, part),
                least_loose=settings.LEAST_LOOSE,
            )
        )
    return [_of_one_kind(search, gate, out) for gate in out]


def _least_gain(names: list[str], index: int, share: float) -> float:
    """Log evidence that an effect of a set has to gain, by the share of the mismatch that it removes."""
    if len(names) == 1:
        large = share > settings.LARGE_SHARE and not catalogue()[names[index]].shifts
        return settings.LEAST_GAIN_LARGE if large else settings.LEAST_GAIN_ALONE
    return settings.LEAST_GAIN_MORE if len(names) == 2 else settings.LEAST_GAIN_MANY


def _of_one_kind(search: Search, gate: Gates, gates: list[Gates]) -> Gates:
    """Ask more of an effect beside a stronger one of its kind: that one's form error looks like it."""
    effect = catalogue()[gate.name]
    least = max(gate.least_gain, effect.least_gain)
    others = [(catalogue()[g.name], g.gain) for g in gates if g is not gate]
    if effect.dynamic:
        lags = [gain for other, gain in others if other.dynamic]
        least = max(least, settings.SECOND_LAG * max(lags, default=0.0))
    stronger = [(other, gain) for other, gain in others if gain > gate.gain]
    if stronger:
        least = max(least, effect.least_beside)
    if effect.scales and any(other.scales for other, _ in stronger):
        least = max(least, settings.SECOND_SCALE)
    for other, gain in stronger:
        if gate.name in other.errs_like:
            own = settings.SECOND_ALIKE if other.scales else settings.EXACT_SHARE**2 * gain
            least = max(least, own)
    if effect.slow and any(other.scales or other.blind(search.data) for other, _ in stronger):
        least = max(least, settings.SECOND_SLOW)
    return replace(gate, least_gain=least)


def asked_for(search: Search, name: str, share: float) -> tuple[float, float, float]:
    """Return the log evidence, that with loose coefficients, and share that one more effect has to gain.

    Beside the named effects, all stronger than it.

    Parameters
    ----------
    search : Search
    name : str
    share : float
        Of the mismatch that it removes.
    """
    names = [*search.fit.names, name]
    last = len(names) - 1
    gate = Gates(
        name=name,
        gain=0.0,
        p_value=0.0,
        share=share,
        loose=0.0,
        frozen=0.0,
        free=of_coefficients(name),
        in_bounds=True,
        blocks=search.system.count,
        least_gain=_least_gain(names, last, share),
        least_share=settings.LEAST_SHARE,
        least_loose=max(settings.LEAST_LOOSE, settings.LEAST_GAIN),
    )
    gate = _of_one_kind(search, gate, [*search.gates, gate])
    return gate.least_gain, gate.least_loose, gate.least_share


def floors_of(search: Search, fit: Fit) -> dict[str, float]:
    """Return the size of the noise of each output, N.

    Estimated beside a set that puts in what counts as noise until then.
    """
    noise = search.noise
    if of_noise(set(fit.names) - set(search.fit.names)):
        noise = noise_beside(replace(search, fit=fit))
    return {o: min(noise[o].floor, search.noise[o].floor) for o in search.data.outputs}


def mismatch_of(rest: dict[str, Array], floors: dict[str, float]) -> float:
    """Mean square of a residual over the noise, outputs added."""
    return float(sum(np.mean(r**2) / floors[o] ** 2 for o, r in rest.items()))


def least_share(names: list[str], index: int, gain: float, there: float) -> float:
    """Return the least share of the mismatch that an effect of a set has to remove.

    Of all of it, or of what is there beside the other effects, if it gains a log evidence of ``SURE``: an
    effect six times as strong does not hide another. Not so a lag beside a lag or an offset beside an offset:
    what one's form gets wrong is another. None of an effect that is alone and worth so much log evidence that
    the recording would be called unexplained without it: noise and misfit may be many times as large.

    Parameters
    ----------
    names : list of str
    index : int
    gain : float
        Log evidence.
    there : float
        What is there beside the others, as a share of all.
    """
    if len(names) == 1 and gain > settings.REMAINDER_LOG_EVIDENCE:
        return 0.0
    this = catalogue()[names[index]]
    others = [catalogue()[name] for j, name in enumerate(names) if j != index]
    alike = any((this.dynamic and that.dynamic) or (this.shifts and that.shifts) for that in others)
    return settings.LEAST_SHARE * (1.0 if alike or gain <= settings.SURE else min(there, 1.0))


def unsure(search: Search, index: int, other: str) -> float:
    """Log evidence by which another effect of an accepted one's kind may be less likely by its form alone."""
    this, that = catalogue()[search.gates[index].name], catalogue()[other]
    share = 0.0
    if (this.dynamic and that.dynamic) or (this.shifts and that.shifts and that.exact):
        share = settings.EXACT_SHARE
    elif this.shifts and that.shifts:
        blind = any(e.offset_of and not search.data.varies(e.offset_of) for e in (this, that))
        share = settings.CAMBER_SHARE if blind else settings.SHIFT_SHARE
    if not share:
        return 0.0
    return (share * _misfit_over_usual(search)) ** 2 * search.gates[index].gain


def _misfit_over_usual(search: Search) -> float:
    """How much more than a usual formula the model leaves beside the named effects, 1 at least.

    A formula whose force is off by so much is off in its slope as well, and with it what a lag or an offset
    of the angle does.
    """
    rest = residual(search.data, search.fit.changes)
    left = [
        np.sqrt(max(float(np.mean(r**2)) - search.noise[o].floor ** 2, 0.0)) / search.largest[o]
        for o, r in rest.items()
    ]
    return max(1.0, max(left) / settings.USUAL_MISFIT)


def left_by(search: Search, fit: Fit) -> float:
    """Mismatch beyond the noise that a set leaves."""
    floors = floors_of(search, search.fit)
    return mismatch_of(residual(search.data, fit.changes), floors) - len(search.data.outputs)


def least_left(search: Search, fit: Fit) -> float:
    """Mismatch beyond the noise that a set leaves where it leaves least."""
    return left_by(search, refit(search.frozen, fit.variants, steps=3))


def leaving_less(search: Search, fits: list[Fit], other: Fit) -> list[Fit]:
    """Return the sets that can leave plainly less of the mismatch than another one."""
    if not fits:
        return []
    least = least_left(search, other)
    most = min(settings.PLAINLY_LESS * least, least - settings.LEAST_LESS)
    return [fit for fit in fits if least_left(search, fit) < most]


def _removed(
    search: Search,
    floors: dict[str, float],
    before: dict[str, Array],
    after: dict[str, Array],
    shown: Array,
) -> float:
    """Mismatch that an effect takes away in the sweeps in which it shows.

    Elsewhere the residuals differ only by how the other effects' parameters moved.
    """
    rows = np.isin(search.block, shown)
    return float(sum(np.mean(rows * (before[o] ** 2 - after[o] ** 2)) / floors[o] ** 2 for o in before))


def share_of_sweeps(search: Search, fit: Fit, index: int) -> float:
    """Return the part of the samples that lie in sweeps in which an effect of a set shows."""
    rest, held = residual(search.data, fit.changes), residual(search.data, fit.others(index))
    return part_of_samples(search, _part(held, rest))


def part_of_samples(search: Search, part: dict[str, Array]) -> float:
    """Return the part of the samples that lie in sweeps in which what an effect does (N) shows."""
    return float(np.mean(np.isin(search.block, _shown(search, part)[1])))


def _part(held: dict[str, Array], rest: dict[str, Array]) -> dict[str, Array]:
    """What an effect does in the fit: what is left without it, the others as they stand, less the rest."""
    return {o: held[o] - rest[o] for o in held}


def _shown(search: Search, part: dict[str, Array]) -> tuple[Array, Array]:
    """Return the energy of what an effect does at each sample, and the sweeps in which it shows.

    By what it does, not by how well it does it.
    """
    energy = np.zeros(search.data.size)
    for o in search.data.outputs:
        energy += (part[o] / search.noise[o].sigma) ** 2
    sums = np.bincount(search.block, energy, search.system.count)
    return energy, np.flatnonzero(sums > 0.1 * np.mean(sums))


def _p_value(
    system: System,
    part: tuple[Array, Array],
    without: tuple[dict[str, Array], Fit],
    with_it: tuple[dict[str, Array], Fit],
    plain: bool,
) -> float:
    """Wilcoxon over pieces of held-out sweeps in which the effect shows."""
    energy, shown = part
    errors = _held_out(system, shown, without, with_it, plain)
    strong = system.cut(energy, shown)
    strong_ones = strong > 0.05 * (strong.mean() if strong.size else 0.0)
    return _wilcoxon(errors[0][strong_ones], errors[1][strong_ones])


def _held_out(
    system: System,
    shown: Array,
    without: tuple[dict[str, Array], Fit],
    with_it: tuple[dict[str, Array], Fit],
    plain: bool,
) -> list[Array]:
    """Whitened squared errors of pieces of held-out sweeps, without the effect and with it."""
    return [
        system.held_out(rest, fit.columns if fit.labels else None, shown, plain=plain)
        for rest, fit in (without, with_it)
    ]


def _ratio_test(
    search: Search,
    part: tuple[Array, Array],
    without: tuple[dict[str, Array], Fit],
    with_it: tuple[dict[str, Array], Fit],
) -> float:
    """P-value from the likelihood ratio on held-out sweeps, above 1 / p by chance in a share p at most.

    Ranks count sweeps. An effect that shows in few of them, as camber does near zero slip, has few ranks and
    may have a large ratio. (Wasserman, Ramdas, Balakrishnan 2020, Universal inference, PNAS 117.)
    """
    before, after = _held_out(search.system, part[1], without, with_it, False)
    score = 0.5 * float(np.sum(before - after)) / search.inflation
    return float(np.exp(-max(score, 0.0)))


def _joint(
    search: Search,
    part: tuple[Array, Array],
    without: tuple[dict[str, Array], Fit],
    with_it: tuple[dict[str, Array], Fit],
) -> float:
    """Return the p-value of four tests, by weighted Bonferroni.

    Effects alone, with frozen coefficients, with all that may be off, and the likelihood ratio. The third
    test counts only where one of the others leans that way: two effects that undo each other leave more than
    nothing does, and look good beside a misfit that takes it up.
    """
    plain = _p_value(search.system, part, without, with_it, True)
    either = min(plain, _p_value(search.frozen, part, without, with_it, False))
    joint = either / _EITHER
    joint = min(joint, _ratio_test(search, part, without, with_it) / _RATIO)
    if either < settings.LEVEL:
        joint = min(joint, _p_value(search.system, part, without, with_it, False) / _WHOLE)
    return min(1.0, joint)


def _least(search: Search, system: System, fit: Fit, rest: dict[str, Array]) -> float:
    """Return the least objective that a system gives to a set, from where another system put it.

    By one Gauss-Newton step. If the predicted decrease is large, evaluate the step instead of trusting the
    linearisation: along a valley (the reference of a temperature without its channel, and a friction factor)
    the linearisation predicts a decrease that is not there.
    """
    info, score, here = system.reduce(system.sums(rest, fit.columns if fit.labels else None))
    if score.size == 0:
        return float(here)
    step = np.linalg.lstsq(info, score, rcond=1e-12)[0]
    promised = float(score @ step)
    if promised < 2.0 * settings.TIE * search.inflation:
        return float(here) - promised
    reached = [objective(system, moved(fit.changes, fit.labels, part * step)) for part in _PARTS]
    return float(min(here, *reached))


def _wilcoxon(before: Array, after: Array) -> float:
    d = before - after
    if d.size < 5 or np.all(d == 0.0):
        return 1.0
    return float(scipy.stats.wilcoxon(d, alternative="greater").pvalue)


def accepted(search: Search, fit: Fit) -> tuple[bool, list[Gates]]:
    """Whether all effects of a set pass, Holm-corrected."""
    gates = gates_of(search, fit)
    return _open(gates, _levels(search, gates)), gates


def open_but_loose(search: Search, gates: list[Gates]) -> bool:
    """Whether all gates are open but one: coefficients nearly free explain as much as the last effect."""
    return _open([*gates[:-1], replace(gates[-1], free=True)], _levels(search, gates))


def of_coefficients(name: str) -> bool:
    """Whether coefficients nearly free explain an effect altogether, so that this gate is not asked of it."""
    effect = catalogue()[name]
    return effect.own_inputs or effect.of_coefficients


def reasons(search: Search, gates: list[Gates]) -> dict[str, str]:
    """Return why effects of a set do not pass, by name."""
    judged = zip(gates, _levels(search, gates), strict=True)
    return {g.name: g.why_not(level) for g, level in judged if not g.passed(level)}


def _open(gates: list[Gates], levels: list[float]) -> bool:
    return all(g.passed(level) for g, level in zip(gates, levels, strict=True))


def _levels(search: Search, gates: list[Gates]) -> list[float]:
    """Level of each effect's Wilcoxon test, Holm-corrected for all candidates."""
    count = len({v.name for v in search.variants})
    ordered = sorted(g.p_value for g in gates)
    levels = {p: settings.LEVEL / max(count - k, 1) for k, p in enumerate(ordered)}
    return [levels[g.p_value] for g in gates]
