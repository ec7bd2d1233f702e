"""Values that a file may hold but that are probably in another unit, or contradict each other."""

from __future__ import annotations

import math
from collections.abc import Mapping

from tire_pipeline.channels import TIRE_RADII
from tire_pipeline.magic_formula.parameters.coefficients import RANGE_KEYS

_PLAUSIBLE = {
    "UNLOADED_RADIUS": (*TIRE_RADII, "m"),
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
_LARGEST = {
    "PKX1": (300.0, "is so stiff for its load"),
    "PKY1": (300.0, "is so stiff for its load"),
    "PDX1": (10.0, "has such a friction"),
    "PDY1": (10.0, "has such a friction"),
}
"""Largest magnitudes, far beyond any tire: racing tires have 80 and 3."""


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
    for key, (most, what) in _LARGEST.items():
        if abs(coefficients.get(key, 0.0)) > most:
            found.append(f"{key} = {coefficients[key]:g} is implausible: no tire {what}")
    found += unlike_iso(coefficients)
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


def unlike_iso(coefficients: Mapping[str, float]) -> list[str]:
    """Return a sentence for each output that has the other sign than in ISO W axes.

    By the slip stiffness of a force, and by the pneumatic trail of the aligning moment.

    Parameters
    ----------
    coefficients : mapping

    Examples
    --------
    >>> unlike_iso({"PKY1": -20.0, "PKY2": 2.0, "PKX1": 22.0})
    []
    >>> unlike_iso({"PKY1": 20.0, "PKY2": 2.0})[0].partition(": ")[2]
    'a positive slip angle gives a positive Fy (PKY1 = 20); export the file in ISO W'
    """
    lateral = coefficients.get("PKY1", 0.0)
    factors = (coefficients.get(name, 1.0) for name in ("PKY2", "PKY4", "LKY"))
    longitudinal = coefficients.get("PKX1", 0.0)
    found = []
    if math.prod(math.copysign(1.0, each) for each in factors) * lateral > 0.0:
        found.append(
            "Fy has the other sign than in ISO W, the axes of .tir files: a positive slip angle gives a "
            f"positive Fy (PKY1 = {lateral:g}); export the file in ISO W"
        )
    if longitudinal * coefficients.get("LKX", 1.0) < 0.0:
        found.append(
            "Fx has the other sign than in ISO W, the axes of .tir files: a positive slip ratio gives a "
            f"negative Fx (PKX1 = {longitudinal:g}); export the file in ISO W"
        )
    trail = coefficients.get("QDZ1", 0.0)
    if trail * coefficients.get("LTR", 1.0) < 0.0:
        found.append(
            "Mz has the other sign than in ISO W, the axes of .tir files: the pneumatic trail is negative "
            f"(QDZ1 = {trail:g}), and Mz turns the wheel out of its run; export the file in ISO W"
        )
    return found
