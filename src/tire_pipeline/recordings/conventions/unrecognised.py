"""Suggest by its unit what an unrecognised column may be."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterable, Mapping

from tire_pipeline.channels import FORCE_OF_SLIP
from tire_pipeline.pages.numbers_in_words import first_of
from tire_pipeline.recordings.conventions.channel_names import CANONICAL, find_channel
from tire_pipeline.recordings.conventions.units import find_unit

_MOST = 8
_OF_A_WHEEL = re.compile(r"(.+?)[ _.-]+(FL|FR|RL|RR|LF|RF|LR)", re.IGNORECASE)
_NUMBER_IN_NAME = re.compile(r"\d+(?:[.,]\d+)?")
_OWN_KIND = [
    c
    for c in CANONICAL
    if c.dimension != "ratio" and [other.dimension for other in CANONICAL].count(c.dimension) == 1
]
"""Channels that can be recognised by their unit: time, speed, pressure, temperature. A ratio has none."""


def may_be(columns: Mapping[str, str | None], known: Iterable[str]) -> str:
    """Return how to name columns that are not recognised; "" if no unit hints at a missing channel.

    Parameters
    ----------
    columns : mapping of str to str, optional
        Name in the file -> unit, of what is not recognised.
    known : iterable of str
        Channels that the recording has.

    Examples
    --------
    >>> may_be({"Dauer": "s", "Bemerkung": None}, known=["fy"])
    "Dauer (s) is not used; if it is time, say so: --name Dauer=time, in Python names={'Dauer': 'time'}"
    """
    missing = {c.dimension: c.name for c in _OWN_KIND if c.name not in set(known)}
    hints = {}
    for name, unit in columns.items():
        found = find_unit(unit)
        if found is not None and found.dimension in missing:
            hints[name] = (unit, missing[found.dimension])
    if not hints:
        return ""
    listed = list(hints.items())[:_MOST]
    first, (_, channel) = listed[0]
    columns_said = ", ".join(f"{name} ({unit})" for name, (unit, _) in listed)
    *others, last = dict.fromkeys(channel for _, (_, channel) in listed)
    channels = f"{', '.join(others)} or {last}" if others else last
    stated = shlex.quote(f"{first}={channel}")
    verb, which = ("is", "it is") if len(listed) == 1 else ("are", "one of them is")
    return (
        f"{columns_said} {verb} not used; if {which} {channels}, say so: --name {stated}, "
        f"in Python names={{{first!r}: {channel!r}}}"
    )


def of_a_wheel(columns: Iterable[str]) -> str:
    """Return how to read one wheel of a vehicle, whose columns end with where it is; "" if none does.

    Examples
    --------
    >>> of_a_wheel(["Fy_FL", "Fy_FR", "Fz_FL", "Fz_FR", "steering"])
    'columns end with a wheel (FL, FR); to read FL: --name Fy_FL=fy --name Fz_FL=normal_load'
    """
    wheels: dict[str, dict[str, str]] = {}
    for name in columns:
        parts = _OF_A_WHEEL.fullmatch(name)
        known = parts and find_channel(parts[1])
        if parts and known:
            wheels.setdefault(parts[2], {})[name] = known[0].name
    if not wheels:
        return ""
    first, named = next(iter(wheels.items()))
    stated = " ".join(f"--name {shlex.quote(f'{name}={channel}')}" for name, channel in named.items())
    return f"columns end with a wheel ({', '.join(wheels)}); to read {first}: {stated}"


def one_column_a_load(columns: Iterable[str], known: Iterable[str]) -> str:
    """Return the layout that is needed if a table may have one column for each load; "" if it has a load.

    Parameters
    ----------
    columns : iterable of str
        Those that are not recognised.
    known : iterable of str
        Channels that the recording has.

    Examples
    --------
    >>> one_column_a_load(["Fy @ Fz=2000 N", "Fy @ Fz=4000 N"], known=["slip_angle"])
    'if Fy @ Fz=2000 N, Fy @ Fz=4000 N are one load each: put one row for each point, with ...'
    """
    known = set(known)
    slips = [slip for slip in FORCE_OF_SLIP if slip in known]
    if "normal_load" in known or not slips:
        return ""
    alike: dict[str, list[str]] = {}
    for name in columns:
        if _NUMBER_IN_NAME.search(name):
            alike.setdefault(_NUMBER_IN_NAME.sub("#", name), []).append(name)
    several = max(alike.values(), key=len, default=[])
    if len(several) < 2:
        return ""
    return (
        f"if {first_of(several, _MOST)} are one load each: put one row for each point, with {slips[0]}, "
        f"normal_load and {FORCE_OF_SLIP[slips[0]]}"
    )
