"""Recordings whose slip angle was replaced by one that says little or nothing about the force."""

from __future__ import annotations

from functools import cache

import numpy as np
import pandas as pd
from mismatch_shared import shared
from scipy.ndimage import uniform_filter1d

from tire_pipeline.recordings import DART_CAR, axle_recording, read_dart

AXLE = ["slip_angle", "normal_load", "fy"]
RUINS = (("shuffled", 1.0), ("smoothed", 20.0), ("still", 1.0), ("noise", 1.0), ("slow noise", 2.0))
"""What was done to the slip angle, and over how many seconds."""


@cache
def free_drive() -> pd.DataFrame:
    (file,) = (shared("recordings/dart") / "free_driving").glob("*.csv")
    return axle_recording(read_dart(file), DART_CAR)


def ruined(slip, time, how, size, seed):
    """Slip in another order, smoothed over so many seconds, still, or with noise of so many seconds on it."""
    rng = np.random.default_rng(seed)
    spread = slip.std()
    if how == "shuffled":
        return rng.permutation(slip)
    width = max(int(size / np.median(np.diff(time))), 1)
    if how == "smoothed":
        return uniform_filter1d(slip, width)
    if how == "still":
        return slip.mean() + 1e-4 * rng.standard_normal(slip.size)
    noise = uniform_filter1d(rng.standard_normal(slip.size), width if how == "slow noise" else 1)
    return slip + 1.5 * spread * noise / noise.std()


def without_slip(recording, how, size, seed):
    slip = ruined(recording["slip_angle"].to_numpy(), recording["time"].to_numpy(), how, size, seed)
    return recording.assign(slip_angle=slip)
