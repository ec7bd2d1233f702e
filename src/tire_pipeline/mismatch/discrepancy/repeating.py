"""Unnamed forms that repeat every so many metres, but not with the wheel: a seam of the drum."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from tire_pipeline.mismatch.effects.shared import INDEPENDENT_STRETCHES
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change
from tire_pipeline.mismatch.model.residual import residual
from tire_pipeline.mismatch.model.wheel import OF_A_TURN

Array = np.ndarray
_CIRCUMFERENCES = (3.0, 14.0)
"""What drums and belts measure round, m."""
_HARMONICS = 2
_PADDED = 2
"""Times as long as the recording is the transform: wave numbers are then half a period of it apart."""


def repeating_forms(data: Data, changes: list[Change]) -> Iterator[dict[str, Array]]:
    """Yield for each output the waves of the length that repeats most clearly in what the effects leave."""
    if data.time is None or not data.has("speed"):
        return
    rest = residual(data, changes)
    share = data.get("normal_load") / data.nominal.load
    for output in data.outputs:
        length = strongest_length(data, rest[output])
        if length is None:
            continue
        phase = 2.0 * np.pi * data.states.distance / length
        waves = [f(k * phase) * share for k in range(1, _HARMONICS + 1) for f in (np.cos, np.sin)]
        own = np.column_stack(waves)
        yield {o: own if o == output else np.zeros_like(own) for o in data.outputs}


def strongest_length(data: Data, rest: Array) -> float | None:
    """Return the length (m) at which a residual has most power in its first two harmonics together.

    The smaller of the two counts: at twice the wheel's circumference the second harmonic is what the wheel
    does once a turn, and there is no first one.

    Parameters
    ----------
    data : Data
    rest : ndarray, shape (n,)

    Returns
    -------
    float or None
        None if too little was rolled, or sampling is too coarse to tell.
    """
    rolled = data.states.distance
    way = float(rolled[-1] - rolled[0])
    step = float(np.median(np.diff(rolled)))
    if way < INDEPENDENT_STRETCHES * _CIRCUMFERENCES[1] or not 0.0 < step < _CIRCUMFERENCES[0] / (
        2 * _HARMONICS
    ):
        return None
    even = np.arange(rolled[0], rolled[-1], step)
    fast = rest - data.running_mean(rest, 1.0)
    power = np.abs(np.fft.rfft(np.interp(even, rolled, fast), _PADDED * even.size)) ** 2
    per_metre = np.arange(power.size) / (_PADDED * even.size * step)
    first = np.flatnonzero((per_metre >= 1.0 / _CIRCUMFERENCES[1]) & (per_metre <= 1.0 / _CIRCUMFERENCES[0]))
    turns = 1.0 / per_metre[first] / (2.0 * np.pi * data.nominal.radius)
    first = first[(turns < OF_A_TURN[0]) | (turns > OF_A_TURN[1])]
    first = first[2 * first < power.size]
    if first.size == 0:
        return None
    best = first[int(np.argmax(np.minimum(power[first], power[2 * first])))]
    return float(1.0 / per_metre[best])
