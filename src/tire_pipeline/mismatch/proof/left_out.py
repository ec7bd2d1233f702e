"""What a set leaves on loads, or runs, that the fit of its parameters has not seen.

An effect in the model's own inputs is what other coefficients would do, too. A formula that misfits is
improved by it on the loads that were recorded. It is more than that only if the loads that were left out come
out better.
"""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.fit import Fit
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray
_LOCKED = {"moment", "radius"}
_LEAST_GROUPS = 3
_APART = 0.1
"""Loads are levels of their own where they are so far apart, over the median load."""


def groups(analysis: Analysis) -> Array | None:
    """Return the load level of each sweep, or its run where the load stands still; None below three.

    Parameters
    ----------
    analysis : Analysis

    Returns
    -------
    ndarray of int, shape (sweeps,), or None
    """
    data, count = analysis.data, analysis.system.count
    load, runs = data.get("normal_load"), np.cumsum(data.start) - 1
    at = np.array([np.median(load[analysis.block == k]) for k in range(count)])
    order = np.argsort(at)
    level = np.zeros(count, int)
    level[order] = np.r_[0, np.cumsum(np.diff(at[order]) > _APART * np.median(at))]
    if level.max() + 1 >= _LEAST_GROUPS:
        return level
    _, run = np.unique([runs[analysis.block == k][0] for k in range(count)], return_inverse=True)
    return run if run.max() + 1 >= _LEAST_GROUPS else None


def each_group_left_out(analysis: Analysis, fit: Fit, group: Array) -> dict[str, Array]:
    """Return residuals, N, with each group of sweeps predicted by parameters fitted without it.

    Parameters
    ----------
    analysis : Analysis
    fit : Fit
        Its parameters move by one Gauss-Newton step when a group is left out.
    group : ndarray of int, shape (sweeps,)
    """
    out = residual(analysis.data, fit.changes)
    if not fit.labels or fit.sums is None:
        return out
    base = step_without(fit, np.zeros(analysis.system.count, bool))
    for number in np.unique(group):
        left = group == number
        delta = step_without(fit, left) - base
        rows = left[analysis.block]
        for o in out:
            out[o][rows] -= fit.columns[o][rows] @ delta
    return out


def shares_left(after: dict[str, Array], before: dict[str, Array]) -> dict[str, float]:
    """Mean square of what is left over that of the mismatch, by output."""
    return {o: float(np.mean(after[o] ** 2) / max(float(np.mean(before[o] ** 2)), 1e-300)) for o in after}


def each_left_out(analysis: Analysis, fit: Fit) -> dict[str, Array]:
    """Return residuals, N, with each sweep predicted by parameters fitted without it (no nuisance here)."""
    return each_group_left_out(analysis, fit, np.arange(analysis.system.count))


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
