"""What a recording measured: its operating points, the forces there, and the rows that hold both."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd

from tire_pipeline.channels import FORCE_CHANNELS, TANGENTIAL_FORCES
from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula.fitting.setup.checked import check_table, numbers
from tire_pipeline.magic_formula.parameters.coefficients import family_of
from tire_pipeline.magic_formula.parameters.points import POINT_CHANNELS
from tire_pipeline.pages.numbers_in_words import how_many, in_digits

FEWEST_POINTS = 10
_NEAR_LOCKED = 0.1
"""A slip ratio that stays this near to -1 is a sliding wheel's: no curve of a force over slip is in it."""


def columns(
    recording: pd.DataFrame, version: str
) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray], dict[str, str], list[str]]:
    """Return the points and the forces at them, by name, of whole rows; forces left out, and why; notes.

    A channel without any number counts as not recorded. One that the version, or the forces that were
    recorded, do not depend on costs no row.

    Parameters
    ----------
    recording : DataFrame
    version : str

    Returns
    -------
    points, forces : dict of ndarray
    left_out : dict of str
    notes : list of str

    Raises
    ------
    RecordingError
        There is no load, no slip, no force, or there are fewer than ten whole rows.
    """
    check_table(recording)
    if "normal_load" not in recording:
        todo = recording.attrs.get("layout") or "name the load's column normal_load, in newtons"
        raise RecordingError("there is no normal_load", todo=todo)
    wanted = [name for name in FORCE_CHANNELS if name in recording]
    if not wanted:
        raise RecordingError("there is no force or moment to fit", todo="name them fx, fy, mx, my, mz")
    if len(recording) < FEWEST_POINTS:
        raise RecordingError(
            f"only {how_many(len(recording), 'point')}", todo=f"use at least {FEWEST_POINTS}"
        )
    forces = {name: numbers(recording, name) for name in wanted}
    unused = _unused(version, forces)
    held = {n: numbers(recording, n, unused) for n in POINT_CHANNELS if n in recording}
    notes = _not_recorded(recording, held)
    good = _whole(held, unused)
    if not {"slip_angle", "slip_ratio"} & set(held) and set(wanted) - {"mx", "my"}:
        raise RecordingError(
            "neither slip_angle nor slip_ratio is recorded" + "".join(f"; {note}" for note in notes),
            todo="name the columns slip_angle (rad) and slip_ratio: forces follow them",
        )
    points = {}
    for name in POINT_CHANNELS:
        missing = np.nan if name in ("speed", "pressure") else 0.0
        points[name] = held.get(name, np.full(good.size, missing))[good]
    measured, left_out = _measured({name: force[good] for name, force in forces.items()})
    notes += [f"{name} {why}: not fitted" for name, why in left_out.items()]
    return points, measured, left_out, notes


def _unused(version: str, forces: Mapping[str, np.ndarray]) -> set[str]:
    """Return the channels on which nothing depends: pressure before 6.1, speed without rolling resistance."""
    unused = set() if family_of(version) == 6 else {"pressure"}
    rolls = "my" in forces and np.isfinite(forces["my"]).any()
    return unused if rolls else unused | {"speed"}


def _not_recorded(recording: pd.DataFrame, held: dict[str, np.ndarray]) -> list[str]:
    """Take out channels that were not measured, and return what is said of them."""
    notes = []
    for name in [n for n, x in held.items() if not np.isfinite(x).any()]:
        if name == "normal_load":
            raise RecordingError("holds no number", where=name, todo="record the load, in newtons")
        del held[name]
        notes.append(f"{name} holds no number: taken as not recorded")
    if "slip_ratio" not in held:
        return notes
    still = locked_parts(recording, held["slip_ratio"])
    for rows, said in still:
        notes.append(said)
        held["slip_ratio"][rows] = 0.0
    if len(still) == len(_parts(recording)):
        del held["slip_ratio"]
    return notes


def _parts(recording: pd.DataFrame) -> list[slice]:
    """Return the rows of each of the recordings that were joined; all rows where there is one."""
    joined = recording.attrs.get("joined", [])
    parts = [slice(int(each["first"]), int(each["last"]) + 1) for each in joined]
    whole = [0, *(rows.stop for rows in parts)] == [*(rows.start for rows in parts), len(recording)]
    return parts if parts and whole else [slice(0, len(recording))]


def _locked(slip_ratio: np.ndarray) -> bool:
    """Whether the wheel is locked in nearly every row: rigs write -1 where they do not measure the slip.

    A locked wheel has no curve over the slip. So a channel that says -1, within its noise, wherever others
    vary says that it was not measured.
    """
    known = slip_ratio[np.isfinite(slip_ratio)]
    return bool(known.size) and bool(np.abs(np.asarray(bulk(known)) + 1.0).max() <= _NEAR_LOCKED)


