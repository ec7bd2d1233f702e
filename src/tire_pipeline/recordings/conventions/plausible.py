"""Values that no tire, wheel or rig has, which show that a channel is in another unit."""

from __future__ import annotations

import shlex
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import pandas as pd

from tire_pipeline.channels import LARGEST_LOAD_OF_MODEL_CARS, TIRE_PRESSURES, TIRE_RADII
from tire_pipeline.pages.numbers_in_words import in_digits
from tire_pipeline.recordings.conventions.channel_names import CANONICAL, FURTHER
from tire_pipeline.recordings.conventions.units import UNITS_BY_NAME, find_unit


class Plausible(NamedTuple):
    """Sizes of a channel that tires have, in its SI unit (degC).

    Parameters
    ----------
    low, high : float
        The size is the 98% quantile of the channel without its sign, so that odd samples do not count.
    source : str
        Where the limits come from.
    read_as : str
        The unit as which an explanation reads a channel beyond ``high``; empty where it asks for the unit.
    """

    low: float
    high: float
    source: str
    read_as: str = ""


PLAUSIBLE_VALUES = {
    "slip_angle": Plausible(0.0, 1.6, "a wheel that stands across its path has pi/2", "deg"),
    "camber": Plausible(0.0, 1.2, "a motorcycle leans by 65 degrees at most (1.13 rad)", "deg"),
    "slip_ratio": Plausible(0.0, 4.0, "a wheel that spins at five times the road's speed", "%"),
    "normal_load": Plausible(0.0, 2e6, "the largest tire of a mining truck (59/80R63) carries 104 t (1 MN)"),
    "speed": Plausible(0.0, 130.0, "aircraft tires are rated to 235 mph (105 m/s), and tested beyond"),
    "pressure": Plausible(
        *TIRE_PRESSURES, "racing cars of 0.6 bar to trucks of 9 bar (ETRTO), cold; a third more when hot"
    ),
    "tread_temperature": Plausible(0.0, 250.0, "above 200 degC rubber decomposes"),
    "loaded_radius": Plausible(*TIRE_RADII, "model cars at 1:87 to a mining truck's 59/80R63 (2.0 m)"),
    "effective_radius": Plausible(*TIRE_RADII, "as the loaded radius; a slipping wheel's is larger"),
}
"""By channel. A low of 0 sets no lower limit: a channel that is constant is not a fault."""

FORCE_OVER_LOAD = (0.1, 3.0)
"""Largest force over largest load: that of wet ice, and more than racing tires have on a rig (2.7)."""

_LIKELY_UNITS = (
    "deg",
    "%",
    "kN",
    "kgf",
    "lbf",
    "km/h",
    "mph",
    "kPa",
    "bar",
    "psi",
    "%",
    "K",
    "degF",
    "Pa",
    "N",
    "m/s",
    "mm",
    "cm",
    "in",
)
"""Units that are proposed, as users write them."""
_BULK = 0.98


def size(values: np.ndarray) -> float:
    """Return the size of a channel, shape (n,), but for odd samples; NaN if it has no number.

    Examples
    --------
    >>> size(np.r_[np.full(99, -2.0), 1e9])
    2.0
    """
    numbers = np.abs(values[np.isfinite(values)])
    return float(np.quantile(numbers, _BULK)) if numbers.size else float("nan")


def plausible(channel: str, large: float) -> bool:
    """Whether a tire can have a channel of some size (SI); a channel that is not in the table always can."""
    limits = PLAUSIBLE_VALUES.get(channel)
    return limits is None or np.isnan(large) or bool(limits.low <= large <= limits.high)


def implausible_radii(recordings: Mapping[str, pd.DataFrame]) -> list[str]:
    """Return a sentence for each channel of a radius that no wheel has: an explanation goes on without it.

    Parameters
    ----------
    recordings : mapping of str to DataFrame
        By name, which stands before the channel where there are several.
    """
    found = []
    for name, frame in recordings.items():
        for channel in ("loaded_radius", "effective_radius"):
            if channel not in frame or not pd.api.types.is_numeric_dtype(frame[channel]):
                continue
            large = size(frame[channel].to_numpy(dtype=float))
            if not plausible(channel, large):
                where = f"{name}: {channel}" if len(recordings) > 1 else channel
                ask = likely_unit_stated(frame, channel, likely_units(frame, channel, large))
                found.append(f"{where} is {in_digits(large)} m, which no wheel has; {ask}")
    return found


def in_another_unit(channel: str, values: np.ndarray) -> bool:
    """Tell whether a slip or an angle is larger than any wheel's, but for odd samples: degrees, percent."""
    return bool(PLAUSIBLE_VALUES[channel].read_as) and size(values) > PLAUSIBLE_VALUES[channel].high


def likely_units(frame: pd.DataFrame, channel: str, large: float) -> list[str]:
    """Return the units that would make a channel plausible, as its numbers stand in the file.

    Parameters
    ----------
    frame : DataFrame
        A recording; ``attrs["file_units"]`` holds the units that the file or the user stated.
    channel : str
    large : float
        Its size as it was read, SI.
    """
    return [unit for unit, x in _read_otherwise(frame, channel, large) if plausible(channel, x)]


def likely_load_units(frame: pd.DataFrame, load: float, force: float) -> list[str]:
    """Return the units of the load that would make the friction plausible.

    Parameters
    ----------
    frame : DataFrame
        As above.
    load, force : float
        Sizes of the load and of the largest force as they were read, N.
    """
    low, high = FORCE_OVER_LOAD
    return [unit for unit, x in _read_otherwise(frame, "normal_load", load) if low <= force / x <= high]


def units_of_larger_loads(frame: pd.DataFrame, load: float) -> list[str]:
    """Return the units in which a load that only a model car has would be another tire's.

    Parameters
    ----------
    frame : DataFrame
        As above.
    load : float
        Its size as it was read, N.
    """
    most = PLAUSIBLE_VALUES["normal_load"].high
    read = _read_otherwise(frame, "normal_load", load)
    return [unit for unit, x in read if LARGEST_LOAD_OF_MODEL_CARS <= x <= most]


def _read_otherwise(frame: pd.DataFrame, channel: str, large: float) -> list[tuple[str, float]]:
    """Return each other unit of a channel's kind, and the size that the channel would have in SI."""
    known = next(c for c in (*CANONICAL, *FURTHER) if c.name == channel)
    stated = find_unit(frame.attrs.get("file_units", {}).get(channel)) or find_unit(known.unit)
    assert stated is not None
    as_filed = (large - stated.offset) / stated.factor
    units = [(name, UNITS_BY_NAME[name.lower()]) for name in _LIKELY_UNITS]
    return [
        (name, abs(as_filed * unit.factor + unit.offset))
        for name, unit in units
        if unit.dimension == known.dimension and unit != stated
    ]


def unit_stated(frame: pd.DataFrame, column: str, unit: str) -> str:
    """Return how a user states the unit of a column, by the name that the file gives it."""
    name = frame.attrs.get("channels", {}).get(column, column)
    return f"--unit {shlex.quote(f'{name}={unit}')}, in Python units={{{name!r}: {unit!r}}}"


def likely_unit_stated(frame: pd.DataFrame, column: str, units: list[str]) -> str:
    """Return how to state the unit of a channel, given the units that it may be in."""
    if not units:
        return "no unit that is known makes it plausible: check the channel"
    which = f"the unit is likely {' or '.join(units)}"
    return f"{which}. State it, if it is {units[0]}: {unit_stated(frame, column, units[0])}"
