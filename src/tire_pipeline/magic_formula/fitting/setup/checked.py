"""The table that a fit is given, checked before anything is computed."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.channels import FORCE_CHANNELS
from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula.parameters.points import POINT_CHANNELS


def check_table(recording: Any) -> None:
    """Raise if a recording is no table, or has a channel twice.

    Raises
    ------
    RecordingError
    """
    if not isinstance(recording, pd.DataFrame):
        raise RecordingError(
            f"the recording is of type {type(recording).__name__}, which is no DataFrame",
            todo="read it with read_recording",
        )
    names = list(recording.columns)
    twice = [name for name in (*POINT_CHANNELS, *FORCE_CHANNELS) if names.count(name) > 1]
    if twice:
        raise RecordingError(
            f"there are several columns of the name {', '.join(twice)}", todo="keep one of each"
        )


def numbers(recording: pd.DataFrame, name: str, unused: Collection[str] = ()) -> np.ndarray:
    """Return a column as numbers, NaN where its square is none: nothing can be fitted to it.

    Parameters
    ----------
    recording : DataFrame
    name : str
    unused : collection of str
        Columns whose text does not matter.

    Raises
    ------
    RecordingError
        Values are text, or something else that is no number. It names the first one, and its row.
    """
    column = recording[name]
    if pd.api.types.is_numeric_dtype(column):
        x = column.to_numpy(dtype=float, na_value=np.nan)
    else:
        x = pd.to_numeric(column.astype(object), errors="coerce").to_numpy(dtype=float, na_value=np.nan)
        if name not in unused:
            check_no_text(column, x)
    with np.errstate(over="ignore", invalid="ignore"):
        return np.where(np.isfinite(x * x), x, np.nan)


def check_no_text(column: pd.Series, values: np.ndarray) -> None:
    """Raise if a column holds something that became no number.

    Parameters
    ----------
    column : Series
        As it was given, under its name.
    values : ndarray, shape (n,)
        Its numbers; NaN where there is none.

    Raises
    ------
    RecordingError
        It names the first such value, and its row.
    """
    lost = np.isnan(values) & column.notna().to_numpy()
    if lost.any():
        first = int(lost.argmax())
        raise RecordingError(
            f"{int(lost.sum())} of {values.size} values are no numbers, the first in row {first}: "
            f"{column.iloc[first]!r}",
            where=str(column.name),
            todo="convert the column, or put NaN where nothing was measured",
        )
