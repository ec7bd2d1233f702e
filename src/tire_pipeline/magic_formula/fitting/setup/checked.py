"""What a caller passes to a fit, checked before anything is computed."""

from __future__ import annotations

import os
from collections.abc import Collection
from numbers import Integral
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.channels import FORCE_CHANNELS
from tire_pipeline.errors import DomainError, RecordingError, did_you_mean
from tire_pipeline.magic_formula.model import TireModel
from tire_pipeline.magic_formula.parameters.assumed_radius import check_stated_radius
from tire_pipeline.magic_formula.parameters.points import POINT_CHANNELS

FIT_LOSSES = ("soft_l1", "huber", "cauchy", "arctan", "linear")
"""What :func:`scipy.optimize.least_squares` knows."""


def check_arguments(
    start: Any, nominal_load: Any, unloaded_radius: Any, starts: Any, loss: Any, seed: Any
) -> None:
    """Raise if an argument of a fit is none that it can use.

    Raises
    ------
    DomainError
        It names the argument, and says what to pass.
    TirValueError
        The radius is no tire's.
    """
    check_start(start)
    _whole_number("starts", starts, 1)
    _whole_number("seed", seed, 0)
    if not isinstance(loss, str) or loss not in FIT_LOSSES:
        known = f"use one of {', '.join(FIT_LOSSES)}"
        raise DomainError(
            f"there is no loss {loss!r}", where="loss", todo=did_you_mean(str(loss), FIT_LOSSES, known)
        )
    if nominal_load is not None and not _positive(nominal_load):
        raise DomainError(
            f"{nominal_load!r} is no load", where="nominal_load", todo="pass newtons, or leave it out"
        )
    if unloaded_radius is not None:
        check_stated_radius(unloaded_radius)


def check_start(start: Any) -> None:
    """Raise if a fit is to start from something other than a tire model.

    Raises
    ------
    DomainError
        It says how to make one of what was passed.
    """
    if start is None or isinstance(start, TireModel):
        return
    todo = "pass a TireModel"
    if isinstance(start, str | os.PathLike):
        todo = f"read the file: start=read_tir({os.fspath(start)!r})"
    elif isinstance(getattr(start, "model", None), TireModel):
        todo = "pass its model: start=result.model"
    raise DomainError(f"a {type(start).__name__} is no tire model", where="start", todo=todo)


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


def _whole_number(name: str, value: Any, least: int) -> None:
    if isinstance(value, bool) or not isinstance(value, Integral) or int(value) < least:
        raise DomainError(
            f"{value!r} is no whole number from {least} on", where=name, todo=f"pass one, such as {name}=1"
        )


def _positive(value: Any) -> bool:
    try:
        return bool(np.isfinite(float(value)) and float(value) > 0.0)
    except (TypeError, ValueError):
        return False
