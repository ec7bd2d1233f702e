"""Sizes of parameters in the units that engineers use."""

from __future__ import annotations

import math
from collections.abc import Iterable

from tire_pipeline.unit_definitions import DEGREE

_AMOUNTS = {
    "1": (100.0, "%"),
    "rad": (1.0 / DEGREE, "deg"),
    "s": (1e3, "ms"),
    "rad/N": (1e3 / DEGREE, "deg/kN"),
    "rad/rad": (1.0, "deg/deg"),
}


def amount(value: float, unit: str, digits: int = 2) -> str:
    """Return the size of a parameter in the unit that engineers use.

    Examples
    --------
    >>> amount(0.0123, "1"), amount(123.4, "N"), amount(1234.0, "N")
    ('1.2%', '120 N', '1,200 N')
    """
    factor, name = _AMOUNTS.get(unit, (1.0, unit))
    return _joined(_rounded(value * factor, digits), name)


def amount_with_interval(value: float, error: float, ends: Iterable[float], unit: str) -> tuple[str, str]:
    """Return a parameter and its interval with the same decimals: two digits of the standard error.

    Examples
    --------
    >>> amount_with_interval(-0.844, 0.191, (-1.218, -0.47), "1")
    ('-84%', '-122% to -47%')
    >>> amount_with_interval(0.0123, 0.0004, (0.0115, 0.0131), "s")
    ('12.30 ms', '11.50 to 13.10 ms')
    >>> amount_with_interval(1e-3, 0.0, (1e-3, 1e-3), "times")
    ('0.001 times', 'exact')
    """
    if error == 0.0:
        return amount(value, unit, 3), "exact"
    if not (math.isfinite(error) and error > 0.0):
        return amount(value, unit, 3), "unknown"
    factor, name = _AMOUNTS.get(unit, (1.0, unit))
    decimals = max(0, 1 - math.floor(math.log10(error * factor)))
    own, low, high = (f"{each * factor:,.{decimals}f}" for each in (value, *ends))
    return _joined(own, name), f"{_joined(low, name) if name == '%' else low} to {_joined(high, name)}"


def _rounded(value: float, digits: int) -> str:
    """A number with few digits; thousands have a comma, no exponent."""
    short = float(f"{value:.{digits}g}") if math.isfinite(value) else value
    return f"{short:,.0f}" if 10.0**digits <= abs(short) < 1e9 else f"{short:.{digits}g}"


def _joined(text: str, unit: str) -> str:
    return f"{text}%" if unit == "%" else f"{text} {unit}"
