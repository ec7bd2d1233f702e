"""Learning from the very files that are translated, a tire's own files left out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
import pandas as pd

from tire_pipeline.translation.population.fit import PreparedTraining
from tire_pipeline.translation.population.model import CurveMixedModel, Prediction
from tire_pipeline.translation.population.update import TaughtCells, learn_from
from tire_pipeline.translation.predict.mixed import MixedPredictor

BATCH_FOLDS = 5
"""Parts into which the tires of a batch are laid; a part is translated by what the others taught."""

TEACHING_PROBABILITY = 0.95
"""Files whose category was guessed teach nothing if it is less probable than this."""


@dataclass(frozen=True)
class BatchLearning:
    """What it takes to learn on from further files.

    Attributes
    ----------
    training : TaughtCells
        Of the training files.
    repeats : ndarray, shape (n, p)
        Training files less their cell's location, scores in their standard deviations.
    known : ndarray of str
        Tires of the training files.
    """

    training: TaughtCells
    repeats: np.ndarray
    known: np.ndarray

    @classmethod
    def of(cls, made: PreparedTraining, training: pd.DataFrame) -> Self:
        """Keep what learning on needs of the training files."""
        return cls(
            TaughtCells.of_training(made),
            made.cells.repeats / made.scale,
            np.unique(training["tire_id"].to_numpy(dtype=str)),
        )

    def predict(
        self,
        model: CurveMixedModel,
        source: pd.DataFrame,
        target: str,
        *,
        before: Prediction,
        near: np.ndarray,
        predictor: MixedPredictor,
    ) -> Prediction:
        """Predict the target's scores of every source file, by what the other tires of ``source`` taught.

        Parameters
        ----------
        model : CurveMixedModel
        source : DataFrame
            n files of known categories, with ``tire_id``.
        target : str
        before : Prediction
            Without learning; stands where no other tire teaches.
        near : ndarray of bool, shape (n,)
            Files near enough to the training data to teach.
        predictor : MixedPredictor
            Predicts by the model that has learned on.
        """
        teaches = near & self._sure_and_new(source)
        names = source["tire_id"].to_numpy(dtype=str)
        fold = np.unique(names, return_inverse=True)[1] % BATCH_FOLDS
        found = {name: getattr(before, name).copy() for name in vars(before)}
        for k in np.unique(fold):
            asked, taught = np.flatnonzero(fold == k), np.flatnonzero((fold != k) & teaches)
            if not taught.size:
                continue
            cells = TaughtCells.of_files(model, source.iloc[taught])
            learned = learn_from(model, cells, self.training, self.repeats)
            one = predictor.predict(learned, source.iloc[asked], target)
            one = replace(one, taught=np.full(asked.size, float(taught.size)))
            for name, values in found.items():
                values[asked] = getattr(one, name)
        return Prediction(**found)

    def _sure_and_new(self, source: pd.DataFrame) -> np.ndarray:
        """Tell whose category is sure, and whose tire is no training tire's, (n,)."""
        sure = np.ones(len(source), dtype=bool)
        if "category_probability" in source:
            sure = source["category_probability"].to_numpy(dtype=float) >= TEACHING_PROBABILITY
        new = ~np.isin(source["tire_id"].to_numpy(dtype=str), self.known)
        return np.asarray(sure & new)

    def to_state(self) -> dict[str, Any]:
        """Give arrays that bring it back."""
        return {
            **self.training.to_state(),
            "taught_repeats": self.repeats,
            "taught_known": self.known,
        }

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Bring back what :meth:`to_state` gave."""
        return cls(
            TaughtCells.from_state(state),
            np.asarray(state["taught_repeats"]),
            np.asarray(state["taught_known"], dtype=str),
        )
