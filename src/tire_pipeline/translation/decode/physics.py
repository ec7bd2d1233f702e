"""What any tire obeys: the bounds of every translated file."""

from __future__ import annotations

import numpy as np
import pandas as pd

from tire_pipeline.translation.curves.pure_slip import (
    CoefficientColumns,
    Points,
    columns,
    cornering_stiffness,
    peak_friction,
    peak_friction_x,
    slip_stiffness,
)

FRICTION = (0.3, 2.0)
"""Peak friction of a pneumatic tire on a test surface."""

SHAPE = {"PCY1": (1.0, 2.0), "PCX1": (1.0, 2.0)}
"""Shape factors: below 1 a curve has no peak, above 2 it crosses zero."""

CHECKED_LOADS = np.array([2000.0, 3500.0, 5000.0, 6500.0, 8000.0])
_CHECKED_ORIGIN = Points.grid([0.0], CHECKED_LOADS, [0.0])

SYMMETRY = {
    "lateral": ("PEY3", "PHY1", "PHY2", "PVY1", "PVY2"),
    "longitudinal": ("PEX4", "PHX1", "PHX2", "PVX1", "PVX2"),
}
"""Coefficients that are all zero if a curve at zero camber is the same to both sides."""


def _dfz(p: CoefficientColumns) -> np.ndarray:
    nominal = p["FNOMIN"] * p.get("LFZO", 1.0)
    return (CHECKED_LOADS[None, :] - nominal) / nominal


def curvature(group: str, p: CoefficientColumns) -> np.ndarray:
    """Curvature factor E before it is bounded by 1, on both sides at ``CHECKED_LOADS``, (n, 2 loads)."""
    dfz = _dfz(p)
    if group == "lateral":
        level, side = (p["PEY1"] + p["PEY2"] * dfz) * p.get("LEY", 1.0), p["PEY3"]
    elif group == "longitudinal":
        level, side = (p["PEX1"] + p["PEX2"] * dfz + p["PEX3"] * dfz**2) * p.get("LEX", 1.0), p["PEX4"]
    elif group == "aligning":
        level, side = p["QEZ1"] + p["QEZ2"] * dfz + p["QEZ3"] * dfz**2, p["QEZ4"]
    else:
        return np.zeros((len(dfz), 0))
    return np.concatenate([level * (1.0 - side), level * (1.0 + side)], axis=1)


def curvature_excess(group: str, p: CoefficientColumns) -> np.ndarray:
    """By how much the curvature factor exceeds 1, (n, 2 loads or 0)."""
    return np.maximum(curvature(group, p) - 1.0, 0.0)


def violations(table: pd.DataFrame) -> pd.DataFrame:
    """Tell for every tire which physical bounds it breaks between 2000 N and 8000 N.

    Parameters
    ----------
    table : DataFrame
        n tires.

    Returns
    -------
    DataFrame of bool
        Index of ``table``; columns ``lateral friction``, ``longitudinal friction``, ``cornering stiffness``
        (not positive, or growing faster than the load), ``slip stiffness``, ``curvature`` (E above 1 by
        more than 0.001), ``shape``. With positive stiffness, C in [1, 2] and E at most 1 a Magic Formula
        curve rises up to its peak, so that needs no column of its own.
    """
    p = columns(table)
    friction, friction_x = peak_friction(p, _CHECKED_ORIGIN), peak_friction_x(p, _CHECKED_ORIGIN)
    stiffness = -cornering_stiffness(p, _CHECKED_ORIGIN)
    over_load = stiffness / CHECKED_LOADS
    excess = [curvature_excess(name, p).max(axis=1) for name in ("lateral", "longitudinal", "aligning")]
    shape = [(p[name] < low) | (p[name] > high) for name, (low, high) in SHAPE.items()]
    broken = {
        "lateral friction": _outside(friction, *FRICTION),
        "longitudinal friction": _outside(friction_x, *FRICTION),
        "cornering stiffness": (stiffness <= 0.0).any(axis=1)
        | (np.diff(over_load, axis=1) > 0.0).any(axis=1),
        "slip stiffness": (slip_stiffness(p, _CHECKED_ORIGIN) <= 0.0).any(axis=1),
        "curvature": np.max(excess, axis=0) > 1e-3,
        "shape": np.concatenate(shape, axis=1).any(axis=1),
    }
    return pd.DataFrame(broken, index=table.index)


def _outside(values: np.ndarray, low: float, high: float) -> np.ndarray:
    return np.asarray(~((values >= low) & (values <= high)).all(axis=1))


def symmetric(table: pd.DataFrame, group: str) -> np.ndarray:
    """Tell which tires have the same curve to both sides at zero camber, (n,)."""
    p = columns(table)
    return np.asarray(np.concatenate([p[name] == 0.0 for name in SYMMETRY[group]], axis=1).all(axis=1))
