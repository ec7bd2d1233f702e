"""What no tire has of a recording: loads, pressures and radii, and a force fx at no slip."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd

from tire_pipeline.channels import LARGEST_LOAD_OF_MODEL_CARS, TIRE_PRESSURES, TIRE_RADII
from tire_pipeline.magic_formula.parameters.assumed_radius import ASSUMED_RADIUS
from tire_pipeline.pages.numbers_in_words import in_digits
from tire_pipeline.small_loads import in_another_unit_as

MOST_ROLLING_RESISTANCE = 0.05
"""Over the load; tires of cars and trucks have 0.005 to 0.02, soft or flat ones a little more."""


def unlike_tires(
    recording: pd.DataFrame,
    points: Mapping[str, np.ndarray],
    base: Mapping[str, float],
    stated: bool,
) -> tuple[str, list[str]]:
    """Return what no tire has, as the likely reason of a poor fit, or nothing; and notes.

    Parameters
    ----------
    recording : DataFrame
        As it was given.
    points : mapping of ndarray
        Its whole rows; NaN for a pressure that was not recorded.
    base : mapping of str to float
        The coefficients that are known before the fit; with ``NOMPRES`` in versions that use the pressure.
    stated : bool
        Whether the caller gave a nominal load or a tire model, which says what loads this tire has.
    """
    load, pressure = (float(np.median(points[name])) for name in ("normal_load", "pressure"))
    radius = base.get("UNLOADED_RADIUS", np.nan)
    if "NOMPRES" in base and not np.isnan(pressure) and not _within(pressure, TIRE_PRESSURES):
        return f"units; no tire has a pressure of {in_digits(pressure)} Pa, look at that of pressure.", []
    if not np.isnan(radius) and not _within(radius, TIRE_RADII):
        return f"units; no tire has an unloaded radius of {in_digits(radius)} m, state it in metres.", []
    told = in_another_unit_as(recording, load, np.nan if radius == ASSUMED_RADIUS else radius)
    if stated and load < LARGEST_LOAD_OF_MODEL_CARS <= base["FNOMIN"]:
        told.append(f"the nominal load is {in_digits(base['FNOMIN'])} N")
    if told:
        return (
            f"units; a load of {in_digits(load)} N is a model car's, but {', and '.join(told)}: "
            "look at those of normal_load and of the forces (newtons).",
            [],
        )
    if load < LARGEST_LOAD_OF_MODEL_CARS and not stated:
        return "", [f"a load of {in_digits(load)} N is a model car's: check the unit if this is another tire"]
    return "", []


def braked_at_no_slip(load: np.ndarray, fx: np.ndarray) -> str:
    """Return that the wheel braked or was driven in a recording that says nowhere by which slip, or nothing.

    Parameters
    ----------
    load, fx : ndarray
        Without a number in some rows.
    """
    good = np.isfinite(fx) & (np.abs(load) > 0.0)
    share = fx[good] / np.abs(load[good])
    if not share.size or float(np.std(share)) <= MOST_ROLLING_RESISTANCE:
        return ""
    most = in_digits(float(np.quantile(np.abs(share), 0.98)))
    return f"no slip ratio was measured, but fx changes, up to {most} of the load"


def _within(value: float, limits: tuple[float, float]) -> bool:
    return limits[0] <= value <= limits[1]
