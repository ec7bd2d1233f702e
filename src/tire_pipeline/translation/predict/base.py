"""What every predictor offers: one way to say what the target would measure of a file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol, Self

import pandas as pd

from tire_pipeline.translation.population.model import CurveMixedModel, Prediction


class Predictor(Protocol):
    """Predicts scores by a fitted model of the population; a value that is never changed."""

    def fit(self, model: CurveMixedModel, training: pd.DataFrame, target: str, seed: int) -> Self:
        """Return the predictor with what it learns beyond the model.

        Parameters
        ----------
        model : CurveMixedModel
            Fitted to ``training``.
        training : DataFrame
            Tire table with ``category``.
        target : str
        seed : int
            Of whatever is drawn.
        """
        ...

    def predict(self, model: CurveMixedModel, source: pd.DataFrame, target: str) -> Prediction:
        """Predict what the target would measure of n source files, of known categories."""
        ...

    def to_state(self) -> dict[str, Any]:
        """Return the arrays, strings and numbers that restore it."""
        ...

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        ...
