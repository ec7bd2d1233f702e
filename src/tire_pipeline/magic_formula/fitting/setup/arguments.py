"""Arguments of a fit, checked before anything is computed."""

from __future__ import annotations

import os
from numbers import Integral
from typing import Any

import numpy as np

from tire_pipeline.errors import DomainError, did_you_mean
from tire_pipeline.magic_formula.model import TireModel
from tire_pipeline.magic_formula.parameters.assumed_radius import check_stated_radius

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
