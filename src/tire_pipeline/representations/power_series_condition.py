"""How ill-conditioned the power series is: measured condition numbers of both forms."""

from __future__ import annotations

import numpy as np
import pandas as pd

from tire_pipeline.representations.base import CURVE_LOADS
from tire_pipeline.representations.lateral_curve import lateral_factors
from tire_pipeline.representations.power_series import derivatives

_PART_OF_SPREAD = 1e-6


def condition_numbers(table: pd.DataFrame) -> pd.DataFrame:
    """Measure how much decoding a power series magnifies a change of its features.

    The Jacobian of (k1, k2, k3), or (k1, r2, r3), with respect to (B, C, E) is taken at every tire
    and load. Columns are in units of the spread (standard deviation over the table) of B, C, E and
    rows in that of the features, so a gain of 100 means: features off by 1% of their spread, as by a
    bin of 50, give B, C, E off by once their own spread.

    Parameters
    ----------
    table : DataFrame
        Tire table.

    Returns
    -------
    DataFrame
        One row a form and load: ``form``, ``normal_load`` (N), ``condition_median``,
        ``condition_p95`` (ratio of the greatest to the least singular value), ``gain_median`` and
        ``gain_p95`` (one over the least singular value).
    """
    factors = lateral_factors(table, CURVE_LOADS)
    inputs = np.stack([factors.stiffness, factors.shape, np.minimum(factors.curvature, 1.0)], axis=-1)
    rows = []
    for form in ("published", "stable"):
        for index, load in enumerate(CURVE_LOADS):
            singular = _singular_values(inputs[:, index], form)
            condition = singular[:, 0] / singular[:, -1]
            gain = 1 / singular[:, -1]
            rows.append(
                {
                    "form": form,
                    "normal_load": load,
                    "condition_median": np.median(condition),
                    "condition_p95": np.percentile(condition, 95),
                    "gain_median": np.median(gain),
                    "gain_p95": np.percentile(gain, 95),
                }
            )
    return pd.DataFrame(rows)


def _features(inputs: np.ndarray, form: str) -> np.ndarray:
    k1, k2, k3 = derivatives(inputs[:, 0], inputs[:, 1], inputs[:, 2])
    if form == "stable":
        k2, k3 = k2 / k1**3, k3 / k1**5
    return np.stack([k1, k2, k3], axis=-1)


def _singular_values(inputs: np.ndarray, form: str) -> np.ndarray:
    """Singular values, greatest first, of the scaled Jacobian of every tire, shape (n, 3)."""
    input_spread = np.maximum(inputs.std(axis=0), 1e-12)
    feature_spread = np.maximum(_features(inputs, form).std(axis=0), 1e-12)
    columns = []
    for index in range(3):
        step = np.zeros(3)
        step[index] = _PART_OF_SPREAD * input_spread[index]
        change = _features(inputs + step, form) - _features(inputs - step, form)
        columns.append(change / (2 * _PART_OF_SPREAD) / feature_spread)
    singular = np.linalg.svd(np.stack(columns, axis=-1), compute_uv=False)
    return np.maximum(singular, 1e-300)
