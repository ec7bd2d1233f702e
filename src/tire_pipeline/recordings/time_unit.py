"""Whether time is in seconds: no run is recorded that slowly, or that fast."""

from __future__ import annotations

import numpy as np
import pandas as pd

from tire_pipeline.pages.numbers_in_words import in_digits
from tire_pipeline.recordings.conventions.plausible import unit_stated
from tire_pipeline.recordings.conventions.units import find_unit
from tire_pipeline.recordings.issue import Issue

LONG_STEP = 1.0
"""From sample to sample, s: runs are recorded faster. In a file without units this is often a time in ms."""
_SHORT_STEP = 1e-5
"""From sample to sample, s: no rig and no vehicle records faster. Often a spreadsheet's date, in days."""
_FINER = ("ms", "us", "ns")


def unit_of_time(frame: pd.DataFrame, step: np.ndarray) -> list[Issue]:
    """Report steps of time that are in another unit than seconds, by their size.

    Parameters
    ----------
    frame : DataFrame
        Canonical columns.
    step : ndarray
        From sample to sample, s; NaN where it is not known.
    """
    usual = float(np.nanmedian(step)) if np.isfinite(step).any() else 0.0
    where = f"time, {in_digits(usual)} s from sample to sample"
    if usual > LONG_STEP:
        unit = next((unit for unit in _FINER if usual * _seconds(unit) <= LONG_STEP), "ms")
        todo = f"lags and delays count in seconds: if time is in {unit}, state it: "
        return [Issue("long_time_steps", "warning", where, todo + unit_stated(frame, "time", unit))]
    if 0.0 < usual < _SHORT_STEP:
        todo = (
            "no run is recorded so fast: if time is in days, as a spreadsheet's dates are, state it: "
            f"{unit_stated(frame, 'time', 'day')}; likewise hour"
        )
        return [Issue("short_time_steps", "warning", where, todo)]
    return []


def _seconds(unit: str) -> float:
    found = find_unit(unit)
    return found.factor if found else np.nan
