"""What a column may be whose name is not known, by its unit."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Mapping

from tire_pipeline.recordings.conventions.channel_names import CANONICAL
from tire_pipeline.recordings.conventions.units import find_unit

_MOST = 8
_OWN_KIND = [
    c
    for c in CANONICAL
    if c.dimension != "ratio" and [other.dimension for other in CANONICAL].count(c.dimension) == 1
]
"""Channels that their unit tells: time, speed, pressure, temperature. A ratio has none."""


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
    >>> may_be({"Zeit": "s", "Bemerkung": None}, known=["fy"])
    "Zeit (s) is not used; if it is time, say so: --name Zeit=time, in Python names={'Zeit': 'time'}"
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
