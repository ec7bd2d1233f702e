"""What a set leaves on loads, or runs, that the fit of its parameters has not seen.

An effect in the model's own inputs is what other coefficients would do, too. A formula that misfits is
improved by it on the loads that were recorded. It is more than that only if the loads that were left out come
out better.
"""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.discrepancy.gram import Sums, System
from tire_pipeline.mismatch.inference.refit import Fit
from tire_pipeline.mismatch.inference.search_state import Search
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray
_LOCKED = {"moment", "radius"}
_LEAST_GROUPS = 3
_APART = 0.1
"""Loads are levels of their own where they are so far apart, over the median load."""


def groups(search: Search) -> Array | None:
    """Return the load level of each sweep, or its run where the load stands still; None below three.

    Parameters
    ----------
    search : Search

    Returns
    -------
    ndarray of int, shape (sweeps,), or None
    """
    data, count = search.data, search.system.count
    load, runs = data.get("normal_load"), np.cumsum(data.start) - 1
    at = np.array([np.median(load[search.block == k]) for k in range(count)])
    order = np.argsort(at)
    level = np.zeros(count, int)
    level[order] = np.r_[0, np.cumsum(np.diff(at[order]) > _APART * np.median(at))]
    if level.max() + 1 >= _LEAST_GROUPS:
        return level
    _, run = np.unique([runs[search.block == k][0] for k in range(count)], return_inverse=True)
    return run if run.max() + 1 >= _LEAST_GROUPS else None


def left_out_error(search: Search, fit: Fit, group: Array) -> float:
    """Return the mean log RMS error of groups of sweeps, each predicted by effects fitted without it.

    Each load counts alike: a formula that is off by as many percent at every load is off by more newtons at
    the large ones.

    Parameters
    ----------
    search : Search
    fit : Fit
        Its parameters move by one Gauss-Newton step when a group is left out, misfit and coefficients beside.
    group : ndarray of int, shape (sweeps,)
    """
    rest, system = residual(search.data, fit.changes), search.system
    if fit.labels:
        sums = system.by_sweep(rest, fit.columns)
        full = _solution(system, sums, np.ones(system.count, bool))
        rest = {o: r.copy() for o, r in rest.items()}
        for number in np.unique(group):
            left = group == number
            step = _solution(system, sums, ~left) - full
            rows = left[search.block]
            for o in rest:
                rest[o][rows] -= fit.columns[o][rows] @ step
    power = sum((r / search.noise[o].sigma) ** 2 for o, r in rest.items())
    means = [float(np.mean(power[group[search.block] == number])) for number in np.unique(group)]
    return float(np.mean(0.5 * np.log(means)))


def _solution(system: System, sums: Sums, kept: Array) -> Array:
    info, score = system.reduced_over(sums, kept)
    size = np.sqrt(np.maximum(np.diag(info), 1e-300))
    scaled = info / size[:, None] / size[None, :] + 1e-6 * np.eye(size.size)
    return np.linalg.solve(scaled, score / size) / size


def removed_unseen(search: Search, fit: Fit) -> float:
    """Share of the squared mismatch that goes on sweeps that the fit has not seen, mean of the outputs.

    In newtons, as the model will be used: without the misfit and the coefficients beside which the evidence
    was weighed. One sweep at a time: without the highest load as a whole, or an eighth of the recording, what
    changes a pressure's effect with load is open, and a true pressure leaves four times as much (calspan).
    """
    shares = shares_left(each_left_out(search, fit), residual(search.data, []))
    return 1.0 - float(np.mean(list(shares.values())))


def shares_left(after: dict[str, Array], before: dict[str, Array]) -> dict[str, float]:
    """Mean square of what is left over that of the mismatch, by output."""
    return {o: float(np.mean(after[o] ** 2) / max(float(np.mean(before[o] ** 2)), 1e-300)) for o in after}


def each_left_out(search: Search, fit: Fit) -> dict[str, Array]:
    """Return residuals with each sweep predicted by parameters fitted without it (no nuisance here)."""
    out = residual(search.data, fit.changes)
    if not fit.labels or fit.sums is None:
        return out
    base = step_without(fit, np.zeros(search.system.count, bool))
    for k in range(search.system.count):
        left = np.zeros(search.system.count, bool)
        left[k] = True
        delta = step_without(fit, left) - base
        rows = search.block == k
        for o in out:
            out[o][rows] -= fit.columns[o][rows] @ delta
    return out


def step_without(fit: Fit, dropped: Array) -> Array:
    """Return the change of the parameters when some sweeps (bool, by number) are left out.

    A moment in time and a wheel's radius are locked: one sweep determines them, and a linear step says
    nothing about them without it.
    """
    sums = fit.sums
    assert sums is not None  # kept by the last fit
    kept = ~dropped
    free = np.array([name not in _LOCKED for _, name in fit.labels])
    info, score = sums.ee[kept].sum(axis=0), sums.er[kept].sum(axis=0)
    delta = np.zeros(score.size)
    if free.any():
        delta[free] = _solve(info[np.ix_(free, free)], score[free])
    return delta


def _solve(info: Array, score: Array) -> Array:
    size = np.sqrt(np.maximum(np.diag(info), 1e-300))
    m = info / size[:, None] / size[None, :] + 1e-6 * np.eye(size.size)
    return np.linalg.solve(m, score / size) / size
