"""Axis systems by name: the signs that turn each one's quantities into ISO W ones.

- ISO (ISO 8855, W axes): x forward, y left, z up. A positive slip angle is a contact point that moves to
  the left.
- SAE (J670): x forward, y right, z down. A positive slip angle is a contact point that moves to the right.
- adapted SAE (Pacejka's book): the SAE axes, but a positive slip angle is a contact point that moves to the
  left, so that it causes a positive side force.

Camber is positive in all three when the wheel's top leans to the right. docs/reference/axes.md shows
each sign.
"""

from __future__ import annotations

from typing import NamedTuple

from tire_pipeline.errors import TirValueError


class Signs(NamedTuple):
    """Factors, +1 or -1, between an axis system's quantities and the ISO W ones (each is its own inverse)."""

    slip_angle: float = 1.0
    slip_ratio: float = 1.0
    camber: float = 1.0
    turn_slip: float = 1.0
    fx: float = 1.0
    fy: float = 1.0
    mx: float = 1.0
    my: float = 1.0
    mz: float = 1.0


AXES: dict[str, Signs] = {
    "ISO": Signs(),
    "SAE": Signs(slip_angle=-1.0, turn_slip=-1.0, fy=-1.0, my=-1.0, mz=-1.0),
    "adapted SAE": Signs(fy=-1.0, my=-1.0, mz=-1.0),
}
"""Axis system -> its signs."""

_MIRROR = Signs(slip_angle=-1.0, camber=-1.0, turn_slip=-1.0, fy=-1.0, mx=-1.0, mz=-1.0)


def signs_of(axes: str, mirrored: bool = False) -> Signs:
    """Return the signs of an axis system, of the mirrored tire if asked.

    Raises
    ------
    TirValueError
        For an unknown axis system.
    """
    try:
        signs = AXES[axes]
    except (KeyError, TypeError):
        raise TirValueError(
            f"axis system {axes!r} is not known", key="axes", todo=f"use one of {list(AXES)}"
        ) from None
    if mirrored:
        return Signs(*(a * b for a, b in zip(signs, _MIRROR, strict=True)))
    return signs


def is_mirrored(side: str | None, tyreside: object) -> bool:
    """Return whether a tire that is asked for on a side must be mirrored.

    Parameters
    ----------
    side : {None, "left", "right"}
        Where the tire is mounted; None: as it was measured.
    tyreside : object
        The file's ``TYRESIDE``; anything but RIGHT counts as LEFT.

    Raises
    ------
    TirValueError
        For an unknown side.
    """
    if side is None:
        return False
    if not isinstance(side, str) or side.lower() not in ("left", "right"):
        raise TirValueError(f"side {side!r} is not known", key="side", todo='use "left" or "right"')
    measured = "right" if str(tyreside).strip().strip("'\"").lower() == "right" else "left"
    return side.lower() != measured
