"""TYDEX axis systems H, C and W, the SAE system and Pacejka's adapted SAE system -> ISO W.

TYDEX (Unrau and Zamow, "TYDEX-Format, Description and Reference Manual", release 1.3): all three
systems have x ahead in the wheel plane and parallel to the road.

* W: origin in the contact point, y and z in the road plane and normal to it.
* H: the same directions, origin in the wheel centre.
* C: origin in the wheel centre, y along the spin axis, z in the wheel plane: H turned about x by
  the camber angle.
"""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from tire_pipeline.channels import MOMENT_CHANNELS
from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula.parameters.axes import AXES
from tire_pipeline.magic_formula.parameters.camber_thrust import camber_thrust
from tire_pipeline.recordings.conventions.units import find_unit

_COMPONENT = {"normal_load": "z", "fx": "x", "fy": "y", "mx": "x", "my": "y", "mz": "z"}

_IN_FULL = {"SAE": "SAE J670e", "adapted SAE": "adapted SAE (Pacejka)"}

_OF_SIMULATION = "simulated_"
"""Begin of the names of simulated forces, which a file has in the axes of its recorded ones."""

NOT_STATED = "ISO W axes, which were not stated"
"""How the axes of a file are told that states none, and whose forces do not tell them."""


def to_iso_w(
    frame: pd.DataFrame,
    origin: dict[str, str],
    constants: dict[str, dict[str, object]],
    axes: str | None,
    notes: list[str],
    conversions: list[str],
    source: str,
) -> tuple[str, str]:
    """Turn the forces and moments of `frame` into ISO W, in place, and say what was done.

    Parameters
    ----------
    frame : DataFrame
        Canonical columns, SI.
    origin : dict
        By column, the name in the file: its last letter (`FYH`, `MZC`) states the system.
    constants : dict
        The file's constants; `LOADRAD`, else half of `OVALLDIA`, for the wheel centre's height.
    axes : {"ISO", "SAE", "adapted SAE"}, optional
        System of channels whose names do not state one. Left out: ISO is assumed.

    Returns
    -------
    said : str
        The axes that the channels are taken to be in, and where this is stated.
    against : str
        Evidence in the file against axes that were assumed; "" if there is none.

    Raises
    ------
    RecordingError
        `axes` is not one of those.
    """
    told = axes is not None
    by_camber = "" if told else _by_camber(frame, origin)
    axes = named_axes(axes) if axes is not None else by_camber or "ISO"
    turned = {n for n, sign in AXES[axes]._asdict().items() if sign < 0.0}  # Fz is looked at below
    there = [column for column in frame if str(column).removeprefix(_OF_SIMULATION) in turned]
    for column in there:
        frame[column] = -frame[column]
    if axes != "ISO":
        conversions.append(f"{_IN_FULL[axes]} to ISO: {', '.join(there) or 'nothing'} mirrored")
    systems = {c: _system(origin[c]) for c in _COMPONENT if c in frame}
    if "C" in systems.values():
        _c_to_h(frame, systems, notes, conversions)
    mirrored = _flip_load(frame, notes, conversions, ask=axes == "ISO" and not by_camber)
    if {"H", "C"} & {s for c, s in systems.items() if c in MOMENT_CHANNELS}:
        _moments_to_contact(frame, systems, constants, notes, conversions)
    bare = [origin[c] for c in systems if systems[c] == "?" and origin[c] not in _COMPONENT]
    if bare and axes == "ISO" and not (told or by_camber):
        notes.append(f"{', '.join(bare)}: no axis system given; ISO W assumed")
    if told:
        return f"{axes} axes, as stated", ""
    if by_camber:
        return (
            f"{axes} axes, which were not stated: Fz is negative throughout, and with camber Fy changes in "
            f"the direction that it has in {axes} axes"
        ), ""
    if systems and "?" not in systems.values():
        return "axes by the names of the channels (TYDEX)", ""
    against = "Fz is negative throughout in the file, as in SAE axes" if mirrored else ""
    return NOT_STATED + (f" ({against}; only Fz was mirrored)" if against else ""), against


def named_axes(axes: str) -> str:
    """Return an axis system by its name, in any case and with blanks, ``_`` or ``-``."""
    spelt = {name.replace(" ", "").upper(): name for name in AXES}
    name = spelt.get(axes.upper().translate(str.maketrans("", "", " _-")))
    if name is None:
        raise RecordingError(f"axes={axes!r}", todo=f"choose {', '.join(map(repr, AXES))}")
    return name


