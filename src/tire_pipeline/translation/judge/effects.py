"""Weights of a fitted mixed model as differences between organisations or protocols, with their intervals."""

from __future__ import annotations

import numpy as np
import pandas as pd

from tire_pipeline.translation.curves.space import PARTS, UNIT
from tire_pipeline.translation.population.model import CurveMixedModel, columns_of

EFFECT_QUANTILE = 1.6449 * 1.2
"""Standard deviations to either side of a bias: those that hold 90% of a Gaussian, and 20% more, since the
model takes its variances for known, and the noise from files of which some are fits of one recording (found
on tuning fleets)."""

KEY_PARTS = ("cornering stiffness", "lateral friction", "slip stiffness", "longitudinal friction")


def difference(model: CurveMixedModel, contrast: np.ndarray, place: slice) -> tuple[np.ndarray, np.ndarray]:
    """Mean and variance, for each score, of a weighted sum of weights."""
    weights = [fitted.mean[place] @ contrast for fitted in model.fitted]
    variances = [contrast @ fitted.covariance[place, place] @ contrast for fitted in model.fitted]
    return np.array(weights) * model.scale, np.array(variances) * model.scale**2


def mean_of_loads(
    model: CurveMixedModel, part: str, mean: np.ndarray, variance: np.ndarray
) -> tuple[float, float]:
    """Mean of a part's features over the loads, and half of its interval, from scores and their variances."""
    place = model.space.slices[part]
    along = model.space.back[part].mean(axis=1) * UNIT[PARTS[part].group]
    return float(mean[place] @ along), EFFECT_QUANTILE * float(np.sqrt(variance[place] @ along**2))


def protocol_changes(model: CurveMixedModel) -> pd.DataFrame:
    """Say which categories changed how they measure, when, how surely, and what it changed.

    Returns
    -------
    DataFrame
        One row a change: ``category``, ``day`` (first of the new protocol), ``earliest``, ``latest`` (90%),
        ``probability``, ``tires_before``, ``tires_after``, and for cornering and slip stiffness, lateral and
        longitudinal friction the change in the mean of the loads, in words with its 90% interval.
    """
    rows = []
    place = columns_of(model, "protocol")
    for k, change in enumerate(model.protocols.changes):
        row: dict[str, object] = {
            "category": change.category,
            "day": change.day,
            "earliest": change.earliest,
            "latest": change.latest,
            "probability": change.probability,
            "tires_before": change.before,
            "tires_after": change.after,
        }
        mean, variance = difference(model, np.eye(len(model.protocols.changes))[k], place)
        for part in KEY_PARTS:
            step, half = mean_of_loads(model, part, mean, variance)
            low, middle, high = (100.0 * np.expm1(value) for value in (step - half, step, step + half))
            row[part] = f"{middle:+.1f} % ({low:+.1f} to {high:+.1f})"
        rows.append(row)
    return pd.DataFrame(rows)
