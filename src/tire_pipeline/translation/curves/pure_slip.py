"""Pure-slip forces of many tires at once, from the columns of a tire table; camber included.

Magic Formula 5.2, thesis, equations A.4 to A.14 (F_x), A.16 to A.26 (F_y) and A.28 to A.41 (M_z), ISO W axes.
One tire at a time is :meth:`tire_pipeline.magic_formula.TireModel.forces`; a translation asks for
thousands of tires at a few hundred points, and for the derivatives, which this does in one go.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from tire_pipeline.representations.coefficients import ALIGNING, LATERAL, LONGITUDINAL

Columns = Mapping[str, np.ndarray]
"""Coefficients by their .tir names, each of shape (n, 1)."""


@dataclass(frozen=True)
class Points:
    """Operating points, the same for every tire; arrays of shape (m,) or, one row a tire, (n, m).

    Attributes
    ----------
    slip : ndarray
        Slip angle, rad, or slip ratio.
    normal_load : ndarray
        N.
    camber : ndarray
        rad.
    """

    slip: np.ndarray
    normal_load: np.ndarray
    camber: np.ndarray

    @classmethod
    def grid(cls, slip: ArrayLike, normal_load: ArrayLike, camber: ArrayLike) -> Points:
        """Every combination, in the order (normal_load, camber, slip)."""
        load, tilt, along = np.meshgrid(normal_load, camber, slip, indexing="ij")
        return cls(along.ravel(), load.ravel(), tilt.ravel())


def columns(table: pd.DataFrame, names: Sequence[str] = ()) -> dict[str, np.ndarray]:
    """Take coefficients out of a tire table.

    Parameters
    ----------
    table : DataFrame
        n tires.
    names : sequence of str
        Coefficients; without it all p and q coefficients, FNOMIN and UNLOADED_RADIUS. Scale factors are
        multiplied in by the functions below if they are columns.

    Returns
    -------
    dict of ndarray
        Each (n, 1); what a file lacks is neutral: 0.
    """
    names = names or (*LONGITUDINAL, *LATERAL, *ALIGNING, "FNOMIN", "UNLOADED_RADIUS")
    found = {}
    for name in (*names, *(scale for scale in _SCALES if scale in table)):
        values = np.asarray(table[name], dtype=float) if name in table else np.zeros(len(table))
        neutral = 1.0 if name in _SCALES else 0.0
        found[name] = np.where(np.isnan(values), neutral, values)[:, None]
    return found


_SCALES = ("LFZO LCX LMUX LEX LKX LHX LVX LGAX LCY LMUY LEY LKY LHY LVY LGAY LTR LRES LGAZ").split()


def _scale(p: Columns, name: str) -> np.ndarray | float:
    return p.get(name, 1.0)


def _load(p: Columns, points: Points) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    nominal = p["FNOMIN"] * _scale(p, "LFZO")
    load = np.atleast_2d(points.normal_load)
    return load, nominal, (load - nominal) / nominal


def _sine(x: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray, e: np.ndarray) -> np.ndarray:
    u = b * x
    return d * np.sin(c * np.arctan(u - e * (u - np.arctan(u))))


def cornering_stiffness(p: Columns, points: Points) -> np.ndarray:
    """K_y of A.25, N/rad, shape (n, m); negative, as ISO W axes have it."""
    load, nominal, _ = _load(p, points)
    ratio = load / (p["PKY2"] * nominal)
    wave = 2.0 * ratio / (1.0 + ratio * ratio)
    camber = points.camber * _scale(p, "LGAY")
    return p["PKY1"] * nominal * wave * (1.0 - p["PKY3"] * np.abs(camber)) * _scale(p, "LKY")


def peak_friction(p: Columns, points: Points) -> np.ndarray:
    """mu_y of A.19, shape (n, m)."""
    _, _, dfz = _load(p, points)
    camber = points.camber * _scale(p, "LGAY")
    return (p["PDY1"] + p["PDY2"] * dfz) * (1.0 - p["PDY3"] * camber**2) * _scale(p, "LMUY")


def slip_stiffness(p: Columns, points: Points) -> np.ndarray:
    """K_x of A.12, N, shape (n, m)."""
    load, _, dfz = _load(p, points)
    return load * (p["PKX1"] + p["PKX2"] * dfz) * np.exp(p["PKX3"] * dfz) * _scale(p, "LKX")


def peak_friction_x(p: Columns, points: Points) -> np.ndarray:
    """mu_x of A.8, shape (n, m)."""
    _, _, dfz = _load(p, points)
    camber = points.camber * _scale(p, "LGAX")
    return (p["PDX1"] + p["PDX2"] * dfz) * (1.0 - p["PDX3"] * camber**2) * _scale(p, "LMUX")


def longitudinal_force(p: Columns, points: Points) -> np.ndarray:
    """F_x0 of A.4, N, shape (n, m)."""
    load, _, dfz = _load(p, points)
    x = points.slip + (p["PHX1"] + p["PHX2"] * dfz) * _scale(p, "LHX")
    c = p["PCX1"] * _scale(p, "LCX")
    d = np.maximum(load * peak_friction_x(p, points), 1.0)
    e = (p["PEX1"] + p["PEX2"] * dfz + p["PEX3"] * dfz**2) * (1.0 - p["PEX4"] * np.sign(x))
    e = np.minimum(e * _scale(p, "LEX"), 1.0)
    vertical = load * (p["PVX1"] + p["PVX2"] * dfz) * _scale(p, "LVX") * _scale(p, "LMUX")
    return _sine(x, slip_stiffness(p, points) / (c * d), c, d, e) + vertical


def lateral_force(p: Columns, points: Points) -> np.ndarray:
    """F_y0 of A.16, N, shape (n, m)."""
    return _lateral(p, points)[0]


def _lateral(p: Columns, points: Points) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """F_y0, S_Hf and B_y C_y."""
    load, _, dfz = _load(p, points)
    camber = points.camber * _scale(p, "LGAY")
    x = points.slip + (p["PHY1"] + p["PHY2"] * dfz) * _scale(p, "LHY") + p["PHY3"] * camber
    c = p["PCY1"] * _scale(p, "LCY")
    d = np.maximum(load * peak_friction(p, points), 1.0)
    e = (p["PEY1"] + p["PEY2"] * dfz) * (1.0 - (p["PEY3"] + p["PEY4"] * camber) * np.sign(x))
    e = np.minimum(e * _scale(p, "LEY"), 1.0)
    k = cornering_stiffness(p, points)
    vertical = (p["PVY1"] + p["PVY2"] * dfz) * _scale(p, "LVY") + (p["PVY3"] + p["PVY4"] * dfz) * camber
    vertical = load * vertical * _scale(p, "LMUY")
    shift = x - points.slip + vertical / k
    return _sine(x, k / (c * d), c, d, e) + vertical, shift, k / d


def aligning_torque(p: Columns, points: Points) -> np.ndarray:
    """M_z of A.28 to A.41 at zero slip ratio, N m, shape (n, m)."""
    load, nominal, dfz = _load(p, points)
    fy, shift, by_cy = _lateral(p, points)
    camber = points.camber * _scale(p, "LGAZ")
    tilt, friction = np.abs(camber), _scale(p, "LMUY")
    x = points.slip + p["QHZ1"] + p["QHZ2"] * dfz + (p["QHZ3"] + p["QHZ4"] * dfz) * camber
    b = (p["QBZ1"] + p["QBZ2"] * dfz + p["QBZ3"] * dfz**2) * (1.0 + p["QBZ4"] * camber + p["QBZ5"] * tilt)
    b = b * _scale(p, "LKY") / friction
    c = p["QCZ1"]
    d = load * p["UNLOADED_RADIUS"] / nominal * (p["QDZ1"] + p["QDZ2"] * dfz) * _scale(p, "LTR")
    d = d * (1.0 + p["QDZ3"] * camber + p["QDZ4"] * camber**2)
    u = b * x
    side = (p["QEZ4"] + p["QEZ5"] * camber) * (2.0 / np.pi) * np.arctan(u * c)
    e = np.minimum((p["QEZ1"] + p["QEZ2"] * dfz + p["QEZ3"] * dfz**2) * (1.0 + side), 1.0)
    turn = np.cos(points.slip)
    trail = d * np.cos(c * np.arctan(u - e * (u - np.arctan(u)))) * turn
    br = p["QBZ9"] * _scale(p, "LKY") / friction + p["QBZ10"] * by_cy
    level = (p["QDZ6"] + p["QDZ7"] * dfz) * _scale(p, "LRES") + (p["QDZ8"] + p["QDZ9"] * dfz) * camber
    residual = load * p["UNLOADED_RADIUS"] * level * friction * turn
    return -trail * fy + residual / np.sqrt(1.0 + (br * (points.slip + shift)) ** 2)
