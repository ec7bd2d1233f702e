"""The residual of a set on sweeps that the fit of its parameters has not seen."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.linearised_set import LOCKED, Fit
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray


def shares_left(after: dict[str, Array], before: dict[str, Array]) -> dict[str, float]:
    """Mean square of the residual over that of the mismatch, by output."""
    return {o: float(np.mean(after[o] ** 2) / max(float(np.mean(before[o] ** 2)), 1e-300)) for o in after}


def each_left_out(
    analysis: Analysis, fit: Fit, *, refitted: bool = False, together: Array | None = None
) -> dict[str, Array]:
    """Return residuals, N, with each sweep predicted by parameters fitted without it (no nuisance here).

    Parameters
    ----------
    analysis : Analysis
    fit : Fit
        Its parameters move by one Gauss-Newton step when a sweep is left out.
    refitted : bool
        Whether the step goes on from where a larger set had them. Without it a fit stands where it ended.
    together : ndarray of int, shape (sweeps,), optional
        Sweeps of one number are left out together; each by itself if left out.
    """
    out = residual(analysis.data, fit.changes)
    if not fit.labels or fit.sweeps is None:
        return out
    count = analysis.system.count
    base = 0.0 if refitted else step_without(fit, np.zeros(count, bool))
    group = np.arange(count) if together is None else together
    for number in np.unique(group):
        delta = step_without(fit, group == number) - base
        rows = group[analysis.block] == number
        for o in out:
            out[o][rows] -= fit.columns[o][rows] @ delta
    return out


def step_without(fit: Fit, dropped: Array) -> Array:
    """Return the change of the parameters when some sweeps (bool, by number) are left out.

    The residual says little of some parameters: these go to where their priors have them. A moment in time
    and a wheel's radius are locked: one sweep determines them, and a linear step says nothing about them
    without it.
    """
    assert fit.sweeps is not None  # kept by the last fit
    return fit.sweeps.step(~dropped, np.array([name not in LOCKED for _, name in fit.labels], bool))
