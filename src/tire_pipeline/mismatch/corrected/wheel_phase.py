"""Angle of the wheel, which is known in the recording that was explained only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

Array = np.ndarray


@dataclass(frozen=True)
class WheelWay:
    """How far the wheel had rolled at each sample of a recording.

    Parameters
    ----------
    time, speed : ndarray, shape (n,)
        As recorded, s and m/s; time increases.
    way : ndarray, shape (n,)
        m.
    """

    time: Array
    speed: Array
    way: Array

    def at(self, time: Array, speed: Array) -> Array:
        """Return how far the wheel had rolled, m, shape as ``time``; NaN in samples of another recording.

        A sample is of this recording if it has a sample of the same time and speed. In another one the
        wheel's angle is unknown, and what repeats once a turn would be added at a wrong angle.
        """
        near = np.clip(np.searchsorted(self.time, time), 0, self.time.size - 1)
        own = (self.time[near] == time) & (self.speed[near] == speed)
        return np.where(own, self.way[near], np.nan)
