"""A channel that stays constant although it should not."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tire_pipeline.channels import OPERATING_CHANNELS
from tire_pipeline.mismatch.effects.base import Array, Effect, Finding
from tire_pipeline.mismatch.effects.context import Context, Simulate
from tire_pipeline.mismatch.effects.shared import CLIPPED

_CHANNELS_LOOKED_AT = ("fy", "fx", "mz", *OPERATING_CHANNELS)


class StuckChannel(Effect):
    """A live channel repeats one value exactly for a long time.

    Covers exact repeats of 25 samples and more, far longer than any near them, that end with a jump. Not
    covered: a channel that is stuck but for its noise.
    """

    name = "stuck_channel"
    kind = "artefact"
    title = "a stuck channel"
    equation = "x recorded (t) = x(t_stuck) for a while"
    source = "bus or acquisition fault"
    looks_like = {"clipping": "clipping is at an end of the range"}
    experiment = "repeat the recording"
    needs_time = True
    found_in = "samples"
    in_one_stretch = True

    def absent(self, data: Context) -> str | None:
        """Never a candidate of the fit: it is found in the channel itself."""
        return "looked for in the channel itself, not by a fit"

    def detect(self, channels: Mapping[str, Array], simulate: Simulate) -> list[Finding]:
        """Find long runs of one value in channels that otherwise change all the time."""
        found = []
        for name in _CHANNELS_LOOKED_AT:
            if name not in channels:
                continue
            bad, value = _stuck(channels[name], once=name not in CLIPPED)
            if bad is None:
                continue
            text = f"{name} repeats {value:.6g} exactly for {int(bad.sum())} samples"
            parameters = {"value": (value, 0.0, "as recorded")}
            found.append(Finding(self.name, name, text, parameters, {}, bad))
        return found


def _stuck(x: Array, *, once: bool) -> tuple[Array | None, float]:
    """Runs of at least 25 equal samples, where a run is usually one or two samples long.

    Those at an end of the range are clipping; where none is looked for, one alone may be there by chance.
    """
    n = x.size
    if n < 60:
        return None, 0.0
    starts, lengths = _runs(np.diff(x) != 0.0)
    usual = max(np.quantile(lengths, 0.9), np.quantile(_straight(x), 0.9))
    long = lengths >= max(_SHORTEST, 20.0 * usual)
    if not long.any() or (starts.size - long.sum()) < 0.3 * n / max(usual, 1.0) * 0.2:
        return None, 0.0
    low, high = np.nanmin(x), np.nanmax(x)
    bad = np.zeros(n, bool)
    value = float("nan")
    for first, length in zip(starts[long], lengths[long], strict=True):
        if x[first] in (low, high) and not (once and (x == x[first]).sum() == length):
            continue
        if length < _FAR_LONGER * _longest_beside(starts, lengths, first, length):
            continue
        if _at_rest(x, first, first + length - 1):
            continue
        bad[first : first + length] = True
        value = float(x[first])
    return (bad, value) if bad.any() else (None, 0.0)


def _runs(changes: Array) -> tuple[Array, Array]:
    """Return where runs begin, and their lengths, from whether the next sample (n - 1,) is of another run."""
    starts = np.r_[0, np.flatnonzero(changes) + 1]
    return starts, np.diff(np.r_[starts, changes.size + 1])


def _straight(x: Array) -> Array:
    """Return the lengths over which a channel goes straight: a slow one, brought to a faster clock by lines.

    It repeats a value for as many samples as lie between two of its own, without being stuck.
    """
    bent = np.abs(np.diff(x, 2)) > np.sqrt(np.finfo(float).eps) * np.ptp(x)
    return _runs(bent)[1]


def _at_rest(x: Array, first: int, last: int) -> bool:
    """Whether a channel comes to a value and leaves it without a jump: then it rests there, and is not stuck.

    A simulated load rests on a straight. One that was stuck jumps to where it would have been, or goes there
    on a straight line where it was brought to a faster clock. From rest, the first step is the smallest.
    """
    least = _NO_STEP * float(np.ptp(x))
    sides = (x[last : last + _SHORTEST + 1], x[max(first - _SHORTEST, 0) : first + 1][::-1])
    away = [np.abs(side - side[0]) for side in sides if side.size > 1]
    return all(side[1] <= max(0.5 * side[-1] / (side.size - 1), least) for side in away)


_SHORTEST = 25
"""Samples that a stuck channel repeats at least."""
_NO_STEP = 1e-9
_FAR_LONGER = 5
_LENGTHS_AROUND = 10
"""A slow signal in few digits, at its crest or brought to a faster clock, repeats its values for ever longer
and ever shorter; one that is stuck stands out from what lies so many times its length before and after."""


def _longest_beside(starts: Array, lengths: Array, first: int, length: int) -> int:
    """Return the longest other run in the stretches before and after a run."""
    low, high = first - _LENGTHS_AROUND * length, first + (1 + _LENGTHS_AROUND) * length
    near = (starts + lengths > low) & (starts < high) & (starts != first)
    return int(lengths[near].max(initial=0))
