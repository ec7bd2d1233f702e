"""The one guard beside the posterior: what makes sweeps worse that its fit has not seen is not put in.

It can withhold a correction, never choose a name.
"""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.fit import Fit
from tire_pipeline.mismatch.model.residual import residual
from tire_pipeline.mismatch.proof.left_out import each_left_out

Array = np.ndarray


def harmless(analysis: Analysis) -> Fit:
    """Return the named set without those effects whose correction makes unseen sweeps worse.

    The effect goes first without which the others leave least.

    Parameters
    ----------
    analysis : Analysis
        With the set that is named.
    """
    fit = analysis.fit
    while fit.names and not _holds(analysis, fit):
        numbers = range(len(fit.names))
        others = [fit.part([j for j in numbers if j != i], analysis.system) for i in numbers]
        fit = min(others, key=lambda other: _size(analysis, residual(analysis.data, other.changes)))
    return fit


def _holds(analysis: Analysis, fit: Fit) -> bool:
    """Whether all forces together have no larger error on sweeps that are predicted without them."""
    after, before = each_left_out(analysis, fit), residual(analysis.data, [])
    return _size(analysis, after) <= _size(analysis, before)


def _size(analysis: Analysis, rest: dict[str, Array]) -> float:
    """Squared residuals of all forces, each over the square of its largest."""
    return sum(float(np.mean((r / analysis.largest[o]) ** 2)) for o, r in rest.items())
