"""How far a file is from the training data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
import pandas as pd
from scipy.spatial import cKDTree

from tire_pipeline.tire_table.one_nominal_load import OWN_LOAD
from tire_pipeline.translation.curves.features import LOADS
from tire_pipeline.translation.population.model import CurveMixedModel, Prediction

_SHARE_INSIDE = 0.995  # share of the training data inside the edge


@dataclass(frozen=True)
class TrainingReach:
    """What the training data covers.

    Attributes
    ----------
    metadata : ndarray, shape (m, d)
        Standardised metadata of the target's training tires.
    gap : float
        Distance to the nearest other tire that all but 0.5% of these keep.
    surprise : float
        Root mean square surprise of curves that all but 0.5% of the training files keep.
    """

    metadata: np.ndarray
    gap: float
    surprise: float

    @classmethod
    def fit(cls, model: CurveMixedModel, training: pd.DataFrame, target: str) -> Self:
        """Learn from the training table."""
        own = training.loc[training["category"].astype(str) == target]
        points = np.unique(model.metadata.regressors(own), axis=0)
        gap = 1.0
        if points.shape[1] and len(points) > 2:
            nearest = cKDTree(points).query(points, k=2)[0][:, 1]
            gap = float(max(np.quantile(nearest, _SHARE_INSIDE), 1e-3))
        found = model.predict(training, target)
        return cls(points, gap, float(np.quantile(_size(model, found), _SHARE_INSIDE)))

    def distance(self, model: CurveMixedModel, table: pd.DataFrame, found: Prediction) -> np.ndarray:
        """Return how far files are from the training data.

        Parameters
        ----------
        model : CurveMixedModel
        table : DataFrame
            n files.
        found : Prediction
            Of these files.

        Returns
        -------
        ndarray, shape (n,)
            1 at the edge. The largest of three: how far the metadata is from the target's nearest tire, how
            unlike the curves are to what is expected of such a tire in its category, and, for a tire that
            carries other loads than those at which forces are judged, by which factor it does.
        """
        curves = _size(model, found) / self.surprise
        if OWN_LOAD in table:
            beyond = beyond_judged_loads(table[OWN_LOAD].to_numpy(dtype=float))
            curves = np.maximum(curves, np.where(beyond > 1.0, beyond, 0.0))
        if not self.metadata.shape[1]:
            return curves
        nearest = cKDTree(self.metadata).query(model.metadata.regressors(table))[0] / self.gap
        return np.maximum(curves, nearest)

    def to_state(self) -> dict[str, Any]:
        """Return the arrays and numbers that restore it."""
        return {"reach_metadata": self.metadata, "reach_gap": self.gap, "reach_surprise": self.surprise}

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        return cls(
            np.asarray(state["reach_metadata"]), float(state["reach_gap"]), float(state["reach_surprise"])
        )


def beyond_judged_loads(load: np.ndarray) -> np.ndarray:
    """Return by which factor loads (N) are outside of those at which forces are judged; up to 1 inside."""
    return np.maximum(load / LOADS.max(), LOADS.min() / load)


def _size(model: CurveMixedModel, found: Prediction) -> np.ndarray:
    """Root mean square surprise of the forces; a torque that was fitted badly is no other tire."""
    kept = np.ones(found.surprise.shape[1], dtype=bool)
    kept[model.space.slices["aligning torque"]] = False
    squares = found.surprise[:, kept] ** 2
    # summed from left to right: a sum takes another order where there is only one file
    return np.asarray(np.sqrt(np.cumsum(squares, axis=1)[:, -1] / squares.shape[1]))
