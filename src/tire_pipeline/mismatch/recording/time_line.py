"""The time line of a recording: where it is interrupted, and the rate at which it is used."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings.check import BREAK_OF_TIME_LINE, LONG_GAP
from tire_pipeline.recordings.whole_rows import LONGEST_HOLE

Array = np.ndarray
_LEAST_RATE = 50.0
"""Hz, at which forces are weighed."""


def rising_time(arrays: Mapping[str, Array]) -> Array | None:
    """Return the time stamps, s, shape (n,), or None without any.

    Raises
    ------
    RecordingError
        If they do not rise.
    """
    if "time" not in arrays:
        return None
    time = arrays["time"]
    known = time[np.isfinite(time)]
    if known.size == 0:
        return None
    steps = np.diff(known)
    if np.any(steps < 0.0):
        at = int(np.flatnonzero(steps < 0.0)[0]) + 1
        raise RecordingError(
            f"time goes backwards {int((steps < 0).sum())} times, first at sample {at}",
            where="time",
            todo="sort the recording, or split it where it starts again",
        )
    if np.any(steps == 0.0):
        at = int(np.flatnonzero(steps == 0.0)[0]) + 1
        raise RecordingError(
            f"{int((steps == 0).sum())} time stamps are repeated, first at sample {at}",
            where="time",
            todo="use a finer clock, or average the rows of one stamp",
        )
    return time


def beginnings(time: Array | None, size: int, rows: Array | None = None) -> Array:
    """Return where uninterrupted pieces of a recording begin.

    Parameters
    ----------
    time : ndarray, shape (n,), or None
        s. Without it all samples are one piece.
    size : int
        Samples, n.
    rows : ndarray of int, shape (n,), optional
        Row of the recording of each sample, if rows were left out.

    Returns
    -------
    ndarray of bool, shape (n,)
    """
    start = np.zeros(size, bool)
    start[:1] = True
    if time is not None and size > 1:
        steps = np.diff(time)
        start[1:] = (steps > BREAK_OF_TIME_LINE * np.median(steps)) | (steps <= 0.0)
        if rows is not None:
            start[1:] |= np.diff(rows) > LONGEST_HOLE
    return start


def seams(joined: Sequence[Mapping[str, Any]], rows: Array) -> Array:
    """Return which samples are the first of a recording that follows another one.

    Parameters
    ----------
    joined : sequence of mapping
        ``attrs["joined"]`` of :func:`tire_pipeline.recordings.join_recordings`; empty for one recording.
    rows : ndarray of int, shape (n,)
        Row of the joined recording of each sample, rising.

    Returns
    -------
    ndarray of bool, shape (n,)
    """
    result = np.zeros(rows.size + 1, bool)
    result[np.searchsorted(rows, [part["first"] for part in joined[1:]])] = True
    return result[:-1]


def long_gaps(time: Array | None, start: Array, seam: Array) -> list[str]:
    """Say how many interruptions are long enough that states are unknown after them.

    The time between two recordings that were joined is none: joining them is said by itself.
    """
    if time is None:
        return []
    steps = np.diff(time)
    lengths = steps[start[1:] & ~seam[1:]]
    count = int((lengths > LONG_GAP * np.median(steps)).sum())
    if not count:
        return []
    said = f"{count} gaps in the time line, the longest" if count > 1 else "a gap in the time line of"
    return [f"{said} {lengths.max():.3g} s"]


def averaged(
    arrays: dict[str, Array], time: Array | None, start: Array, rows: Array
) -> tuple[dict[str, Array], Array | None, Array, Array]:
    """Average neighbours so that the rate is 50 to 100 Hz; nothing is averaged over a gap.

    Parameters
    ----------
    arrays : dict of str to ndarray, shape (n,)
    time : ndarray, shape (n,), or None
        s.
    start : ndarray of bool, shape (n,)
        Of :func:`beginnings`.
    rows : ndarray of int, shape (n,)
        Row of the recording of each sample.

    Returns
    -------
    arrays, time, start, rows
        The same of what is left; as they came without a time line.
    """
    if time is None:
        return arrays, time, start, rows
    rate = 1.0 / max(float(np.median(np.diff(time))), 1e-9)
    m = int(rate / _LEAST_RATE + 1e-6)
    if m < 2:
        return arrays, time, start, rows
    piece = np.cumsum(start) - 1
    first = np.flatnonzero(start)[piece]
    group = (np.arange(rows.size) - first) // m
    edges = np.flatnonzero(np.r_[True, (np.diff(group) != 0) | (np.diff(piece) != 0)])
    size = np.diff(np.r_[edges, rows.size])
    keep = size >= max(1, m // 2)
    mean = {n: (np.add.reduceat(a, edges) / size)[keep] for n, a in arrays.items()}
    stamps = (np.add.reduceat(time, edges) / size)[keep]
    begins = np.add.reduceat(start.astype(int), edges)[keep] > 0
    begins[0] = True
    return mean, stamps, begins, rows[edges][keep]
