"""Units hidden in a channel's name: `Fz_N`, `SA [deg]`, `V (km/h)`, `FY/N`, `load in kN`."""

from __future__ import annotations

import re

from tire_pipeline.recordings.conventions.channel_names import find_channel
from tire_pipeline.recordings.conventions.units import find_unit

_BRACKETS = re.compile(r"^(.*?)\s*[\[(]([^\[\]()]*)[\])]\s*$")
_SLASH = re.compile(r"^([\w ]+?)\s*/\s*(.+)$")
_IN = re.compile(r"^(.+?)\s+(?:in|en)\s+(\S+)$", re.IGNORECASE)
"""In English and German, and in French."""


def split_unit(name: str) -> tuple[str, str | None]:
    """Separate a channel's name from the unit that is written into it.

    Parameters
    ----------
    name : str

    Returns
    -------
    name : str
    unit : str or None

    Examples
    --------
    >>> split_unit("Fz_N"), split_unit("SA [deg]"), split_unit("slip_angle")
    (('Fz', 'N'), ('SA', 'deg'), ('slip_angle', None))
    >>> split_unit("Radlast in kN")
    ('Radlast', 'kN')
    """
    name = name.strip()
    if find_channel(name):
        return name, None
    bracket = _BRACKETS.match(name)
    if bracket and bracket.group(1):
        return bracket.group(1).strip(), bracket.group(2).strip() or None
    for form in (_SLASH, _IN):
        parts = form.match(name)
        if parts and find_channel(parts[1]) and find_unit(parts[2]):
            return parts[1], parts[2].strip()
    words = name.split("_")
    for tail in (2, 1):  # speed_km_h before speed_h
        base, unit = "_".join(words[:-tail]), "/".join(words[-tail:])
        if len(words) > tail and base and find_channel(base) and find_unit(unit):
            return base, unit
    return name, None
