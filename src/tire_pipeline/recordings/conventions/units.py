"""Units that recordings come in: to SI (temperatures to degrees Celsius)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from tire_pipeline.unit_definitions import DEGREE, FOOT, GRAVITY, INCH, MILE, POUND_FORCE, PSI


@dataclass(frozen=True)
class Unit:
    """``SI value = factor * value + offset`` for one dimension."""

    dimension: str
    factor: float
    offset: float = 0.0


def _same(dimension: str, factor: float, *names: str) -> dict[str, Unit]:
    return {name: Unit(dimension, factor) for name in names}


# Spellings after `_plain`: lower case, no blanks, no middle dots or carets.
UNITS_BY_NAME: dict[str, Unit] = {
    **_same("time", 1, "s", "sec", "secs", "second", "seconds"),
    **_same("time", 1e-3, "ms", "msec", "millisecond", "milliseconds"),
    **_same("time", 1e-6, "us", "µs", "microsecond", "microseconds"),
    **_same("time", 1e-9, "ns"),
    **_same("time", 60, "min", "minute", "minutes"),
    **_same("time", 3600, "h", "hour", "hours"),
    **_same("time", 86_400, "d", "day", "days"),
    **_same("angle", 1, "rad", "radian", "radians"),
    **_same("angle", 1e-3, "mrad"),
    **_same("angle", DEGREE, "deg", "degree", "degrees", "°", "grad", "grd", "grad_deg"),
    **_same("force", 1, "n", "newton", "newtons"),
    **_same("force", 1e3, "kn"),
    **_same("force", 10, "dan"),
    **_same("force", POUND_FORCE, "lb", "lbs", "lbf"),
    **_same("force", GRAVITY, "kgf", "kp", "kg", "kgs"),
    **_same("moment", 1, "nm", "n-m", "n*m", "newtonmeter", "newton-meter"),
    **_same("moment", 1e3, "knm"),
    **_same("moment", 1e-3, "nmm", "n-mm", "n*mm"),
    **_same("moment", POUND_FORCE * FOOT, "ft-lb", "ftlb", "lb-ft", "lbft", "ft-lbs", "lbf-ft", "ft-lbf"),
    **_same("moment", POUND_FORCE * INCH, "in-lb", "inlb", "lb-in"),
    **_same("speed", 1, "m/s", "mps", "ms-1", "m/sec"),
    **_same("speed", 1e-3, "mm/s"),
    **_same("speed", 1 / 3.6, "km/h", "kph", "kmh", "kmph", "km/hr"),
    **_same("speed", MILE / 3600, "mph", "mi/h"),
    **_same("speed", FOOT, "ft/s"),
    **_same("pressure", 1, "pa", "n/m2"),
    **_same("pressure", 100, "hpa", "mbar"),
    **_same("pressure", 1e3, "kpa"),
    **_same("pressure", 1e6, "mpa"),
    **_same("pressure", 1e5, "bar"),
    **_same("pressure", PSI, "psi", "lb/in2", "lbf/in2"),
    **_same("temperature", 1, "degc", "°c", "c", "celsius", "deg_c", "grdc", "gradc"),
    "k": Unit("temperature", 1, -273.15),
    "kelvin": Unit("temperature", 1, -273.15),
    **{n: Unit("temperature", 5 / 9, -160 / 9) for n in ("degf", "°f", "f", "fahrenheit", "deg_f")},
    **_same("ratio", 1, "-", "1", "none", "[-]", "ratio", "n/n", "m/m"),
    **_same("ratio", 0.01, "%", "percent", "pct"),
    **_same("length", 1, "m", "meter", "metre"),
    **_same("length", 1e-3, "mm"),
    **_same("length", 1e-2, "cm"),
    **_same("length", 1e3, "km"),
    **_same("length", INCH, "in", "inch", "inches", '"'),
    **_same("length", FOOT, "ft"),
    **_same("rate", 1, "rad/s", "1/s_rad"),
    **_same("rate", DEGREE, "deg/s", "°/s", "grad/s", "grd/s"),
    **_same("rate", 2 * math.pi / 60, "rpm", "1/min", "u/min", "rev/min"),
    **_same("rate", 2 * math.pi, "1/s", "rev/s", "hz"),
    **_same("acceleration", 1, "m/s2", "m/s**2"),
    **_same("acceleration", GRAVITY, "g"),
    **_same("curvature", 1, "1/m"),
}


def _plain(name: str) -> str:
    text = name.strip().strip("[]()").strip().lower().replace(" ", "")
    for old in ("·", "⋅", "."):
        text = text.replace(old, "")
    return text.replace("²", "2").replace("^", "").replace("μ", "µ")


def number_of(text: str) -> float | None:
    """Return the number that a text is, with ``E`` or Fortran's ``D`` before its exponent, or None."""
    try:
        return float(text.replace("D", "E").replace("d", "e"))
    except ValueError:
        return None


def find_unit(name: str | None) -> Unit | None:
    """Look a unit's spelling up.

    Parameters
    ----------
    name : str or None
        As a file prints it: ``"deg"``, ``"[km/h]"``, ``"N m"``, ``"deg C"``.

    Returns
    -------
    Unit or None
        None for an unknown or empty spelling.

    Examples
    --------
    >>> find_unit("km/h").factor * 36
    10.0
    """
    if name is None:
        return None
    plain = _plain(name)
    if not plain:
        return None
    if plain in UNITS_BY_NAME:
        return UNITS_BY_NAME[plain]
    return UNITS_BY_NAME.get(plain.replace("*", ""))
