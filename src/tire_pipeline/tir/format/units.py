"""The names that the ``[UNITS]`` section may use, and their values in SI.

Names are those of Adams Tire ("Units Supported in Tire Property Files"; case is ignored) and the ones that
other tools write. The coefficients of the Magic Formula (p, q, r, s) are never scaled: they are ratios, and
where an angle enters they are per radian whatever ``ANGLE`` says. Project Chrono's PAC2002 reader does the
same, and the MF-Tyre manual asks for SI units throughout.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from tire_pipeline.errors import TirValueError
from tire_pipeline.unit_definitions import DEGREE, FOOT, GRAVITY, INCH, MILE, POUND, POUND_FORCE, PSI

_NAMES_OF_UNITS: dict[str, dict[float, str]] = {
    "LENGTH": {
        1.0: "M METER METERS METRE METRES",
        1e-3: "MM MILLIMETER MILLIMETERS MILLIMETRE MILLIMETRES",
        1e-2: "CM CENTIMETER CENTIMETERS CENTIMETRE CENTIMETRES",
        1e3: "KM KILOMETER KILOMETERS KILOMETRE KILOMETRES",
        INCH: "IN INCH INCHES",
        FOOT: "FT FOOT FEET",
        MILE: "MILE MILES",
    },
    "FORCE": {
        1.0: "N NEWTON NEWTONS",
        1e3: "KN KNEWTON KNEWTONS KILONEWTON KILONEWTONS",
        1e6: "MN MEGANEWTON MEGANEWTONS",
        POUND_FORCE: "LBF LB LBS POUND POUNDS POUND_FORCE POUNDFORCE POUNDS_FORCE",
        1e3 * POUND_FORCE: "KLBF KIP KIPS KPOUND_FORCE",
        GRAVITY: "KGF KG_FORCE KILOGRAM_FORCE KP KILOPOND",
        POUND_FORCE / 16: "OZF OUNCE_FORCE",
        1e-5: "DYN DYNE DYNES",
    },
    "ANGLE": {
        1.0: "RAD RADIAN RADIANS",
        DEGREE: "DEG DEGREE DEGREES",
    },
    "MASS": {
        1.0: "KG KILOGRAM KILOGRAMS KILO",
        1e-3: "G GRAM GRAMS",
        1e3: "T TONNE TONNES MEGAGRAM",
        POUND: "LB LBS LBM POUND POUNDS POUND_MASS POUNDMASS POUNDS_MASS",
        1e3 * POUND: "KPOUND_MASS KLBM",
        POUND_FORCE / FOOT: "SLUG SLUGS",
        POUND_FORCE / INCH: "SLINCH SLINCHES",
        POUND / 16: "OZ OUNCE_MASS",
    },
    "TIME": {
        1.0: "S SEC SECS SECOND SECONDS",
        1e-3: "MS MSEC MILLI MILLISECOND MILLISECONDS",
        60.0: "MIN MINUTE MINUTES",
        3600.0: "H HOUR HOURS",
    },
    "PRESSURE": {
        1.0: "PA PASCAL PASCALS N/M^2 N/M2 NEWTON/METER^2",
        1e2: "HPA MBAR MILLIBAR",
        1e3: "KPA KPASCAL KILOPASCAL KILOPASCALS",
        1e6: "MPA MPASCAL MEGAPASCAL MEGAPASCALS N/MM^2 N/MM2",
        1e5: "BAR BARS",
        PSI: "PSI LBF/IN^2 LBF/IN2",
        1e3 * PSI: "KSI",
    },
    "SPEED": {
        1.0: "M/S MPS METER/SECOND METERS/SECOND",
        1e-3: "MM/S",
        1 / 3.6: "KM/H KMH KPH",
        MILE / 3600: "MPH MILES/HOUR",
        FOOT: "FT/S FPS",
    },
}
FACTORS: dict[str, dict[str, float]] = {
    quantity: {name: factor for factor, names in table.items() for name in names.split()}
    for quantity, table in _NAMES_OF_UNITS.items()
}
"""Quantity -> unit name in capitals -> SI units in one of it."""

QUANTITIES = ("LENGTH", "FORCE", "ANGLE", "MASS", "TIME")
"""What every file should state; ``PRESSURE`` and ``SPEED`` are optional."""


def unit_factor(quantity: str, name: str, *, path: str | None = None, line: int | None = None) -> float:
    """Return the factor from a unit to SI.

    Raises
    ------
    TirValueError
        The name is unknown. Assuming SI instead would be a silent error by powers of ten.
    """
    table = FACTORS[quantity]
    key = " ".join(name.split()).upper().replace(" ", "_").rstrip(".")
    if key in table:
        return table[key]
    raise TirValueError(
        f"{quantity} = {name[:60]!r} is not a known unit",
        path=path,
        line=line,
        key=quantity,
        todo=f"use one of {', '.join(_first_names(quantity))}",
    )


def _first_names(quantity: str) -> Iterable[str]:
    return (names.split()[0] for names in _NAMES_OF_UNITS[quantity].values())


def dimension_factors(units: Mapping[str, float]) -> dict[str, float]:
    """Return the factor to SI for each dimension that a key can have.

    Parameters
    ----------
    units : mapping
        Quantity -> factor; what is missing counts as SI. Speed follows from length and time if it is not
        stated.
    """
    length, force, angle, mass, time = (units.get(each, 1.0) for each in QUANTITIES)
    return {
        "": 1.0,
        "length": length,
        "force": force,
        "angle": angle,
        "mass": mass,
        "time": time,
        "pressure": units.get("PRESSURE", 1.0),
        "speed": units.get("SPEED", length / time),
        "stiffness": force / length,
        "damping": force * time / length,
        "yaw stiffness": force * length / angle,
        "inertia": mass * length**2,
        "acceleration": length / time**2,
    }
