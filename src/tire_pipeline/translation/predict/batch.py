"""Learning from the very files that are translated, a tire's own files left out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
import pandas as pd

from tire_pipeline.translation.population.fit_model import PreparedTraining
from tire_pipeline.translation.population.model import CurveMixedModel, Prediction
from tire_pipeline.translation.population.update import TaughtCells, learn_from
from tire_pipeline.translation.predict.base import Predictor

BATCH_FOLDS = 5
"""Parts into which the tires of a batch are laid; a part is translated by what the others taught."""

TEACHING_PROBABILITY = 0.95
"""Files whose category was guessed teach nothing if it is less probable than this."""


@dataclass(frozen=True)
class Taught:
    """What the files of a batch have taught.

    Attributes
    ----------
    tires : ndarray of str
        Of the batch, sorted; their places say which part a tire is in.
    models : tuple of CurveMixedModel or None
        By part: what all other parts have taught; None if they hold nothing that teaches.
    counts : tuple of int
        By how many files.
    """

    tires: np.ndarray
    models: tuple[CurveMixedModel | None, ...]
    counts: tuple[int, ...]

    def predict(
        self, source: pd.DataFrame, target: str, *, before: Prediction, predictor: Predictor
    ) -> Prediction:
        """Predict the target's scores of source files, by what the other tires of the batch taught.

        Parameters
        ----------
        source : DataFrame
            n files of the batch, of known categories, with ``tire_id``.
        target : str
        before : Prediction
            Without learning; stands where no other tire teaches.
        predictor : Predictor
            Predicts by the model that has learned on.
        """
        fold = _fold(self.tires, source)
        found = {name: getattr(before, name).copy() for name in vars(before)}
        for k in np.unique(fold):
            learned, asked = self.models[k], np.flatnonzero(fold == k)
            if learned is None:
                continue
            one = predictor.predict(learned, source.iloc[asked], target)
            one = replace(one, taught=np.full(asked.size, float(self.counts[k])))
            for name, values in found.items():
                values[asked] = getattr(one, name)
        return Prediction(**found)


def _fold(tires: np.ndarray, source: pd.DataFrame) -> np.ndarray:
    """The part of each file, (n,), by the place of its tire among those of the batch."""
    names = source["tire_id"].to_numpy(dtype=str)
    return np.asarray(np.searchsorted(tires, names) % BATCH_FOLDS)


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

    def learn(self, model: CurveMixedModel, tires: np.ndarray, teachers: pd.DataFrame) -> Taught:
        """Learn from a batch.

        Parameters
        ----------
        model : CurveMixedModel
        tires : ndarray of str
            Tires of all files of the batch that can be translated.
        teachers : DataFrame
            Those of the files that may teach: :meth:`sure_and_new`, and near the training data.
        """
        names = np.unique(tires)
        fold = _fold(names, teachers)
        models, counts = list[CurveMixedModel | None](), list[int]()
        for k in range(BATCH_FOLDS):
            taught = np.flatnonzero(fold != k)
            counts.append(taught.size)
            if not taught.size or k >= names.size:
                models.append(None)
                continue
            cells = TaughtCells.of_files(model, teachers.iloc[taught])
            models.append(learn_from(model, cells, self.training, self.repeats))
        return Taught(names, tuple(models), tuple(counts))

    def sure_and_new(self, source: pd.DataFrame) -> np.ndarray:
        """Find the files that may teach by what is known of them.

        Parameters
        ----------
        source : DataFrame
            n files.

        Returns
        -------
        ndarray of bool, shape (n,)
            True where the category is sure and the tire is not among those of the training files.
        """
        sure = np.ones(len(source), dtype=bool)
        if "category_probability" in source:
            sure = source["category_probability"].to_numpy(dtype=float) >= TEACHING_PROBABILITY
        new = ~np.isin(source["tire_id"].to_numpy(dtype=str), self.known)
        return np.asarray(sure & new)

    def to_state(self) -> dict[str, Any]:
        """Return the arrays that restore it."""
        return {
            **self.training.to_state(),
            "taught_repeats": self.repeats,
            "taught_known": self.known,
        }

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        return cls(
            TaughtCells.from_state(state),
            np.asarray(state["taught_repeats"]),
            np.asarray(state["taught_known"], dtype=str),
        )
