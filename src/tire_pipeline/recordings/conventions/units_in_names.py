"""Units hidden in a channel's name: `Fz_N`, `SA [deg]`, `V (km/h)`, `FY/N`."""

from __future__ import annotations

import re

from tire_pipeline.recordings.conventions.channel_names import find_channel
from tire_pipeline.recordings.conventions.units import find_unit

_BRACKETS = re.compile(r"^(.*?)\s*[\[(]([^\[\]()]*)[\])]\s*$")
_SLASH = re.compile(r"^(\w+)\s*/\s*(.+)$")


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
    """
    name = name.strip()
    if find_channel(name):
        return name, None
    bracket = _BRACKETS.match(name)
    if bracket and bracket.group(1):
        return bracket.group(1).strip(), bracket.group(2).strip() or None
    slash = _SLASH.match(name)
    if slash and find_channel(slash.group(1)) and find_unit(slash.group(2)):
        return slash.group(1), slash.group(2).strip()
    parts = name.split("_")
    for tail in (2, 1):  # speed_km_h before speed_h
        base, unit = "_".join(parts[:-tail]), "/".join(parts[-tail:])
        if len(parts) > tail and base and find_channel(base) and find_unit(unit):
            return base, unit
    return name, None
