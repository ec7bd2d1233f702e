"""How far the wheel has rolled: known in the recording that was explained, and in what follows at once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from tire_pipeline.mismatch.model.wheel import way_rolled
from tire_pipeline.recordings.check import LONG_GAP

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

    @property
    def last(self) -> float:
        """Time of the last sample, s."""
        return float(self.time[-1])

    @cached_property
    def longest_pause(self) -> float:
        """Longest time between two samples of the recording, at least ``LONG_GAP`` usual ones, s."""
        return max(float(np.diff(self.time).max(initial=0.0)), self._gap)

    @cached_property
    def _gap(self) -> float:
        """From which time between two samples on there is a gap, s."""
        steps = np.diff(self.time)
        return LONG_GAP * float(np.median(steps)) if steps.size else 0.0

    def running(self, time: Array) -> Array:
        """Return which samples are of a time at which the recording was running, without a gap; bool."""
        end = np.searchsorted(self.time, time)
        between = (end > 0) & (end < self.time.size)
        steps = self.time[end[between]] - self.time[end[between] - 1]
        between[between] = steps <= self._gap
        return between

    def own(self, time: Array, load: Array) -> Array:
        """Return which samples are of this recording, which has their time and load; bool, shape (n,)."""
        near = self._near(time)
        return np.asarray((self.time[near] == time) & (self.load[near] == load))

    def at(self, time: Array, load: Array, speed: Array | None = None) -> Array:
        """Return how far the wheel had rolled, m, shape as ``time``; NaN where nobody knows.

        It is known in samples of this recording. It is known in those that follow it without a gap, too: the
        wheel rolls on. In a gap it may stop. Elsewhere its angle is unknown, and what repeats once a turn
        would be added at a wrong angle. A recording with other samples of the same time has a clock of its
        own, and does not follow.

        Parameters
        ----------
        time, load : ndarray, shape (n,)
            s, N.
        speed : ndarray, shape (n,), optional
            m/s. What follows is unknown without it.
        """
        own = self.own(time, load)
        way = np.where(own, self.way[self._near(time)], np.nan)
        after = np.flatnonzero(time > self.last)
        if speed is None or not after.size or np.any(self.running(time) & ~own):
            return way
        steps = np.diff(time[after], prepend=self.last)
        breaks = ~((steps > 0.0) & (steps <= self._gap))
        follows = after[: int(np.argmax(breaks)) if breaks.any() else after.size]
        if follows.size:  # the wheel comes to the first of them at its speed
            rolled = way_rolled(speed[np.r_[follows[0], follows]], np.r_[self.last, time[follows]])
            way[follows] = self.way[-1] + rolled[1:]
        return way

    def _near(self, time: Array) -> Array:
        return np.clip(np.searchsorted(self.time, time), 0, self.time.size - 1)


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
