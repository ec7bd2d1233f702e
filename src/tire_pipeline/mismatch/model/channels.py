"""Channels of a recording: whether they vary, without their noise, and the time step."""

from __future__ import annotations

from collections.abc import Mapping, Set
from dataclasses import dataclass, field
from functools import cached_property
from statistics import NormalDist

import numpy as np
import scipy

from tire_pipeline.channels import FORCE_OF_SLIP

Array = np.ndarray
_RELATIVE_SPREAD = {"pressure": 0.03, "speed": 0.12, "normal_load": 0.1, "load_transfer": 0.1}
"""Standard deviation over the median by which a channel varies at the least; with less it is held."""
ABSOLUTE_SPREAD = {
    "camber": 0.008,
    "tread_temperature": 4.0,
    "slip_angle": 0.005,
    "slip_ratio": 0.01,
    "turn_slip": 0.003,
}
"""The same of channels that may be zero, in SI: rad, degC, 1, rad, 1/m."""

SLOW = 0.5
"""Mean over so many seconds, in which sensor noise goes under."""

SMALL = 0.15
"""A force that moves by less than this part of the other one is a side effect of what that one does."""

ENOUGH_ROWS = 4000
"""Of a long recording, as many rows spread over it say the same of a few numbers as all of them."""

CHANCE = 0.05
"""Level of every test, and what an interval or a list leaves out: one in twenty. What changes odds, a count
or a share by less has not changed it."""

OF_INTERVAL = NormalDist().inv_cdf(1.0 - 0.5 * CHANCE)
"""Standard errors to each end of an interval."""

DOES_NOTHING = 1e-3
"""What does less than so much of what the largest of its kind does, does nothing."""

CLASSES = 16
"""Of about equal size, within which values of a channel count as the same."""

OUTLIERS = 0.005
"""Part of the samples at either end of a channel that may be outliers."""

_TAKEN_OVER_SMOOTH = ("pressure", "speed", "tread_temperature")
"""Those of which a part of a recording takes over the values without sensor noise."""


def span(x: Array) -> tuple[float, float]:
    """Return the range of a channel but for outliers: the central 99%."""
    low, high = np.quantile(x, [OUTLIERS, 1.0 - OUTLIERS])
    return float(low), float(high)


def largest(x: Array) -> float:
    """Return the largest size of a channel but for outliers: 99% are no larger."""
    return float(np.quantile(np.abs(x), 1.0 - 2.0 * OUTLIERS))


def high(x: Array) -> float:
    """Return the size that one in ten samples of a channel exceeds."""
    return float(np.quantile(np.abs(x), 1.0 - 2.0 * CHANCE))


def used(slip: Array) -> Array:
    """Return how much of the grip a slip uses, about: three quarters where one in ten is larger."""
    size = np.abs(slip)
    return size / (size + max(high(slip) / 3.0, 1e-6))


def white_noise(x: Array) -> float:
    """Return the size of white noise, from the median of second differences; NaN for fewer than three."""
    d = np.diff(x, 2)
    size = np.linalg.norm((1.0, -2.0, 1.0))
    return float(scipy.stats.median_abs_deviation(d, scale="normal") / size) if d.size else float("nan")


def moves(slow: Array, least: float) -> bool:
    """Whether a channel without its sensor noise spreads over more than ``least`` (99% of it)."""
    low, high = span(slow)
    return bool(high - low > least)


def least_spread(name: str, values: Array) -> float:
    """Return the spread, in the channel's unit, below which a channel counts as constant."""
    if name in _RELATIVE_SPREAD:
        return _RELATIVE_SPREAD[name] * abs(float(np.median(values)))
    return ABSOLUTE_SPREAD.get(name, 0.0)


@dataclass(frozen=True, eq=False)
class OfWhole:
    """What the channels of a part of a recording take over from all of it.

    Parameters
    ----------
    varying : set of str
        Channels that vary in all of it.
    slow : mapping of ndarray, shape (n,)
        Slow channels without their sensor noise, at the rows of the part, SI.
    """

    varying: Set[str]
    slow: Mapping[str, Array]


