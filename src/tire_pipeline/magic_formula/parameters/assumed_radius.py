"""The unloaded radius that a caller states, and the one to assume where nobody states one."""

from __future__ import annotations

import math
from typing import Any

from tire_pipeline.channels import TIRE_RADII
from tire_pipeline.errors import TirValueError
from tire_pipeline.magic_formula.parameters.tire_parameters import TireParameters

ASSUMED_RADIUS = 0.32
"""Unloaded radius, m, where nothing states one: about that of a 205/55 R16 (8 inches + 55% of 205 mm)."""


def check_stated_radius(radius: Any) -> None:
    """Raise if a caller states a radius that no tire has.

    Parameters
    ----------
    radius : float
        ``unloaded_radius``, m.

    Raises
    ------
    TirValueError
        It names the argument. Where millimetres would make the radius a tire's, it says so.

    Examples
    --------
    >>> check_stated_radius(0.32)
    """
    try:
        value = float(radius)
    except (TypeError, ValueError):
        value = math.nan
    low, high = TIRE_RADII
    if low <= value <= high:
        return
    todo = "state it in metres (--unloaded-radius), such as 0.32"
    if low <= 1e-3 * value <= high:
        todo = f"state it in metres: {1e-3 * value:g}, if this is in mm (--unloaded-radius {1e-3 * value:g})"
    if value <= 0.0:
        what = f"unloaded_radius = {value:g} must be positive"
    elif math.isfinite(value):
        what = f"unloaded_radius = {value:g} m is no tire's"
    else:
        what = f"unloaded_radius = {radius!r} is not a finite number"
    raise TirValueError(what, key="UNLOADED_RADIUS", todo=todo)


def assumed_radius(tire: TireParameters | None) -> list[str]:
    """Say which radius stands in for one that a tire model lacks.

    Parameters
    ----------
    tire : TireParameters, optional

    Returns
    -------
    list of str
        One sentence, or none if the model states its radius.
    """
    if tire is None or "UNLOADED_RADIUS" in tire.coefficients:
        return []
    return [f"the tire model states no UNLOADED_RADIUS, and {ASSUMED_RADIUS:g} m is taken for it"]
