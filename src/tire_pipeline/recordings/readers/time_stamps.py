"""Dates and times of day in text."""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

_DAYS_FIRST = re.compile(r"(\d{1,2})\.(\d{1,2})\.(\d{4})")
_DAY = 86_400.0
_LEAST_STAMPS = 0.9
"""Share of cells that must be stamps."""


class Stamps(NamedTuple):
    """Time stamps of a column.

    Parameters
    ----------
    seconds : ndarray
        From the first one, s; NaN where a cell is no stamp.
    kind : str
        What they are, in words.
    """

    seconds: NDArray[np.float64]
    kind: str


def seconds_of(texts: pd.Series, decimal: str = ".") -> Stamps | None:
    """Read a column of dates or of times of day; None if it is neither.

    A time of day goes on over midnight. Dates are those of ISO 8601, or have the day first and points. With
    strokes either may come first, day or month, so such dates are not read.

    Parameters
    ----------
    texts : Series of str
    decimal : str
        Decimal sign of the seconds.

    Examples
    --------
    >>> seconds_of(pd.Series(["31.12.2025 23:59:59,5", "01.01.2026 00:00:00"]), ",").seconds.tolist()
    [0.0, 0.5]
    >>> seconds_of(pd.Series(["23:59:59.5", "00:00:00.0", "00:00:00.5"])).seconds.tolist()
    [0.0, 0.5, 1.0]
    """
    texts = texts.str.replace(_DAYS_FIRST, _iso, regex=True)
    texts = texts.str.replace(decimal, ".", regex=False)
    dates = pd.to_datetime(texts, errors="coerce", format="ISO8601", utc=True)
    if dates.notna().mean() > _LEAST_STAMPS:
        return Stamps((dates - dates.min()).dt.total_seconds().to_numpy(dtype=float), "dates")
    hours = pd.to_timedelta(texts.where(texts.str.contains(":")), errors="coerce").dt.total_seconds()
    if hours.notna().mean() > _LEAST_STAMPS:
        seconds = _over_midnight(hours.to_numpy(dtype=float))
        return Stamps(seconds - np.nanmin(seconds), "hours, minutes and seconds")
    return None


def _iso(found: re.Match[str]) -> str:
    day, month, year = found.groups()
    return f"{year}-{month:0>2}-{day:0>2}"


def _over_midnight(seconds: NDArray[np.float64]) -> NDArray[np.float64]:
    """Times of day, a day later after each step back by more than half a day."""
    held = np.flatnonzero(np.isfinite(seconds))
    days = np.cumsum(np.diff(seconds[held], prepend=seconds[held[0]]) < -_DAY / 2.0)
    out = seconds.copy()
    out[held] += days * _DAY
    return out
