"""When and where an effect lives: the truth that located windows and regimes are held against."""

from __future__ import annotations

import numpy as np
import pandas as pd
from scipy.ndimage import uniform_filter1d

from tire_pipeline.channels import POINT_CHANNELS

REGIME_CHANNELS = (*POINT_CHANNELS, "tread_temperature")
"""Channels over which a regime is given."""


def windows(
    effect: np.ndarray, time: np.ndarray, threshold: float, *, width: float = 1.0, gap: float = 2.0
) -> tuple[tuple[float, float], ...]:
    """Stretches in which the local RMS of an effect is above a threshold.

    Parameters
    ----------
    effect : ndarray, shape (n,)
        What the effect adds to a force, N.
    time : ndarray, shape (n,)
        s, evenly spaced.
    threshold : float
        N.
    width, gap : float
        Length over which the RMS is taken; stretches nearer than ``gap`` are joined, s.

    Returns
    -------
    tuple of (start, end)
        s; stretches shorter than half a second are left out.
    """
    dt = float(time[1] - time[0])
    mean_square = uniform_filter1d(effect**2, max(round(width / dt), 1))
    local = np.sqrt(np.maximum(mean_square, 0.0))
    above = np.flatnonzero(local > threshold)
    if above.size == 0:
        return ()
    breaks = np.flatnonzero(np.diff(above) * dt > gap)
    starts = above[np.r_[0, breaks + 1]]
    ends = above[np.r_[breaks, above.size - 1]]
    found = [(float(time[a]), float(time[b])) for a, b in zip(starts, ends, strict=True)]
    return tuple((a, b) for a, b in found if b - a >= 0.5)


def regimes(effect: np.ndarray, frame: pd.DataFrame) -> dict[str, tuple[float, float]]:
    """Interval of every channel that holds the central 90% of an effect's energy.

    Parameters
    ----------
    effect : ndarray, shape (n,)
        N.
    frame : pandas.DataFrame
        The recording.
    """
    energy = effect**2
    total = float(energy.sum())
    if total <= 0.0:
        return {}
    out = {}
    for channel in REGIME_CHANNELS:
        if channel in frame:
            values = frame[channel].to_numpy()
            order = np.argsort(values, kind="stable")
            share = np.cumsum(energy[order]) / total
            low, high = np.searchsorted(share, [0.05, 0.95])
            high = min(int(high), len(order) - 1)
            out[channel] = (float(values[order[low]]), float(values[order[high]]))
    return out
