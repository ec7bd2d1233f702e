"""Channels of a recording: whether they vary, without their noise, and the time step; a part of `Data`."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

Array = np.ndarray
_RELATIVE_SPREAD = {"pressure": 0.03, "speed": 0.12, "normal_load": 0.1}
ABSOLUTE_SPREAD = {
    "camber": 0.008,
    "tread_temperature": 4.0,
    "slip_angle": 0.005,
    "slip_ratio": 0.01,
    "turn_slip": 0.003,
}

_SLOW_LOGGER = 0.025
"""s: channels come from devices whose own clocks are about this fine, whatever the file's rate."""

SLOW = 0.5
"""Mean over so many seconds, in which sensor noise goes under."""


def moves(slow: Array, least: float) -> bool:
    """Whether a channel without its sensor noise spreads over more than ``least`` (99% of it)."""
    low, high = np.quantile(slow, [0.005, 0.995])
    return bool(high - low > least)


def least_spread(name: str, values: Array) -> float:
    """Return the spread, in the channel's unit, below which a channel counts as constant."""
    if name in _RELATIVE_SPREAD:
        return _RELATIVE_SPREAD[name] * abs(float(np.median(values)))
    return ABSOLUTE_SPREAD.get(name, 0.0)


class RecordedChannels:
    """What is recorded."""

    tire: Any
    channels: dict[str, Array]
    recorded: dict[str, Array]
    time: Array | None
    start: Array
    present: set[str]
    fixed: dict[str, Any]

    @property
    def size(self) -> int:
        """Number of samples."""
        return self.channels["normal_load"].size

    @property
    def outputs(self) -> tuple[str, ...]:
        """Forces that are recorded."""
        return tuple(self.recorded)

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
        known = self.fixed.get("varies")
        if known is not None:
            return bool(known[name])
        return moves(self.smooth(name), least_spread(name, self.channels[name]))

    def smooth(self, name: str) -> Array:
        """Return a slow channel without its sensor noise: a running mean over half a second."""
        key = f"smooth {name}"
        if key not in self.fixed:
            self.fixed[key] = self.running_mean(self.channels[name], SLOW)
        return self.fixed[key]

    def running_mean(self, x: Array, seconds: float) -> Array:
        """Return the mean over so many seconds around each sample, within its piece."""
        if self.time is None or x.size < 8:
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
        """Time from one sample to the next, s; at least that of a slow logger, 0.025 s."""
        return max(float(np.median(self.step)), _SLOW_LOGGER)


_OTHER_SIDE = 0.5
"""Least slip angle to one side over that to the other (2% quantiles). A drive of DART that turns to one side
gave an equation that took the error on its own unseen sweeps from 0.50 to 0.09 N, and on another drive from
0.27 to 0.46 N."""


def one_sided(slip: Array) -> bool:
    """Whether a slip goes to one side only, or nearly."""
    low, high = np.quantile(slip, [0.02, 0.98])
    return bool(min(-low, high) < _OTHER_SIDE * max(-low, high))
