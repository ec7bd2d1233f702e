"""The residual: recorded forces minus those of the simulation with some changes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import overload

import numpy as np
import scipy
from numpy.typing import ArrayLike

from tire_pipeline.mismatch.model.channels import CHANCE
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change, simulate

Array = np.ndarray


def residual(data: Data, changes: Sequence[Change]) -> dict[str, Array]:
    """Recorded minus simulated, N."""
    f = simulate(data, changes)
    return {o: data.recorded[o] - f[o] for o in data.outputs}


@overload
def partly(before: float, after: float, part: float) -> float: ...
@overload
def partly(before: Array, after: Array, part: float | Array) -> Array: ...
def partly(before: float | Array, after: float | Array, part: float | Array) -> float | Array:
    """Return a value, a force or what is left of one with a part of a change, 0 to 1.

    Parameters
    ----------
    before, after : float or ndarray
        Without the change, and with all of it.
    part : float or ndarray
        Of all samples, or of each.
    """
    return before - part * (before - after)


def rms(x: ArrayLike) -> float:
    """Root mean square of what is finite; NaN where nothing is."""
    values = np.asarray(x, float)
    values = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(values**2))) if values.size else float("nan")


def error_over_forces(forces: Mapping[str, ArrayLike], recorded: Mapping[str, ArrayLike]) -> float:
    """Return the squared error of some forces, each over the square of the recorded one.

    Parameters
    ----------
    forces, recorded : mapping of array_like, shape (n,)
        Output -> simulated, and recorded; all that is recorded counts.
    """
    return sum(
        rms(np.asarray(x) - np.asarray(forces[o])) ** 2 / max(rms(x) ** 2, 1e-300)
        for o, x in recorded.items()
    )


def root_ratio_interval(above: Array, below: Array) -> tuple[float, float]:
    """Return the 95% interval of the root of a ratio of sums by resampling pieces as wholes.

    Parameters
    ----------
    above, below : ndarray, shape (pieces,)
        Of each piece, as its sum of squares and its number of samples; a single piece has no interval.
    """

    def whole(above: Array, below: Array, axis: int = -1) -> Array:
        return np.sqrt(above.sum(axis=axis) / np.maximum(below.sum(axis=axis), 1e-300))

    if below.size < 2:
        return (float(whole(above, below)),) * 2
    found = scipy.stats.bootstrap((above, below), whole, paired=True, method="percentile", rng=0)
    return float(found.confidence_interval.low), float(found.confidence_interval.high)


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
    return min(max((before - after) / above, -1.0), 1.0) if above > CHANCE * floor**2 else float("nan")
