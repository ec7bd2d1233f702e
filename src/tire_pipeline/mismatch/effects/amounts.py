"""Sizes of parameters in the units that engineers use."""

from __future__ import annotations

_AMOUNTS = {
    "1": (100.0, "%"),
    "rad": (57.29578, "deg"),
    "s": (1e3, "ms"),
    "rad/N": (57.29578e3, "deg/kN"),
    "rad/rad": (1.0, "deg/deg"),
}


def amount(value: float, unit: str, digits: int = 2) -> str:
    """Return the size of a parameter in the unit that engineers use."""
    factor, name = _AMOUNTS.get(unit, (1.0, unit))
    return f"{value * factor:.{digits}g} {name}"
