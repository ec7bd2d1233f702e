"""Lateral force at zero camber of many tires at once, from the columns of a tire table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.magic_formula.equations.equations_61 import NO_TURN_SLIP, pure_lateral
from tire_pipeline.magic_formula.equations.shapes import sine_curve
from tire_pipeline.magic_formula.parameters.coefficients import Coefficients, missing_defaults, pack_mapping

FACTOR_COLUMNS = ("PCY1", "PDY1", "PDY2", "PEY1", "PEY2", "PEY3", "PKY1", "PKY2")
SHIFT_COLUMNS = ("PHY1", "PHY2", "PVY1", "PVY2")
SCALE_COLUMNS = ("LFZO", "LCY", "LMUY", "LEY", "LKY", "LHY", "LVY")
_LATERAL_COLUMNS = ("FNOMIN", *FACTOR_COLUMNS, "PKY4", *SHIFT_COLUMNS, *SCALE_COLUMNS)
_NEUTRAL_COEFFICIENTS = Coefficients(*pack_mapping({}, missing_defaults({}, "6.1")).tolist())
_LATERAL_DEFAULTS = {"PEY3": 0.0, "PKY4": 2.0, **dict.fromkeys(SHIFT_COLUMNS, 0.0)}


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
    """Return B, C, D, E and the shifts of pure lateral slip at zero camber and nominal pressure.

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
    The engine's own lateral force, without camber; with PKY4 = 2 version 6.1 is the thesis' A.17 to A.26.
    """

    def column(name: str) -> np.ndarray:
        neutral = 1.0 if name.startswith("L") else _LATERAL_DEFAULTS.get(name)
        if name not in table:
            if neutral is None:
                raise KeyError(name)
            return np.full((len(table["PCY1"]), 1), neutral)
        values = np.asarray(table[name], dtype=float).reshape(-1, 1)
        return values if neutral is None else np.where(np.isnan(values), neutral, values)

    p: Any = _NEUTRAL_COEFFICIENTS._replace(**{name: column(name) for name in _LATERAL_COLUMNS})
    loads = np.asarray(loads, dtype=float)[None, :]
    nominal = p.FNOMIN * p.LFZO
    dfz = (loads - nominal) / nominal
    none = 0.0 * dfz
    _, friction, slope, horizontal, vertical, _ = pure_lateral(
        p, none, none, loads, dfz, none, nominal, NO_TURN_SLIP
    )
    shape, peak = p.PCY1 * p.LCY + none, friction * loads
    return LateralFactors(
        stiffness=slope / (shape * peak),
        shape=shape,
        peak=peak,
        curvature=(p.PEY1 + p.PEY2 * dfz) * p.LEY,
        e_side=p.PEY3 + none,
        horizontal_shift=horizontal,
        vertical_shift=vertical,
    )


def lateral_force(factors: LateralFactors, slip_angles: np.ndarray) -> np.ndarray:
    """Return the lateral force of equation A.16.

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
    force: np.ndarray = sine_curve(
        factors.stiffness[..., None], factors.shape[..., None], factors.peak[..., None], curvature, alpha
    )
    return force + factors.vertical_shift[..., None]
