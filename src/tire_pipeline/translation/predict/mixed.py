"""Prediction by the mixed model itself, with its doubtful moves shortened."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import pandas as pd

from tire_pipeline.translation.population.model import CurveMixedModel, Prediction
from tire_pipeline.translation.predict.shrinkage import shortened, without_failed_fits


@dataclass(frozen=True)
class MixedPredictor:
    """The posterior mean of the target's scores, shrunk towards no change.

    Attributes
    ----------
    trust : float
        How far the tire effect of a source file is shrunk towards the expectation for such a tire; 0: not
        at all.
    """

    trust: float = 1.0

    def fit(self, model: CurveMixedModel, training: pd.DataFrame, target: str, seed: int) -> Self:
        """Return itself: nothing is to be learned beyond the model."""
        return self

    def predict(self, model: CurveMixedModel, source: pd.DataFrame, target: str) -> Prediction:
        """Predict what the target would measure of n source files."""
        found = shortened(model, model.predict(source, target, trust=self.trust))
        return without_failed_fits(model, found)

    def to_state(self) -> dict[str, Any]:
        """Return the option."""
        return {"option_trust": self.trust}

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        return cls(float(state["option_trust"]))
