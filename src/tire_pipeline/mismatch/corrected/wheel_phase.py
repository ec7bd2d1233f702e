"""Samples of the recording that was explained: its clock and its wheel's angle are known nowhere else."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

Array = np.ndarray


@dataclass(frozen=True)
class WheelWay:
    """How far the wheel had rolled at each sample of a recording.

    Parameters
    ----------
    time, load : ndarray, shape (n,)
        As recorded, s and N; time increases.
    way : ndarray, shape (n,)
        m.
    """

    time: Array
    load: Array
    way: Array

    def at(self, time: Array, load: Array) -> Array:
        """Return how far the wheel had rolled, m, shape as ``time``; NaN in samples of another recording.

        A sample is of this recording if it has a sample of the same time and load. In another one the
        wheel's angle is unknown, and what repeats once a turn would be added at a wrong angle.
        """
        near = np.clip(np.searchsorted(self.time, time), 0, self.time.size - 1)
        own = (self.time[near] == time) & (self.load[near] == load)
        return np.where(own, self.way[near], np.nan)


def way_at_each(time: Array, load: Array, stamps: Array, way: Array) -> WheelWay:
    """Return the way at each recorded sample from that at the samples that were weighed.

    Of a fast recording neighbours are averaged before they are weighed.

    Parameters
    ----------
    time, load : ndarray, shape (n,)
        As recorded, s and N; samples without either are left out.
    stamps, way : ndarray, shape (k,)
        Time of the weighed samples, s, and the way rolled there, m.
    """
    known = np.isfinite(time) & np.isfinite(load)
    along = scipy.interpolate.interp1d(stamps, way, fill_value="extrapolate", assume_sorted=True)
    return WheelWay(time[known], load[known], along(time[known]))