def _by_camber(frame: pd.DataFrame, origin: dict[str, str]) -> str:
    """Return ISO or SAE where the load is negative and the force of a leaning wheel tells; else nothing.

    If the camber had the other sign instead, all would be the mirror image: the same tire.
    """
    needed = ("slip_angle", "camber", "normal_load", "fy")
    if any(name not in frame for name in needed) or _system(origin["fy"]) != "?":
        return ""
    slip, camber, load, fy = (frame[name].to_numpy(dtype=float) for name in needed)
    if not (load < 0.0).any() or (load > 0.0).any():
        return ""
    thrust = camber_thrust(slip, camber, load, fy)
    return "SAE" if thrust > 0.0 else "ISO" if thrust < 0.0 else ""


def _system(name: str) -> str:
    """W, H or C by the last letter of a TYDEX name, "?" where there is none."""
    text = name.strip().upper()
    if len(text) == 3 and text[0] in "FM" and text[1] in "XYZ" and text[2] in "WHC":
        return text[2]
    return "?"


def _c_to_h(frame: pd.DataFrame, systems: dict[str, str], notes: list[str], conversions: list[str]) -> None:
    """Turn about x by the camber angle; C and H then differ no more."""
    if "camber" not in frame:
        notes.append("C axes without camber: taken as H axes (camber 0)")
        return
    cos, sin = np.cos(frame["camber"]), np.sin(frame["camber"])
    for y, z, what in (("fy", "normal_load", "forces"), ("my", "mz", "moments")):
        here = [c for c in (y, z) if systems.get(c) == "C"]
        if len(here) == 2:
            frame[y], frame[z] = (
                frame[y] * cos - frame[z] * sin,
                frame[y] * sin + frame[z] * cos,
            )
            conversions.append(f"{what} turned from C to H axes by the camber angle")
        elif here:
            notes.append(f"{here[0]} is in C axes and its partner is missing: not turned")


def _flip_load(frame: pd.DataFrame, notes: list[str], conversions: list[str], *, ask: bool) -> bool:
    """Mirror a load that is negative throughout; return whether that was done.

    ``ask`` says whether the axes stay open then.
    """
    if "normal_load" not in frame:
        return False
    load = frame["normal_load"].to_numpy()
    finite = load[np.isfinite(load) & (load != 0)]
    if finite.size == 0 or (finite > 0).any():
        if finite.size and (finite < 0).any():
            notes.append(f"{(finite < 0).sum()} of {finite.size} normal loads are negative: kept")
        return False
    frame["normal_load"] = -load
    conversions.append("normal_load: negative throughout, mirrored (compression is positive)")
    if ask:
        notes.append(
            "Fz is negative throughout, as in SAE axes; only Fz was mirrored. If the file is in "
            'SAE axes, read it with axes="SAE" (on the command line --axes SAE)'
        )
    return True


def _moments_to_contact(
    frame: pd.DataFrame,
    systems: dict[str, str],
    constants: dict[str, dict[str, object]],
    notes: list[str],
    conversions: list[str],
) -> None:
    """``M_W = M_H + r x F`` with r = R (0, -sin camber, cos camber) from contact to centre."""
    radius, which = _radius(frame, constants)
    camber = frame.get("camber", 0.0)
    sin, cos = np.sin(camber), np.cos(camber)
    terms: dict[str, list[tuple[str, object]]] = {
        "mx": [("normal_load", -sin), ("fy", -cos)],
        "my": [("fx", cos)],
        "mz": [("fx", sin)],
    }
    for moment, parts in terms.items():
        if systems.get(moment) not in ("H", "C"):
            continue
        lacking = [c for c, _ in parts if c not in frame]
        if radius is None or lacking:
            why = "the loaded radius" if radius is None else ", ".join(lacking)
            if moment == "mz":
                notes.append(
                    f"mz is about the wheel centre: without {why} the part radius x fx x sin(camber) is "
                    "left out (in free rolling it comes from rolling resistance alone)"
                )
                continue
            notes.append(f"{moment} stays about the wheel centre: it cannot be moved without {why}")
            frame.rename(columns={moment: f"{moment}_wheel_centre"}, inplace=True)
            continue
        frame[moment] = frame[moment] + sum(radius * frame[c] * k for c, k in parts)
        conversions.append(f"{moment} moved from the wheel centre to the contact point ({which})")


def _radius(
    frame: pd.DataFrame, constants: dict[str, dict[str, object]]
) -> tuple[pd.Series | float | None, str]:
    """Height of the wheel centre over the contact point in the wheel plane, and where from."""
    if "loaded_radius" in frame:
        return frame["loaded_radius"], "by the channel loaded_radius"
    for key, scale, which in (
        ("LOADRAD", 1.0, "by the constant LOADRAD"),
        ("OVALLDIA", 0.5, "by half of OVALLDIA: the tire's deflection is left out"),
    ):
        entry = constants.get(key, {})
        unit, value = find_unit(str(entry.get("unit") or "")), entry.get("value")
        if isinstance(value, float) and math.isfinite(value) and unit and value > 0:
            return scale * value * unit.factor, which
    return None, ""