@dataclass(frozen=True, eq=False)
class RecordedChannels:
    """What is recorded.

    Parameters
    ----------
    channels : mapping of ndarray, shape (n,)
        SI; slip_angle, slip_ratio, camber, normal_load are always there.
    recorded : mapping of ndarray, shape (n,)
        fx and or fy, N.
    time : ndarray, shape (n,), optional
        s, rising.
    start : ndarray of bool, shape (n,)
        First samples of uninterrupted pieces.
    present : set of str
        Channels that the recording really has.
    whole : OfWhole, optional
        If it is a part of a recording: what all of it says.
    """

    channels: Mapping[str, Array]
    recorded: Mapping[str, Array]
    time: Array | None
    start: Array
    present: Set[str]
    whole: OfWhole | None = None
    _means: dict[str, Array] = field(default_factory=dict, init=False, repr=False)

    @property
    def size(self) -> int:
        """Number of samples."""
        return self.channels["normal_load"].size

    @property
    def outputs(self) -> tuple[str, ...]:
        """Forces that are recorded."""
        return tuple(self.recorded)

    @property
    def time_line(self) -> Array:
        """The time, s, where only a recording with time is asked."""
        assert self.time is not None
        return self.time

    def get(self, name: str) -> Array:
        """Return one channel."""
        return self.channels[name]

    def has(self, name: str) -> bool:
        """Whether the recording has the channel."""
        return name in self.present

    def varies(self, name: str) -> bool:
        """Whether the channel is recorded and varies by more than a sensor's noise."""
        if name not in self.present:
            return False
        if self.whole is not None:
            return name in self.whole.varying
        return moves(self.smooth(name), least_spread(name, self.channels[name]))

    def smooth(self, name: str) -> Array:
        """Return a slow channel without its sensor noise: a running mean over half a second."""
        if self.whole is not None and name in self.whole.slow:
            return self.whole.slow[name]
        if name not in self._means:
            self._means[name] = self.running_mean(self.channels[name], SLOW)
        return self._means[name]

    def running_mean(self, x: Array, seconds: float) -> Array:
        """Return the mean over so many seconds around each sample, within its piece."""
        if self.time is None:
            return x
        half = int(max(seconds / max(float(np.median(self.step)), 1e-9), 1.0)) // 2
        if half < 1:
            return x
        total = np.concatenate([[0.0], np.cumsum(x)])
        firsts = np.flatnonzero(self.start)
        piece = np.cumsum(self.start) - 1
        first = firsts[piece]
        last = np.append(firsts[1:], x.size)[piece]
        i = np.arange(x.size)
        a, b = np.maximum(i - half, first), np.minimum(i + half + 1, last)
        return (total[b] - total[a]) / (b - a)

    @cached_property
    def step(self) -> Array:
        """Time step that ends at each sample, s."""
        if self.time is None:
            return np.zeros(self.size)
        d = np.diff(self.time, prepend=self.time[0])
        d[self.start] = 0.0
        typical = float(np.median(d[d > 0.0])) if np.any(d > 0.0) else 0.0
        d[self.start] = typical
        return d

    @cached_property
    def sampling(self) -> float:
        """Time from one sample to the next, s."""
        return float(np.median(self.step))

    @cached_property
    def has_combined(self) -> bool:
        """Whether both slips are large together in at least 1% of the samples: beyond three least spreads."""
        slips = [np.abs(self.get(n)) / ABSOLUTE_SPREAD[n] for n in FORCE_OF_SLIP]
        return largest(np.min(slips, axis=0)) > 3.0

    def part(self, rows: Array) -> RecordedChannels:
        """Return the rows of ``rows`` (bool); which channels vary, and slow ones, are those of all rows."""
        index = np.flatnonzero(rows)
        start = self.start[rows].copy()
        start[np.flatnonzero(np.diff(index, prepend=index[0] - 2) > 1)] = True
        return RecordedChannels(
            channels={n: c[rows] for n, c in self.channels.items()},
            recorded={n: c[rows] for n, c in self.recorded.items()},
            time=None if self.time is None else self.time[rows],
            start=start,
            present=self.present,
            whole=OfWhole(
                varying={n for n in self.present if self.varies(n)},
                slow={n: self.smooth(n)[rows] for n in _TAKEN_OVER_SMOOTH if n in self.present},
            ),
        )


_OTHER_SIDE = 0.5
"""Least slip angle to one side over that to the other. A drive of DART that turns to one side
gave an equation that took the error on its own unseen sweeps from 0.50 to 0.09 N, and on another drive from
0.27 to 0.46 N."""


def one_sided(slip: Array) -> bool:
    """Whether a slip goes to one side only, or nearly."""
    low, high = span(slip)
    return bool(min(-low, high) < _OTHER_SIDE * max(-low, high))
