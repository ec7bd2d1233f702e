"""Lateral force at zero camber of many tires at once, from the columns of a tire table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd

FACTOR_COLUMNS = ("PCY1", "PDY1", "PDY2", "PEY1", "PEY2", "PEY3", "PKY1", "PKY2")
SHIFT_COLUMNS = ("PHY1", "PHY2", "PVY1", "PVY2")
_DEFAULTS = {"PEY3": 0.0, "PKY4": 2.0, **dict.fromkeys(SHIFT_COLUMNS, 0.0)}


@dataclass(frozen=True)
class LateralFactors:
    """Factors of the Magic Formula for n tires at L loads, every array of shape (n, L).

    ``e_side`` is the part of the curvature that changes sign with the slip angle:
    E = curvature * (1 - e_side * sgn(alpha)), at most 1.
    """

    stiffness: np.ndarray
    shape: np.ndarray
    peak: np.ndarray
    curvature: np.ndarray
    e_side: np.ndarray
    horizontal_shift: np.ndarray
    vertical_shift: np.ndarray


def lateral_factors(table: pd.DataFrame | Mapping[str, np.ndarray], loads: np.ndarray) -> LateralFactors:
    """Give B, C, D, E and the shifts of pure lateral slip at zero camber and nominal pressure.

    Parameters
    ----------
    table : DataFrame or mapping of arrays
        n tires; coefficients by their .tir names, FNOMIN in N. Scale factors (LCY, LMUY, LEY, LKY,
        LHY, LVY, LFZO), PEY3, PKY4 and the shifts may be absent or NaN: then they are neutral.
    loads : ndarray, shape (L,)
        Normal loads, N.

    Returns
    -------
    LateralFactors
        Arrays of shape (n, L): B in 1/rad, D and S_V in N, S_H in rad.

    Notes
    -----
    Thesis, equations A.17 to A.26; with PKY4 also the form of versions 6.1 and 6.2.
    """

    def column(name: str) -> np.ndarray:
        neutral = 1.0 if name.startswith("L") else _DEFAULTS.get(name)
        if name not in table:
            if neutral is None:
                raise KeyError(name)
            return np.full((len(table["PCY1"]), 1), neutral)
        values = np.asarray(table[name], dtype=float).reshape(-1, 1)
        return values if neutral is None else np.where(np.isnan(values), neutral, values)

    nominal = column("FNOMIN") * column("LFZO")
    loads = np.asarray(loads, dtype=float)[None, :]
    dfz = (loads - nominal) / nominal
    shape = column("PCY1") * column("LCY") + 0 * dfz
    peak = (column("PDY1") + column("PDY2") * dfz) * column("LMUY") * loads
    slope = (
        column("PKY1")
        * nominal
        * np.sin(column("PKY4") * np.arctan(loads / (column("PKY2") * nominal)))
        * column("LKY")
    )
    curvature = (column("PEY1") + column("PEY2") * dfz) * column("LEY")
    horizontal = (column("PHY1") + column("PHY2") * dfz) * column("LHY")
    vertical = loads * (column("PVY1") + column("PVY2") * dfz) * column("LVY") * column("LMUY")
    return LateralFactors(
        stiffness=slope / (shape * peak),
        shape=shape,
        peak=peak,
        curvature=curvature,
        e_side=column("PEY3") + 0 * dfz,
        horizontal_shift=horizontal,
        vertical_shift=vertical,
    )


def lateral_force(factors: LateralFactors, slip_angles: np.ndarray) -> np.ndarray:
    """Give the lateral force of equation A.16.

    Parameters
    ----------
    factors : LateralFactors
        Of n tires at L loads.
    slip_angles : ndarray, shape (S,)
        rad.

    Returns
    -------
    ndarray, shape (n, L, S)
        N.
    """
    alpha = np.asarray(slip_angles, dtype=float) + factors.horizontal_shift[..., None]
    curvature = factors.curvature[..., None] * (1 - factors.e_side[..., None] * np.sign(alpha))
    curvature = np.minimum(curvature, 1.0)
    argument = factors.stiffness[..., None] * alpha
    bent = argument - curvature * (argument - np.arctan(argument))
    force = factors.peak[..., None] * np.sin(factors.shape[..., None] * np.arctan(bent))
    return force + factors.vertical_shift[..., None]
