"""Pure-slip forces of many tires at once, from the columns of a tire table; camber included.

Magic Formula 5.2 in ISO W axes, by :func:`tire_pipeline.magic_formula.forces_batch`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from tire_pipeline.magic_formula import forces_batch
from tire_pipeline.magic_formula.parameters.coefficients import INDEX, missing_defaults, pack_mapping
from tire_pipeline.representations.coefficients import ALIGNING, LATERAL, LONGITUDINAL

CoefficientColumns = Mapping[str, np.ndarray]
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


_NEUTRAL_ROW = pack_mapping({}, missing_defaults({}, "5.2"))
_SCALES = ("LFZO LCX LMUX LEX LKX LHX LVX LGAX LCY LMUY LEY LKY LHY LVY LGAY LTR LRES LGAZ").split()


def _output(name: str, p: CoefficientColumns, points: Points, slip: str = "slip_angle") -> np.ndarray:
    """One output of :func:`forces_batch`, shape (n, m), where the other slip is zero."""
    rows = max(len(x) if np.ndim(x) == 2 else 1 for x in (*p.values(), points.slip, points.normal_load))
    matrix = np.tile(_NEUTRAL_ROW, (rows, 1))
    for coefficient, column in p.items():
        matrix[:, INDEX[coefficient]] = column[:, 0]
    at: dict[str, Any] = {slip: points.slip, "normal_load": points.normal_load, "camber": points.camber}
    return forces_batch(matrix, **at, outputs=(name,))[name]


def cornering_stiffness(p: CoefficientColumns, points: Points) -> np.ndarray:
    """K_y of A.25, N/rad, shape (n, m); negative, as ISO W axes have it."""
    return _output("cornering_stiffness", p, points)


def peak_friction(p: CoefficientColumns, points: Points) -> np.ndarray:
    """mu_y of A.19, shape (n, m)."""
    return _output("friction_y", p, points)


def slip_stiffness(p: CoefficientColumns, points: Points) -> np.ndarray:
    """K_x of A.12, N, shape (n, m)."""
    return _output("slip_stiffness", p, points, "slip_ratio")


def peak_friction_x(p: CoefficientColumns, points: Points) -> np.ndarray:
    """mu_x of A.8, shape (n, m)."""
    return _output("friction_x", p, points, "slip_ratio")


def longitudinal_force(p: CoefficientColumns, points: Points) -> np.ndarray:
    """F_x0 of A.4, N, shape (n, m)."""
    return _output("fx", p, points, "slip_ratio")


def lateral_force(p: CoefficientColumns, points: Points) -> np.ndarray:
    """F_y0 of A.16, N, shape (n, m)."""
    return _output("fy", p, points)


def aligning_torque(p: CoefficientColumns, points: Points) -> np.ndarray:
    """M_z of A.28 to A.41 at zero slip ratio, N m, shape (n, m)."""
    return _output("mz", p, points)
