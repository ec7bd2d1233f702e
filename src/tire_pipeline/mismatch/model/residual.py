"""What the simulation with some changes leaves of the recorded forces."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change, simulate

Array = np.ndarray
_TO_TELL = 0.05
"""Least squared error above the noise floor, over the floor's square, of which a share is told."""


def residual(data: Data, changes: Sequence[Change]) -> dict[str, Array]:
    """Recorded minus simulated, N."""
    f = simulate(data, changes)
    return {o: data.recorded[o] - f[o] for o in data.outputs}


def rms(x: ArrayLike) -> float:
    """Root mean square of what is finite; NaN where nothing is."""
    values = np.asarray(x, float)
    values = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(values**2))) if values.size else float("nan")


def share_above_noise(before: float, after: float, floor: float) -> float:
    """Share of the squared error above the noise that is gone, within -1 and 1; NaN if nearly nothing is.

    Parameters
    ----------
    before, after : float
        Mean squares, N^2.
    floor : float
        RMS of the noise, N.
    """
    above = before - floor**2
    return min(max((before - after) / above, -1.0), 1.0) if above > _TO_TELL * floor**2 else float("nan")
