"""Fit the 11 lateral coefficients of many tires at once to decoded force curves."""

from __future__ import annotations

import numpy as np
import pandas as pd

from tire_pipeline.numerics.levenberg_marquardt import LeastSquares, Steps, solve
from tire_pipeline.representations.coefficients import LATERAL_WITHOUT_CAMBER
from tire_pipeline.representations.lateral_curve import lateral_factors, lateral_force

_ROWS_TOGETHER = 256
_MAX_DAMPING = 1e8
_JACOBIAN_STEP = 1e-6  # of a coefficient's size, for derivatives


def fit_lateral(
    curves: np.ndarray,
    source: pd.DataFrame,
    loads: np.ndarray,
    slip_angles: np.ndarray,
    *,
    steps: int = 40,
) -> pd.DataFrame:
    """Return the source tires with the lateral coefficients that come closest to the curves.

    Started from the source's coefficients (:mod:`.numerics.levenberg_marquardt`); a step is taken for the
    tires that it helps only, so no tire ends further away than it began.

    Parameters
    ----------
    curves : ndarray, shape (n, L, S)
        Lateral force, N. A tire whose curves are not finite keeps its coefficients.
    source : DataFrame
        n tires.
    loads : ndarray, shape (L,)
        Normal loads, N.
    slip_angles : ndarray, shape (S,)
        rad.
    steps : int
        Most iterations.

    Returns
    -------
    DataFrame
        A copy of ``source`` with the 11 coefficients of ``LATERAL_WITHOUT_CAMBER`` fitted.
    """
    fitted = source.copy()
    names = list(LATERAL_WITHOUT_CAMBER)
    values = source.loc[:, names].to_numpy(dtype=float, copy=True)
    finite = np.isfinite(curves).all(axis=(1, 2))
    rows = np.flatnonzero(finite)
    for start in range(0, len(rows), _ROWS_TOGETHER):
        chunk = rows[start : start + _ROWS_TOGETHER]
        values[chunk] = _fit_chunk(curves[chunk], source.iloc[chunk], loads, slip_angles, steps)
    fitted[names] = values
    return fitted


def _fit_chunk(
    curves: np.ndarray,
    source: pd.DataFrame,
    loads: np.ndarray,
    slip_angles: np.ndarray,
    steps: int,
) -> np.ndarray:
    names = list(LATERAL_WITHOUT_CAMBER)
    columns = {
        str(name): source[name].to_numpy(dtype=float)
        for name in source.columns
        if pd.api.types.is_numeric_dtype(source[name])
    }
    scale = np.abs(curves).max(axis=(1, 2))[:, None] + 1.0
    wanted = curves.reshape(len(curves), -1)

    source_values = source.loc[:, names].to_numpy(dtype=float, copy=True)
    spans = np.maximum(np.abs(source_values), 0.01)

    def residuals(moves: np.ndarray, rows: np.ndarray) -> np.ndarray:
        values = source_values[rows] + moves * spans[rows]
        tires = {name: column[rows] for name, column in columns.items()}
        tires |= dict(zip(names, values.T, strict=True))
        with np.errstate(all="ignore"):
            force = lateral_force(lateral_factors(tires, loads), slip_angles)
        found: np.ndarray = (force.reshape(len(rows), -1) - wanted[rows]) / scale[rows]
        return found

    def model(moves: np.ndarray, rows: np.ndarray, slopes: bool) -> tuple[np.ndarray, np.ndarray | None]:
        here = residuals(moves, rows)
        if not slopes:
            return here, None
        found = np.empty((len(rows), len(names), here.shape[1]))
        for index in range(len(names)):
            moved = moves.copy()
            moved[:, index] += _JACOBIAN_STEP
            found[:, index] = (residuals(moved, rows) - here) / _JACOBIAN_STEP
        return here, found

    zero = np.zeros_like(source_values)
    problem = LeastSquares(model, zero, zero - np.inf, zero + np.inf, zero, zero)
    rule = Steps(most=steps, tolerance=1e-9, damping=1e-3, easier=5.0, largest=_MAX_DAMPING)
    moves, _ = solve(problem, rule)
    return np.asarray(source_values + moves * spans)