def locked_parts(recording: pd.DataFrame, slip_ratio: np.ndarray) -> list[tuple[slice, str]]:
    """Return the parts of a recording in which the wheel is locked in nearly every row, each with a remark.

    Parameters
    ----------
    recording : DataFrame
        ``attrs["joined"]`` may hold its parts.
    slip_ratio : ndarray

    Returns
    -------
    list of (slice, str)
        Its rows, and that the slip ratio was not measured there; empty where it was.
    """
    parts = _parts(recording)
    still = [rows for rows in parts if _locked(slip_ratio[rows])]
    return [(rows, _said_of_part(slip_ratio[rows], rows, len(parts))) for rows in still]


def _said_of_part(slip_ratio: np.ndarray, rows: slice, parts: int) -> str:
    known = slip_ratio[np.isfinite(slip_ratio)]
    low, high = (f"{x:.4g}" for x in bulk(known))
    values = low if low == high else f"{low} to {high}"
    where = "throughout" if parts == 1 else f"in rows {rows.start} to {rows.stop - 1}"
    return f"slip_ratio is {values} {where}, a locked wheel: taken as not measured, and as 0"


def _whole(held: dict[str, np.ndarray], unused: set[str]) -> np.ndarray:
    """Return which rows have a positive load and a number in each channel that is used.

    Others get the median of theirs.

    Raises
    ------
    RecordingError
        There are too few. It names the channels, and how many rows each of them costs.
    """
    load = held["normal_load"]
    known = load[np.isfinite(load)]
    if np.median(known) < 0.0:
        raise RecordingError(
            f"is negative in {int((known < 0.0).sum())} of {load.size} rows; compression is positive here",
            where="normal_load",
            todo="turn its sign, and in SAE axes that of fy and mz; read_recording(path, axes='SAE') does so "
            "for a file whose load is negative throughout",
        )
    lost = {name: ~np.isfinite(x) for name, x in held.items() if name not in unused}
    for name in unused & set(held):
        held[name] = np.where(np.isfinite(held[name]), held[name], np.nanmedian(held[name]))
    without = lost["normal_load"].copy()
    lost["normal_load"] = ~(load > 0.0)
    good = ~np.any(list(lost.values()), axis=0)
    if int(good.sum()) >= FEWEST_POINTS:
        return good
    costs = {name: int(bad.sum()) for name, bad in lost.items() if bad.any()}
    said = []
    for name in sorted(costs, key=lambda n: -costs[n]):
        zero = name == "normal_load" and not without.all() and costs[name] > int(without.sum())
        what = "has no positive value" if zero else "has no number"
        said.append(f"{name} {what} in {how_many(costs[name], 'row')} of {load.size}")
    worst = max(costs, key=lambda n: costs[n])
    drop = "" if worst == "normal_load" else ", or leave the column out if it was not measured"
    raise RecordingError(
        f"only {how_many(int(good.sum()), 'point')} can be used" + "".join(f"; {text}" for text in said),
        todo=f"look at {worst}{drop}; at least {FEWEST_POINTS} rows need a number in every channel",
    )


def _measured(forces: Mapping[str, np.ndarray]) -> tuple[dict[str, np.ndarray], dict[str, str]]:
    """Return the forces that may be measurements, and of the others why they are none.

    Raises
    ------
    RecordingError
        There is none.
    """
    left_out = {name: why for name, force in forces.items() if (why := _not_measured(name, force))}
    measured = {
        name: force
        for name, force in forces.items()
        if name not in left_out and np.nanmax(np.abs(force)) > 0.0
    }
    if not measured:
        said = [f"{name} {why}" for name, why in left_out.items()]
        raise RecordingError(
            "no force or moment was measured" + (f": {', '.join(said)}" if said else ""),
            todo="check that the sensor was on, and the unit",
        )
    return measured, left_out


def _not_measured(name: str, force: np.ndarray) -> str:
    """Return why a column is not a measurement; empty if it may be one."""
    known = force[np.isfinite(force)]
    if known.size == 0:
        return "holds no number"
    if name in TANGENTIAL_FORCES and np.ptp(known) == 0.0 and known[0] != 0.0:
        return f"is {in_digits(known[0], 4)} N throughout"
    return ""


def bulk(x: np.ndarray) -> tuple[float, float]:
    """Return the range of a channel, shape (n,), but for odd samples: the central 96%."""
    low, high = np.quantile(x, [0.02, 0.98])
    return float(low), float(high)
