"""The caller's input: a tire model, and a table whose known columns are numbers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.channels import FORCE_CHANNELS, INPUT_CHANNELS, RECORDED_CHANNELS
from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula.fitting.setup.checked import check_no_text
from tire_pipeline.pages.numbers_in_words import in_digits
from tire_pipeline.recordings.check import repeated_channels
from tire_pipeline.recordings.spikes import without_spikes
from tire_pipeline.recordings.unit_jumps import unit_jumps

SPIKES = "spikes"
"""Key of what was said of spikes, in the attributes of a recording."""


def usable_numbers(recording: Any) -> pd.DataFrame:
    """Return a recording with its known columns as numbers, and NaN where a value is a spike.

    Where an input is one, there is no force to compare either.

    Parameters
    ----------
    recording : pandas.DataFrame
        It stays as it is.

    Returns
    -------
    pandas.DataFrame
        ``attrs["spikes"]`` says what was left out.

    Raises
    ------
    RecordingError
        As :func:`numeric`.
    """
    known = _with_unit_changes(numeric(recording))
    whole, remarks = without_spikes(known)
    if not remarks:
        return whole
    lost = [whole[n].isna() & known[n].notna() for n in INPUT_CHANNELS if n in whole]
    rows = np.flatnonzero(np.any(lost, axis=0))
    whole = without_values(whole, {n: rows for n in FORCE_CHANNELS if n in whole})
    whole.attrs = {**whole.attrs, SPIKES: [*whole.attrs.get(SPIKES, []), *remarks]}
    return whole


def _with_unit_changes(recording: pd.DataFrame) -> pd.DataFrame:
    """Return a recording whose remarks begin with the channels that seem to change their unit."""
    key = "assumed" if "assumed" in recording.attrs else SPIKES
    said = recording.attrs.get(key, [])
    remarks = [
        f"{jump}, it seems (it jumps by {in_digits(jump.ratio)}): nothing below holds until that is settled"
        for jump in unit_jumps(recording)
    ]
    if not remarks or remarks[0] in said:
        return recording
    changed = recording.copy(deep=False)
    changed.attrs = {**recording.attrs, key: [*remarks, *said]}
    return changed


def without_values(recording: pd.DataFrame, rows: Mapping[str, np.ndarray]) -> pd.DataFrame:
    """Return a recording with NaN in some rows of some columns; the same object where there are none.

    Parameters
    ----------
    recording : pandas.DataFrame
    rows : mapping of ndarray of int
        Column -> rows.
    """
    changed = {name: recording[name].to_numpy(dtype=float, na_value=np.nan).copy() for name in rows}
    for name, values in changed.items():
        values[rows[name]] = np.nan
    return recording.assign(**changed) if changed else recording


def numeric(recording: Any) -> pd.DataFrame:
    """Return a recording with its known columns as numbers; the same object where they are.

    Numbers that came as text become numbers, and dates seconds from the first one. A number so large that its
    square is none is missing: no channel reaches it. A column without any number is left out.

    Parameters
    ----------
    recording : pandas.DataFrame

    Raises
    ------
    RecordingError
        It is no table, a known column is there twice, or holds something other than numbers.
    """
    if not isinstance(recording, pd.DataFrame):
        raise RecordingError("the recording is not a DataFrame", todo="read it with read_recording")
    twice = repeated_channels(recording)
    if twice:
        raise RecordingError(
            f"there are several columns of the name {', '.join(twice)}", todo="keep one of each"
        )
    names = [n for n in recording.columns if n in RECORDED_CHANNELS or str(n).startswith("simulated_")]
    other = [n for n in names if not pd.api.types.is_numeric_dtype(recording[n])]
    changed = {str(n): _numbers(recording[n]) for n in other}
    for name in names:
        x = changed.get(str(name), recording[name]).to_numpy(dtype=float, na_value=np.nan)
        with np.errstate(over="ignore", invalid="ignore"):
            beyond = np.isfinite(x) & ~np.isfinite(x * x)
        if beyond.any():
            changed[str(name)] = pd.Series(np.where(beyond, np.nan, x), recording.index)
    return _without_empty(recording.assign(**changed) if changed else recording, names)


def _without_empty(recording: pd.DataFrame, names: Iterable[str]) -> pd.DataFrame:
    """Leave out columns without any number, and note it: such a channel is not recorded."""
    finite = (np.isfinite(recording[n].to_numpy(dtype=float, na_value=np.nan)).any() for n in names)
    empty = [] if len(recording) == 0 else [n for n, some in zip(names, finite, strict=True) if not some]
    if not empty:
        return recording
    known = recording.drop(columns=empty)
    note = f"{', '.join(empty)}: no number in the column, so the channel counts as not recorded"
    known.attrs = {**recording.attrs, "notes": [*recording.attrs.get("notes", []), note]}
    return known


def _numbers(column: pd.Series) -> pd.Series:
    if pd.api.types.is_datetime64_any_dtype(column):
        return (column - column.min()).dt.total_seconds()
    values = pd.to_numeric(column, errors="coerce")
    check_no_text(column, values.to_numpy(dtype=float, na_value=np.nan))
    return values.astype(float)


def check_tire(tire: Any) -> None:
    """Raise if something other than a tire model was passed.

    Raises
    ------
    RecordingError
        It has no forces.
    """
    if tire is not None and not (hasattr(tire, "forces") and hasattr(tire, "coefficients")):
        raise RecordingError(
            f"the tire is of type {type(tire).__name__}, which is no tire model",
            todo='read it with read_tir("file.tir")',
        )
