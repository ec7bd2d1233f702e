"""What a set leaves on loads, or runs, that the fit of its parameters has not seen.

An effect in the model's own inputs is what other coefficients would do, too. A formula that misfits is
improved by it on the loads that were recorded. It is more than that only if the loads that were left out come
out better.
"""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.discrepancy.gram import Sums, System
from tire_pipeline.mismatch.inference.refit import Fit, residual
from tire_pipeline.mismatch.inference.search_state import Search

Array = np.ndarray
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
