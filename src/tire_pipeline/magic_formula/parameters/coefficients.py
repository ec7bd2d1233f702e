"""The coefficients that each version uses, defaults of missing ones, and the packed order."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Mapping
from typing import Any

import numpy as np

from tire_pipeline.errors import TirValueError, TirVersionError

FAMILIES = {"5.0": 5, "5.1": 5, "5.2": 5, "PAC2002": 5, "6.1": 6, "6.2": 6}
"""Version name -> 5 (equations of MF 5.2) or 6 (equations of MF 6.1 and 6.2)."""


def _numbered(prefix: str, *numbers: int) -> list[str]:
    return [f"{prefix}{n}" for n in numbers]


GENERAL = ["FNOMIN", "UNLOADED_RADIUS", "LONGVL"]
PRESSURE_COEFFICIENTS = ["NOMPRES", "INFLPRES"]

_SCALE_BOTH = [
    "LFZO",
    "LCX",
    "LMUX",
    "LEX",
    "LKX",
    "LHX",
    "LVX",
    "LCY",
    "LMUY",
    "LEY",
    "LKY",
    "LHY",
    "LVY",
    "LTR",
    "LRES",
    "LXAL",
    "LYKA",
    "LVYKA",
    "LS",
    "LMX",
    "LVMX",
    "LMY",
    "LSGKP",
    "LSGAL",
]
_SCALE_5 = ["LGAX", "LGAY", "LGAZ"]
_SCALE_6 = ["LKYC", "LKZC", "LMP"]
SCALE_FACTORS = _SCALE_BOTH + _SCALE_5 + _SCALE_6
"""All scale factors (lambdas) that some version uses; a missing one is 1."""

_BOTH = [
    "PCX1",
    *_numbered("PDX", 1, 2, 3),
    *_numbered("PEX", 1, 2, 3, 4),
    *_numbered("PKX", 1, 2, 3),
    *_numbered("PHX", 1, 2),
    *_numbered("PVX", 1, 2),
    "PCY1",
    *_numbered("PDY", 1, 2, 3),
    *_numbered("PEY", 1, 2, 3, 4),
    *_numbered("PKY", 1, 2, 3),
    *_numbered("PHY", 1, 2),
    *_numbered("PVY", 1, 2, 3, 4),
    *_numbered("QBZ", 1, 2, 3, 4, 5, 9, 10),
    "QCZ1",
    *_numbered("QDZ", 1, 2, 3, 4, 6, 7, 8, 9),
    *_numbered("QEZ", 1, 2, 3, 4, 5),
    *_numbered("QHZ", 1, 2, 3, 4),
    *_numbered("RBX", 1, 2),
    "RCX1",
    *_numbered("REX", 1, 2),
    "RHX1",
    *_numbered("RBY", 1, 2, 3),
    "RCY1",
    *_numbered("REY", 1, 2),
    *_numbered("RHY", 1, 2),
    *_numbered("RVY", 1, 2, 3, 4, 5, 6),
    *_numbered("SSZ", 1, 2, 3, 4),
    *_numbered("QSX", 1, 2, 3),
    *_numbered("QSY", 1, 2, 3, 4),
    *_numbered("PTX", 1, 2, 3),
    *_numbered("PTY", 1, 2),
]
_ONLY_5 = ["PHY3"]
_ONLY_6 = [
    *_numbered("PPX", 1, 2, 3, 4),
    *_numbered("PKY", 4, 5, 6, 7),
    "PEY5",
    *_numbered("PPY", 1, 2, 3, 4, 5),
    *_numbered("QDZ", 10, 11),
    *_numbered("PPZ", 1, 2),
    "RBX3",
    "RBY4",
    *_numbered("QSX", *range(4, 15)),
    "PPMX1",
    *_numbered("QSY", 5, 6, 7, 8),
    "LONGITUDINAL_STIFFNESS",
    "LATERAL_STIFFNESS",
    *_numbered("PCFX", 1, 2, 3),
    *_numbered("PCFY", 1, 2, 3),
]
_TURN_SLIP = [
    *_numbered("PDXP", 1, 2, 3),
    "PKYP1",
    *_numbered("PDYP", 1, 2, 3, 4),
    *_numbered("PHYP", 1, 2, 3, 4),
    *_numbered("PECP", 1, 2),
    "QDTP1",
    *_numbered("QCRP", 1, 2),
    "QBRP1",
    "QDRP1",
]

EXTENSIONS_6 = ("PHY3", "QYZ1")
"""Not of MF 6.1: what a model converted from 5.2 carries so that nothing changes (:mod:`.convert`)."""

COEFFICIENT_NAMES: tuple[str, ...] = tuple(
    [*GENERAL, *PRESSURE_COEFFICIENTS, *SCALE_FACTORS, *_BOTH, *_ONLY_5, *_ONLY_6, *_TURN_SLIP, "QYZ1"]
)
"""The order of a packed coefficient vector: one order for all versions."""

INDEX: dict[str, int] = {name: i for i, name in enumerate(COEFFICIENT_NAMES)}
"""Coefficient name -> place in a packed vector."""

NAMES_BY_FAMILY: dict[int, tuple[str, ...]] = {
    5: (*GENERAL, *_SCALE_BOTH, *_SCALE_5, *_BOTH, *_ONLY_5),
    6: (*GENERAL, *PRESSURE_COEFFICIENTS, *_SCALE_BOTH, *_SCALE_6, *_BOTH, *_ONLY_6, *_TURN_SLIP),
}
"""The coefficients that the equations of a family use."""

Coefficients: Any = namedtuple("Coefficients", COEFFICIENT_NAMES)  # type: ignore[misc]
Coefficients.__doc__ = "All coefficients by name, as the equations read them."

_DEFAULTS = dict.fromkeys(COEFFICIENT_NAMES, 0.0)
_DEFAULTS.update(dict.fromkeys(SCALE_FACTORS, 1.0))
_DEFAULTS.update(PKY4=2.0, QSY7=1.0, LONGVL=16.7, UNLOADED_RADIUS=np.nan)

RANGE_KEYS: dict[str, tuple[str, str]] = {
    "slip_angle": ("ALPMIN", "ALPMAX"),
    "slip_ratio": ("KPUMIN", "KPUMAX"),
    "camber": ("CAMMIN", "CAMMAX"),
    "normal_load": ("FZMIN", "FZMAX"),
    "pressure": ("PRESMIN", "PRESMAX"),
}
"""Input -> the two coefficients that give its valid range."""

_SHAPES = [INDEX[name] for name in ("PCX1", "PCY1", "PKY4", "QCZ1", "RCX1", "RCY1", "RVY5", "QSX5")]
_SHAPES += [INDEX[name] for name in ("QSX7", "QSX8", "LCX", "LCY")]
_LARGEST_SHAPE = 1e3

_NOT_ZERO = ("PCX1", "PCY1", "PKY2", "LFZO", "LCX", "LCY", "LMUY")
_POSITIVE = ("FNOMIN", "UNLOADED_RADIUS")


def family_of(version: str) -> int:
    """Return 5 or 6, the family of equations that a version is evaluated with.

    Raises
    ------
    TirVersionError
        For an unknown version.
    """
    try:
        return FAMILIES[version]
    except (KeyError, TypeError):
        raise TirVersionError(
            f"Magic Formula version {version!r} is not known",
            todo=f"use one of {', '.join(FAMILIES)}",
        ) from None


def missing_defaults(coefficients: Mapping[str, float], version: str) -> dict[str, float]:
    """Return the missing coefficients that the version's equations use, with their defaults.

    A missing scale factor is 1, ``PKY4`` 2 and ``QSY7`` 1 (both give the 5.2 form), ``LONGVL`` 16.7 m/s,
    ``NOMPRES`` takes ``INFLPRES`` and the other way round, everything else 0. ``UNLOADED_RADIUS`` has no
    default: it is NaN, and so is what needs it.
    """
    missing = {
        name: _DEFAULTS[name] for name in NAMES_BY_FAMILY[family_of(version)] if name not in coefficients
    }
    for name, other in (("NOMPRES", "INFLPRES"), ("INFLPRES", "NOMPRES")):
        if name in missing and other in coefficients:
            missing[name] = float(coefficients[other])
    return missing


def check_values(coefficients: Mapping[str, float], path: str | None = None) -> None:
    """Raise :class:`TirValueError`, naming the key, for values that no equation can use.

    Not finite or not a number; ``FNOMIN`` missing, zero or negative; a divisor (``PCX1``, ``PCY1``,
    ``PKY2``, some scale factors) that is zero.
    """
    if "FNOMIN" not in coefficients:
        raise TirValueError(
            "there is no nominal load FNOMIN",
            key="FNOMIN",
            path=path,
            todo="add FNOMIN (N) to the [VERTICAL] section",
        )
    for key, value in coefficients.items():
        try:
            finite = bool(np.isfinite(value))
        except TypeError:
            finite = False
        if not finite or isinstance(value, str):
            raise TirValueError(
                f"{key} = {value!r} is not a finite number", key=key, path=path, todo="correct it"
            )
    for key in _POSITIVE:
        if key in coefficients and not coefficients[key] > 0:
            raise TirValueError(
                f"{key} = {coefficients[key]!r} must be positive",
                key=key,
                path=path,
                todo="enter the tire's own value",
            )
    for key in _NOT_ZERO:
        if coefficients.get(key, 1.0) == 0:
            raise TirValueError(
                f"{key} = 0, and the equations divide by it",
                key=key,
                path=path,
                todo="enter the tire's own value, or leave the key out where the force is not modelled",
            )


def is_possible(name: str, value: float) -> bool:
    """Whether a file or model may state this value, see :func:`check_values`."""
    try:
        check_values({"FNOMIN": 1.0, name: value})
    except TirValueError:
        return False
    return True


def are_moderate(matrix: np.ndarray) -> np.ndarray:
    """Return for each packed tire whether none of its shape factors is beyond 1000.

    Shape factors multiply angles inside sines and cosines; compiled code is accurate only up to 1e5.
    """
    return np.asarray(np.abs(matrix[:, _SHAPES]).max(axis=1, initial=0.0) <= _LARGEST_SHAPE)


def pack_mapping(coefficients: Mapping[str, float], defaulted: Mapping[str, float]) -> np.ndarray:
    """Return the packed vector (``COEFFICIENT_NAMES`` order) of given values and defaults."""
    vector = np.array([_DEFAULTS[name] for name in COEFFICIENT_NAMES])
    for source in (defaulted, coefficients):
        for name, value in source.items():
            if name in INDEX:
                vector[INDEX[name]] = value
    return vector
