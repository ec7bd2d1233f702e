"""Greedy maximum of a classifier's probability, as a baseline: this goal misleads."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Self

import numpy as np
import pandas as pd

from tire_pipeline.classifiers.base import Classifier, classifier_from_state, make_classifier
from tire_pipeline.errors import DomainError
from tire_pipeline.representations.coefficients import LATERAL_WITHOUT_CAMBER
from tire_pipeline.translation.base import check_target
from tire_pipeline.translation.result import TranslationResult, without_estimate

BINS = 20
MOST_STEPS = 60


class GreedyForest:
    """Moves one of the 11 lateral coefficients by one bin at a time, wherever the forest's probability grows
    most.

    Stops where no move raises the probability of the target category.
    """

    name: ClassVar[str] = "greedy_forest"

    def fit(self, training: pd.DataFrame, *, target: str, seed: int = 0) -> Self:
        """Train the thesis' forest (30 trees of depth 10, SMOTE) on the 11 coefficients.

        Raises
        ------
        DomainError
            If the table has no tire of the target, or none of any other category.
        """
        check_target(training, target)
        features = training[list(LATERAL_WITHOUT_CAMBER)].to_numpy(float)
        labels = training["category"].to_numpy(dtype=str)
        self.target = target
        self.low, self.high = features.min(axis=0), features.max(axis=0)
        self.forest: Classifier = make_classifier("random_forest").fit(features, labels, seed=seed)
        return self

    def probability(self, features: np.ndarray) -> np.ndarray:
        """Return the target's probability for coefficients (n, 11)."""
        column = int(np.flatnonzero(self.forest.classes_ == self.target)[0])
        return self.forest.predict_proba(np.ascontiguousarray(features))[:, column]

    def translate(self, source: pd.DataFrame) -> pd.DataFrame:
        """Climb.

        Raises
        ------
        DomainError
            If a lateral coefficient has no value.
        """
        values = source[list(LATERAL_WITHOUT_CAMBER)].to_numpy(float, copy=True)
        if not np.isfinite(values).all():
            raise DomainError("a lateral coefficient has no value", todo="drop files without a value first")
        step = (self.high - self.low) / BINS
        moves = np.concatenate([np.diag(step), -np.diag(step)])
        best, live = self.probability(values), np.arange(len(values))
        for _ in range(MOST_STEPS):
            tried = np.clip(values[live, None, :] + moves[None], self.low, self.high)
            chance = self.probability(tried.reshape(-1, step.size)).reshape(len(live), -1)
            choice = chance.argmax(axis=1)
            gained = chance.max(axis=1) > best[live] + 1e-9
            rows = live[gained]
            values[rows] = tried[gained, choice[gained]]
            best[rows] = chance.max(axis=1)[gained]
            live = rows
            if live.size == 0:
                break
        translated = source.copy()
        translated[list(LATERAL_WITHOUT_CAMBER)] = values
        return translated

    def translation(
        self, source: pd.DataFrame, *, bands: bool = True, farthest: float | None = None
    ) -> TranslationResult:
        """Translate; without bands or estimates of the error."""
        return without_estimate(source, self.translate(source), self.target, self.name)

    def to_state(self) -> dict[str, Any]:
        """Return the arrays, strings and numbers that restore it."""
        state = {f"forest_{name}": value for name, value in self.forest.to_state().items()}
        return {"translator": self.name, "target": self.target, "low": self.low, "high": self.high, **state}

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        found = cls()
        found.target = str(state["target"])
        found.low, found.high = np.asarray(state["low"]), np.asarray(state["high"])
        forest = {name[7:]: value for name, value in state.items() if name.startswith("forest_")}
        found.forest = classifier_from_state(forest)
        return found
