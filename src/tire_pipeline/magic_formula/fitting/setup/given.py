"""Inputs of a fit: the coefficients known beforehand, and the points of each stage."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pandas as pd

from tire_pipeline.channels import FORCE_OF_SLIP
from tire_pipeline.magic_formula.fitting.setup.measured import bulk
from tire_pipeline.magic_formula.fitting.setup.stage_definitions import (
    PURE_SLIP,
    PURE_SLIP_ANGLE,
    PURE_SLIP_RATIO,
    Stage,
)
from tire_pipeline.magic_formula.model import TireModel
from tire_pipeline.magic_formula.parameters.assumed_radius import ASSUMED_RADIUS
from tire_pipeline.magic_formula.parameters.coefficients import family_of
from tire_pipeline.pages.numbers_in_words import in_digits
from tire_pipeline.small_loads import radius_of_file


def base(
    recording: pd.DataFrame,
    version: str,
    start: TireModel | None,
    points: Mapping[str, np.ndarray],
    nominal_load: float | None,
    unloaded_radius: float | None,
) -> tuple[dict[str, float], list[str]]:
    """Return the coefficients that are known before any fit, and what was assumed."""
    notes: list[str] = []
    known: dict[str, float] = {}
    if start is not None:
        begin = start.to_version(version)
        begin = begin if nominal_load is None else begin.nominal_load_changed(nominal_load)
        known.update(begin.coefficients)
    median = float(np.median(points["normal_load"]))
    if nominal_load is None:
        nominal_load = known.get("FNOMIN", float(f"{median:.2g}"))
        if start is None:
            notes.append(f"FNOMIN = {nominal_load:g} N is the median load to two digits")
    known["FNOMIN"] = float(nominal_load)
    if unloaded_radius is None and "UNLOADED_RADIUS" not in known:
        unloaded_radius = radius_of_file(recording)
        if not np.isfinite(unloaded_radius):
            unloaded_radius = ASSUMED_RADIUS
            notes.append(
                f"UNLOADED_RADIUS = {ASSUMED_RADIUS:g} m is assumed{_beside_loaded(recording)}; the moments' "
                "coefficients are relative to it: state it with unloaded_radius (tire fit: --unloaded-radius)"
            )
    if unloaded_radius is not None:
        known["UNLOADED_RADIUS"] = float(unloaded_radius)
    known.setdefault("LONGVL", _median(points["speed"], 16.7))
    if family_of(version) == 6:
        known.setdefault("NOMPRES", _median(points["pressure"], 220_000.0))
        known.setdefault("INFLPRES", known["NOMPRES"])
    return known, notes


def _median(x: np.ndarray, otherwise: float) -> float:
    finite = x[np.isfinite(x)]
    return float(np.median(finite)) if finite.size else otherwise


def filled(x: np.ndarray, value: float) -> np.ndarray:
    """Return the channel with a value where it has none."""
    return np.where(np.isfinite(x), x, value)


def choose(stage: Stage, points: Mapping[str, np.ndarray], measured: np.ndarray) -> np.ndarray:
    """Return the rows of a stage."""
    rolling, straight = pure(points)
    which = np.isfinite(measured)
    if stage.points == "lateral":
        which &= rolling
    elif stage.points == "longitudinal":
        which &= straight
        if not (which & ~rolling).any() or stands_off_zero("slip_ratio", points, which):
            which &= False
    elif stage.points == "combined":
        relies_on = tuple(FORCE_OF_SLIP) if stage.output == "fx" else ("slip_ratio",)
        held = [stands_off_zero(name, points, which) for name in relies_on]
        which &= ~rolling & ~straight & (not any(held))
    return np.flatnonzero(which)


def from_combined(
    stage: Stage, points: Mapping[str, np.ndarray], measured: np.ndarray
) -> tuple[np.ndarray, str]:
    """Return the rows at combined slip that tell of a stage at pure slip, and what is said of it.

    Where the other slip stands still, nothing tells its part in the force. Then there are all rows, and the
    force is that at this slip.
    """
    which = np.isfinite(measured)
    other = "slip_angle" if stage.points == "longitudinal" else "slip_ratio"
    if stage.points == "combined" or not stands_off_zero(other, points, which):
        both = choose(replace(stage, points="combined"), points, measured)
        return both, f"{stage.title} was not measured: told from combined slip"
    if stage.points == "longitudinal" and stands_off_zero("slip_ratio", points, which):
        which &= False
    at = in_digits(float(np.median(points[other][which]))) if which.any() else ""
    said = f"{other} is {at} throughout, and {stage.output.capitalize()} there is taken for that without it"
    return np.flatnonzero(which), f"{stage.title} was not measured: {said}"


def stands_off_zero(name: str, points: Mapping[str, np.ndarray], which: np.ndarray) -> bool:
    """Whether a slip stays at one value other than zero, but for odd rows.

    Then the force without this slip cannot be told from its part in the force: a slip that was not measured,
    or measured with another rolling radius, would double the force at pure slip.
    """
    if not which.any():
        return False
    within = PURE_SLIP[name]
    low, high = bulk(points[name][which])
    return min(abs(low), abs(high)) > within and high - low <= within


def pure(points: Mapping[str, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Which points roll freely, and which have no slip angle."""
    rolling = np.abs(points["slip_ratio"]) <= PURE_SLIP_RATIO
    return rolling, np.abs(points["slip_angle"]) <= PURE_SLIP_ANGLE


def braking_alone(points: Mapping[str, np.ndarray], fy: np.ndarray, most: int) -> np.ndarray:
    """Return points at pure longitudinal slip, spread over the recording.

    They show the side force that braking or driving makes (RVY1 to RVY6). Combined slip measured at a few
    slip angles leaves it open between them.
    """
    rolling, straight = pure(points)
    rows = np.flatnonzero(np.isfinite(fy) & straight & ~rolling)
    return rows[:: max(1, -(-rows.size // most))]


def _beside_loaded(recording: pd.DataFrame) -> str:
    """What the recording holds of the loaded radius, beside which an assumed radius is judged."""
    loaded = _median(recording["loaded_radius"], 0.0) if "loaded_radius" in recording else 0.0
    return f", and the median of the recorded loaded radius is {loaded:.3g} m" if loaded > 0.0 else ""
