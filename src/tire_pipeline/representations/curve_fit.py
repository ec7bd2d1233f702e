"""Fit the 11 lateral coefficients of many tires at once to decoded force curves."""

from __future__ import annotations

import numpy as np
import pandas as pd

from tire_pipeline.representations.coefficients import LATERAL_WITHOUT_CAMBER
from tire_pipeline.representations.lateral_curve import lateral_factors, lateral_force

_CHUNK = 256
_MAX_DAMPING = 1e8


def fit_lateral(
    curves: np.ndarray,
    source: pd.DataFrame,
    loads: np.ndarray,
    slip_angles: np.ndarray,
    *,
    steps: int = 40,
) -> pd.DataFrame:
    """Give the source tires with the lateral coefficients that come closest to the curves.

    Levenberg-Marquardt on all tires side by side, started from the source's coefficients; a step
    is taken for the tires that it helps only, so no tire ends further away than it began.

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
    for start in range(0, len(rows), _CHUNK):
        chunk = rows[start : start + _CHUNK]
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

    def residuals(values: np.ndarray) -> np.ndarray:
        tires = columns | dict(zip(names, values.T, strict=True))
        force = lateral_force(lateral_factors(tires, loads), slip_angles)
        return (force.reshape(wanted.shape) - wanted) / scale

    values = source.loc[:, names].to_numpy(dtype=float, copy=True)
    spans = np.maximum(np.abs(values), 0.01)
    current = residuals(values)
    cost = (current**2).sum(axis=1)
    damping = np.full(len(values), 1e-3)
    for _ in range(steps):
        jacobian = _jacobian(residuals, values, spans, current)
        normal = np.einsum("nri,nrj->nij", jacobian, jacobian)
        gradient = np.einsum("nri,nr->ni", jacobian, current)
        weight = np.einsum("nii->ni", normal) + 1e-9
        normal += (damping[:, None] * weight)[:, :, None] * np.eye(len(names))
        move = -np.linalg.solve(normal, gradient[..., None])[..., 0] * spans
        with np.errstate(all="ignore"):
            tried = residuals(values + move)
            tried_cost = (tried**2).sum(axis=1)
        better = tried_cost < cost
        gain = np.where(better, (cost - tried_cost) / np.maximum(cost, 1e-300), 0.0)
        values = np.where(better[:, None], values + move, values)
        current = np.where(better[:, None], tried, current)
        cost = np.where(better, tried_cost, cost)
        damping = np.where(better, damping / 5, damping * 5).clip(1e-12, _MAX_DAMPING)
        if np.all((better & (gain < 1e-9)) | (damping >= _MAX_DAMPING) | (cost < 1e-20)):
            break
    return values


def _jacobian(residuals, values, spans, current):  # type: ignore[no-untyped-def]
    """Forward differences in units of ``spans``, shape (n, residuals, coefficients)."""
    columns = []
    for index in range(values.shape[1]):
        moved = values.copy()
        step = 1e-6
        moved[:, index] += step * spans[:, index]
        columns.append((residuals(moved) - current) / step)
    return np.stack(columns, axis=-1)
