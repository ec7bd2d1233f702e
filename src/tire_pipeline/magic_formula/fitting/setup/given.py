"""Inputs of a fit: the recording's points and forces, and the coefficients known beforehand."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd

from tire_pipeline.channels import FORCE_CHANNELS, TANGENTIAL_FORCES
from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula.fitting.setup.stage_definitions import (
    PURE_SLIP_ANGLE,
    PURE_SLIP_RATIO,
    Stage,
)
from tire_pipeline.magic_formula.model import TireModel
from tire_pipeline.magic_formula.parameters.assumed_radius import ASSUMED_RADIUS
from tire_pipeline.magic_formula.parameters.coefficients import family_of
from tire_pipeline.magic_formula.parameters.points import POINT_CHANNELS
from tire_pipeline.pages.numbers_in_words import in_digits

FEWEST_POINTS = 10


def columns(
    recording: pd.DataFrame,
) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray], dict[str, str], list[str]]:
    """Return the points and the forces at them, by name, of whole rows; forces left out, and why; notes."""
    if "normal_load" not in recording:
        raise RecordingError("there is no normal_load", todo="name the load's column normal_load, in newtons")
    wanted = [name for name in FORCE_CHANNELS if name in recording]
    if not wanted:
        raise RecordingError("there is no force or moment to fit", todo="name them fx, fy, mx, my, mz")
    load = recording["normal_load"].to_numpy(dtype=float)
    good = np.isfinite(load) & (load > 0)
    points, notes = {}, []
    for name in POINT_CHANNELS:
        missing = np.nan if name in ("speed", "pressure") else 0.0
        column = _numbers(recording, name) if name in recording else np.full(load.size, missing)
        if name == "slip_ratio" and _locked(column):
            notes.append("slip_ratio is -1 throughout, a locked wheel: taken as not measured, and as 0")
            column = np.zeros(load.size)
        if name in recording:
            good &= np.isfinite(column)
        points[name] = column
    if int(good.sum()) < FEWEST_POINTS:
        raise RecordingError(
            f"only {int(good.sum())} points have a positive load and finite slips",
            todo=f"use at least {FEWEST_POINTS}",
        )
    if not {"slip_angle", "slip_ratio"} & set(recording) and set(wanted) - {"mx", "my"}:
        raise RecordingError(
            "neither slip_angle nor slip_ratio is recorded",
            todo="name the columns slip_angle (rad) and slip_ratio: forces follow them",
        )
    forces, left_out = {}, {}
    for name in wanted:
        force = _numbers(recording, name)[good]
        why = _not_measured(name, force)
        if why:
            left_out[name] = why
        elif np.nanmax(np.abs(force)) > 0.0:
            forces[name] = force
    said = [f"{name} {why}" for name, why in left_out.items()]
    if not forces:
        raise RecordingError(
            "no force or moment was measured" + (f": {', '.join(said)}" if said else ""),
            todo="check that the sensor was on, and the unit",
        )
    notes += [f"{text}: not fitted" for text in said]
    return {name: x[good].copy() for name, x in points.items()}, forces, left_out, notes


def _numbers(recording: pd.DataFrame, name: str) -> np.ndarray:
    """Return a column; NaN where its square is no number, as nothing can be fitted to it."""
    x = recording[name].to_numpy(dtype=float)
    with np.errstate(over="ignore", invalid="ignore"):
        return np.where(np.isfinite(x * x), x, np.nan)


def _locked(slip_ratio: np.ndarray) -> bool:
    """Whether the wheel is locked in every row: rigs write -1 where they do not measure the slip."""
    known = slip_ratio[np.isfinite(slip_ratio)]
    return bool(known.size) and bool((known == -1.0).all())


def _not_measured(name: str, force: np.ndarray) -> str:
    """Return why a column is not a measurement; empty if it may be one."""
    known = force[np.isfinite(force)]
    if known.size == 0:
        return "holds no number"
    if name in TANGENTIAL_FORCES and np.ptp(known) == 0.0 and known[0] != 0.0:
        return f"is {in_digits(known[0], 4)} N throughout"
    return ""


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
        unloaded_radius = _radius_of(recording)
        if unloaded_radius is None:
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


def _radius_of(recording: pd.DataFrame) -> float | None:
    constants = recording.attrs.get("constants", {})
    entry = constants.get("OVALLDIA") if isinstance(constants, Mapping) else None
    if not isinstance(entry, Mapping) or not isinstance(entry.get("value"), int | float):
        return None
    factor = {"mm": 1e-3, "m": 1.0, "cm": 1e-2, "inch": 0.0254}.get(str(entry.get("unit")))
    return None if factor is None else 0.5 * factor * float(entry["value"])


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
        if not (which & ~rolling).any():
            which &= False
    elif stage.points == "combined":
        which &= ~rolling & ~straight
    return np.flatnonzero(which)


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
