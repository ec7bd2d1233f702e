"""Whether forces and moments are a tire's: signs of pneumatic trail and camber thrust, arm of the moment."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from tire_pipeline.channels import ANGLE_CHANNELS, FORCE_OF_SLIP, TANGENTIAL_FORCES, TIRE_RADII
from tire_pipeline.magic_formula.fitting.setup.stage_definitions import BOUNDS, PURE_SLIP_RATIO
from tire_pipeline.magic_formula.parameters.camber_thrust import camber_thrust
from tire_pipeline.pages.numbers_in_words import in_digits
from tire_pipeline.recordings.conventions.plausible import FORCE_OVER_LOAD, plausible, size, unit_stated
from tire_pipeline.recordings.issue import Issue
from tire_pipeline.unit_definitions import GRAVITY, POUND_FORCE

_OF_LEAN = ("slip_angle", "camber", "normal_load", "fy")
_SMALL_PART = 0.33
"""Slip angles up to this part of the largest are small: the moment has its peak near that."""
STRAIGHT = 0.5
"""Squared correlation with the slip angle from which a slope is one."""
FEWEST_ROWS = 10
_LARGE_SLIP = 0.12
"""Slip ratio, or slip angle (7 degrees), at which a tire is near its largest force (Pacejka 2012, ch. 1)."""
_LEAST_GRIP = 0.3
"""Of the load: packed snow has 0.2, wet asphalt 0.5 (Wong, Theory of Ground Vehicles, table 1.3)."""
_MOST_APART = 3.0
"""Longitudinal over lateral grip, or the other way round: tires have 0.7 to 1.5."""
_NEWTONS = {"lbf": POUND_FORCE, "kgf": GRAVITY}


def moment_of_other_sign(frame: pd.DataFrame) -> list[Issue]:
    """Report a moment that turns the wheel out of its run, in which no pneumatic trail points.

    At small slip angles the side force acts behind the middle of the contact patch (Pacejka 2012, ch. 1).
    Side force and aligning moment then have slopes of opposite sign over the slip angle, in any axes.

    Parameters
    ----------
    frame : DataFrame
        Canonical columns.
    """
    slopes = _slopes_at_small_slip(frame, ("fy", "mz"))
    if not slopes or slopes[0] * slopes[1] <= 0.0:
        return []
    return [
        Issue(
            "moment_of_other_sign",
            "warning",
            "mz, beside fy at small slip angles",
            "no tire turns the wheel out of its run: bring mz and fy to one axis system, or turn the sign of "
            "mz in the file",
        )
    ]


def side_force_with_the_slip(frame: pd.DataFrame) -> list[Issue]:
    """Report a side force that rises with the slip angle: it falls in ISO W and in SAE axes.

    Parameters
    ----------
    frame : DataFrame
        Canonical columns.
    """
    slopes = _slopes_at_small_slip(frame, ("fy",))
    if not slopes or slopes[0] <= 0.0:
        return []
    return [
        Issue(
            "side_force_of_other_sign",
            "warning",
            "fy, which rises with the slip angle",
            'in ISO and in SAE axes it falls: the file is in adapted SAE axes (axes="adapted SAE", --axes '
            "adapted-SAE), or fy or slip_angle has the other sign",
        )
    ]


def side_force_away_from_the_lean(frame: pd.DataFrame) -> list[Issue]:
    """Report a side force that points away from the side to which the wheel leans.

    Parameters
    ----------
    frame : DataFrame
        Canonical columns.
    """
    columns = _columns(frame, _OF_LEAN)
    if not columns or camber_thrust(*columns) <= 0.0:
        return []
    return [
        Issue(
            "camber_of_other_sign",
            "warning",
            "fy, beside camber at small slip angles",
            'a wheel is pushed to the side to which it leans: the file is in SAE axes (axes="SAE", --axes '
            "SAE), or its camber has the other sign",
        )
    ]


def moment_beyond_reach(frame: pd.DataFrame) -> list[Issue]:
    """Report an aligning moment whose arm is longer than the wheel's radius: no contact patch is.

    Parameters
    ----------
    frame : DataFrame
        Canonical columns.
    """
    sizes = {n: size(*held) for n in ("mz", *TANGENTIAL_FORCES) if (held := _columns(frame, (n,)))}
    force = max((x for n, x in sizes.items() if n != "mz" and x > 0.0), default=0.0)
    if not force or not sizes.get("mz", 0.0) > 0.0:
        return []
    radii = [size(*held) for n in ("loaded_radius", "effective_radius") if (held := _columns(frame, (n,)))]
    longest = max((r for r in radii if plausible("loaded_radius", r)), default=TIRE_RADII[1])
    arm = sizes["mz"] / force
    if not arm > longest:
        return []
    where = f"mz, up to {in_digits(sizes['mz'])} N m beside forces of up to {in_digits(force)} N"
    todo = (
        f"an arm of {in_digits(arm)} m is longer than the wheel's radius: look at the units of mz and forces"
    )
    return [Issue("implausible_moment", "warning", where, todo)]


def slip_too_small(frame: pd.DataFrame) -> list[Issue]:
    """Report a slip so small that the slip stiffness would be beyond any tire's: radians taken for degrees.

    Parameters
    ----------
    frame : DataFrame
        Canonical columns.
    """
    issues = []
    for slip, force in FORCE_OF_SLIP.items():
        columns = _columns(frame, (slip, "normal_load", force))
        if not columns:
            continue
        x, load, y = columns
        good = np.isfinite(x) & np.isfinite(y) & (np.abs(load) > 0.0)
        another_unit = size(y) > FORCE_OVER_LOAD[1] * size(load)  # than the slip's is wrong
        if good.sum() < FEWEST_ROWS or another_unit:
            continue
        stiffness = abs(_slope(x[good], y[good] / np.abs(load[good])))
        most = BOUNDS[f"PK{force[1].upper()}1"][1]
        if stiffness > most:
            unit = " rad" if slip in ANGLE_CHANNELS else ""
            where = f"{slip}, up to {in_digits(size(x))}{unit}"
            todo = (
                f"a slip stiffness of {in_digits(stiffness)} times the load is beyond any tire's "
                f"({in_digits(most)}): look at the units of {slip}, {force} and normal_load"
            )
            issues.append(Issue("implausible_stiffness", "warning", where, todo))
    return issues


def _slopes_at_small_slip(frame: pd.DataFrame, outputs: Sequence[str]) -> list[float]:
    """Return the slopes of outputs over the load at small slip angles; nothing for too few rows."""
    columns = _columns(frame, ("slip_angle", "normal_load", *outputs))
    if not columns:
        return []
    slip, load, *sizes = columns
    good = np.all(np.isfinite([slip, *sizes]), axis=0) & (np.abs(load) > 0.0)
    if "slip_ratio" in frame:
        good &= ~(np.abs(pd.to_numeric(frame["slip_ratio"], errors="coerce")).to_numpy() > PURE_SLIP_RATIO)
    if not good.any():
        return []
    good &= np.abs(slip) <= _SMALL_PART * np.quantile(np.abs(slip[good]), 0.99)
    if np.sum(good) < FEWEST_ROWS or np.ptp(slip[good]) == 0.0:
        return []
    return [_slope(slip[good], y[good] / np.abs(load[good])) for y in sizes]


def grip_of_no_tire(frame: pd.DataFrame) -> list[Issue]:
    """Ask about a force that stays small beside the load, or beside the other force, at large slip.

    A force in pounds labelled N is 4.4 times too small. Data cannot tell that from ice: it is a question.

    Parameters
    ----------
    frame : DataFrame
        Canonical columns.
    """
    grips = {force: grip for slip, force in FORCE_OF_SLIP.items() if (grip := _grip(frame, slip)) > 0.0}
    low, high = min(grips, key=grips.__getitem__, default=""), max(grips.values(), default=0.0)
    if not low or (grips[low] >= _LEAST_GRIP and high < _MOST_APART * grips[low]):
        return []
    others = [f"{name} {in_digits(grip)}" for name, grip in grips.items() if name != low]
    beside = f", {others[0]} of it" if others else ""
    where = f"{low}, {in_digits(grips[low])} of the load at large slip{beside}"
    as_stated = [f"{unit} ({in_digits(grips[low] * newtons)})" for unit, newtons in _NEWTONS.items()]
    todo = (
        f"is that so? Dry roads give about 1, ice 0.1. If {low} is in {' or '.join(as_stated)}, state it: "
        f"{unit_stated(frame, low, next(iter(_NEWTONS)))}"
    )
    return [Issue("grip_of_no_tire", "warning", where, todo)]


def _grip(frame: pd.DataFrame, slip: str) -> float:
    """How much of the load a force reaches where its slip alone is large; 0 where it never is."""
    columns = _columns(frame, (slip, "normal_load", FORCE_OF_SLIP[slip]))
    if not columns:
        return 0.0
    x, load, y = columns
    good = np.isfinite(x) & np.isfinite(y) & (np.abs(load) > _SMALL_PART * size(load))
    good &= np.abs(x) > _LARGE_SLIP
    for other in FORCE_OF_SLIP:
        if other != slip and (held := _columns(frame, (other,))):
            good &= ~(np.abs(held[0]) > PURE_SLIP_RATIO)
    return float(np.quantile(np.abs(y[good] / load[good]), 0.9)) if good.sum() >= FEWEST_ROWS else 0.0


def _columns(frame: pd.DataFrame, names: Sequence[str]) -> list[np.ndarray]:
    """Return some columns; nothing where one of them is missing or holds no numbers."""
    if any(name not in frame or not pd.api.types.is_numeric_dtype(frame[name]) for name in names):
        return []
    return [frame[name].to_numpy(dtype=float) for name in names]


def _slope(x: np.ndarray, y: np.ndarray) -> float:
    """Return the slope of a straight line; 0 where there is none."""
    x, y = x - x.mean(), y - y.mean()
    squares = float(x @ x) * float(y @ y)
    return float(x @ y) / float(x @ x) if squares > 0.0 and float(x @ y) ** 2 > STRAIGHT * squares else 0.0
