"""Screen all forms by score tests, refit sets of them, and drop parameters that do not pay."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from tire_pipeline.mismatch import settings
from tire_pipeline.mismatch.discrepancy.gram import System
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.refit import Fit, objective, refit
from tire_pipeline.mismatch.inference.search_state import Search
from tire_pipeline.mismatch.model.candidates import Variant, screening_columns
from tire_pipeline.mismatch.model.forces import simulate
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray


def screen(search: Search, extra: System | None = None) -> list[tuple[float, Variant]]:
    """Score each form against what the accepted effects leave: log evidence, less the price."""
    system = extra or search.system
    rest = residual(search.data, search.fit.changes)
    own = search.fit.columns if search.fit.labels else None
    out = []
    now = simulate(search.data, search.fit.changes)
    for v in search.variants:
        if v.name in search.fit.names:
            continue
        columns = screening_columns(search.data, search.fit.changes, v, now)
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
    """Log evidence by which a fit is likelier than an objective without its effects, parameters paid."""
    return 0.5 * (against - fit.objective) / search.inflation - search.price * fit.parameters


def frozen_cost(search: Search, fit: Fit) -> float:
    """Return the information criterion of a set with frozen coefficients (log evidence)."""
    return -gain_of(search, fit.judged_by(search.frozen), 0.0)


def likeliest(search: Search, fits: Iterable[Fit]) -> list[Fit]:
    """Return fits in the order of how likely they are, parameters paid."""
    return sorted(fits, key=lambda f: -gain_of(search, f, 0.0))


def prune(search: Search, fit: Fit) -> Fit:
    """Drop parameters that do not pay for themselves: first those that only refine, then the smallest t."""
    for _ in range(8):
        if not fit.labels or fit.sums is None:
            return fit
        least = [_least_worth(search, fit.names[i], name) for i, name in fit.labels]
        t2 = [strength(search, fit, row) for row in range(len(fit.labels))]
        dropped = False
        for row in sorted(range(len(t2)), key=lambda row: (-least[row], t2[row])):
            i, name = fit.labels[row]
            parameter = catalogue()[fit.names[i]].parameter(name)
            if len(fit.free[i]) < 2 or parameter.kept:
                continue
            if set(catalogue()[fit.names[i]].needed) & set(fit.free[i]) == {name}:
                continue
            unknown = zero_of(search, fit, i, name) < parameter.low  # there is no value to put back
            if unknown or t2[row] > 2.0 * least[row]:
                continue
            changes = [(n, dict(p)) for n, p in fit.changes]
            changes[i][1][name] = catalogue()[changes[i][0]].zeros(search.data)[name]
            free = [tuple(f for f in fs if (j, f) != (i, name)) for j, fs in enumerate(fit.free)]
            shorter = [Variant(n, p, f) for (n, p), f in zip(changes, free, strict=True)]
            trial = refit(search.system, shorter, steps=2, start=changes)
            if 0.5 * (trial.objective - fit.objective) / search.inflation < least[row]:
                fit, dropped = trial, True
                break
        if not dropped:
            return fit
    return fit


def _least_worth(search: Search, effect: str, parameter: str) -> float:
    """Log evidence that a parameter must be worth to be kept."""
    further = catalogue()[effect].parameter(parameter).further
    return max(search.price, settings.TIE) if further else search.price


def strength(search: Search, fit: Fit, row: int) -> float:
    """Return the square of a parameter over its standard error; ``row`` counts ``fit.labels``."""
    i, name = fit.labels[row]
    variance = max(float(fit.covariance[row, row]), 1e-300)
    return float((fit.changes[i][1][name] - zero_of(search, fit, i, name)) ** 2 / variance / search.inflation)


def rank(search: Search, fit: Fit) -> int:
    """Return how many effects of a set are the less usual of two that look the same."""
    return sum(catalogue()[name].unusual or hollow(search, fit, i) for i, name in enumerate(fit.names))


def hollow(search: Search, fit: Fit, index: int) -> bool:
    """Whether an effect lacks what makes it what it is: ply steer without conicity, an offset to the eye.

    Its evidence does not pay for it, or is less than the form of the rest may get wrong.
    """
    needed = catalogue()[fit.names[index]].needed
    rows = [k for k, (j, p) in enumerate(fit.labels) if j == index and p in needed]
    if not rows:
        return bool(needed)
    own = objective(search.system, fit.others(index)) - objective(search.system, fit.changes)
    least = max(2.0 * search.price, settings.EXACT_SHARE**2 * own / search.inflation)
    return all(strength(search, fit, k) < least for k in rows)


def zero_of(search: Search, fit: Fit, index: int, name: str) -> float:
    """Return the value of a parameter at which its effect is absent."""
    return catalogue()[fit.names[index]].zeros(search.data)[name]


def without(search: Search, fit: Fit, *which: int, steps: int = 3) -> Fit:
    """Refit a set without some of its effects."""
    left = [v for j, v in enumerate(fit.variants) if j not in which]
    return refit(search.system, left, steps=steps) if left else Fit([], [])
