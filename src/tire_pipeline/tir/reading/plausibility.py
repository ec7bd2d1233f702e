"""Values that a file may hold but that are probably in another unit, or contradict each other."""

from __future__ import annotations

import math
from collections.abc import Mapping

from tire_pipeline.magic_formula.parameters.assumed_radius import PLAUSIBLE_RADII
from tire_pipeline.magic_formula.parameters.coefficients import RANGE_KEYS

_PLAUSIBLE = {
    "UNLOADED_RADIUS": (*PLAUSIBLE_RADII, "m"),
    "FNOMIN": (10.0, 1e6, "N"),
    "NOMPRES": (1e4, 5e6, "Pa"),
    "INFLPRES": (1e4, 5e6, "Pa"),
    "LONGVL": (0.5, 150.0, "m/s"),
    "FZMAX": (20.0, math.inf, "N"),
}
_PLAUSIBLE_METADATA = {
    "DIMENSION.WIDTH": (0.005, 2.0, "m"),
    "DIMENSION.RIM_RADIUS": (0.005, 2.0, "m"),
    "DIMENSION.RIM_WIDTH": (0.005, 2.0, "m"),
    "DIMENSION.ASPECT_RATIO": (0.05, 1.5, ""),
    "INERTIA.MASS": (0.01, 3000.0, "kg"),
}


def odd_values(
    coefficients: Mapping[str, float], metadata: Mapping[str, object], factors: Mapping[str, float]
) -> list[str]:
    """Return a sentence for every value that looks wrong. Nothing is changed.

    Parameters
    ----------
    coefficients, metadata : mapping
        In SI.
    factors : mapping
        Dimension -> SI units in one unit of the file.
    """
    found = []
    for table, values in ((_PLAUSIBLE, coefficients), (_PLAUSIBLE_METADATA, metadata)):
        for key, (low, high, unit) in table.items():
            value = values.get(key)
            if isinstance(value, float) and not low <= value <= high:
                found.append(
                    f"{key} = {value:g} {unit} is implausible: is it in another unit?".replace("  ", " ")
                )
    for key in ("ALPMIN", "ALPMAX", "CAMMIN", "CAMMAX"):
        value = abs(coefficients.get(key, 0.0))
        if value > 3.2:
            found.append(f"{key} is {value:g} rad: is it in degrees?")
        elif factors["angle"] != 1.0 and 0 < value < math.radians(1.6):
            found.append(f"{key} is {math.degrees(value):g} deg by [UNITS]: is it in radians?")
    for low_key, high_key in RANGE_KEYS.values():
        if coefficients.get(low_key, -math.inf) > coefficients.get(high_key, math.inf):
            found.append(f"{low_key} is larger than {high_key}")
    rim, radius = metadata.get("DIMENSION.RIM_RADIUS"), coefficients.get("UNLOADED_RADIUS")
    if isinstance(rim, float) and radius is not None and rim >= radius:
        found.append("RIM_RADIUS is not smaller than UNLOADED_RADIUS")
    return found
