"""Translators that learn from the very files they translate, a tire's own files left out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, ClassVar, Self

import numpy as np
import pandas as pd

from tire_pipeline.translation.judge.shrinkage import cautious, without_failed_fits
from tire_pipeline.translation.population.fit import Prepared, prepare
from tire_pipeline.translation.population.model import Prediction
from tire_pipeline.translation.population.update import TaughtCells, learn_from
from tire_pipeline.translation.translator import MixedModel

FOLDS = 5
"""Parts into which the tires of a batch are laid; a part is translated by what the others taught."""

TEACHING_PROBABILITY = 0.95
"""Files whose category was guessed teach nothing if it is less probable than this."""


class BatchMixedModel(MixedModel):
    """The mixed model, which learns from the files to translate what they say of whoever measured them.

    A file is translated by what files of *other* tires taught. No file of its own tire counts, and no
    measurement of the target beyond the training files. So a file alone comes out as by ``mixed_model``.
    Files of tires that nobody has seen before are needed for it; of whom they are must be known.

    Parameters
    ----------
    pairs, trust, gate, farthest
        As in :class:`.translator.MixedModel`. With pairs, tires of the batch that several categories
        measured (same ``tire_id``) link these, too.

    Notes
    -----
    A translation depends on the batch. Where every file must come out alike whatever is translated with it,
    take ``mixed_model`` or ``paired_mixed_model``.
    """

    name: ClassVar[str] = "batch_mixed_model"

    def fit(
        self, training: pd.DataFrame, *, target: str, seed: int = 0, made: Prepared | None = None
    ) -> Self:
        """Learn as :class:`.translator.MixedModel` does, and keep what it takes to learn on."""
        training = training.reset_index(drop=True)
        made = made or prepare(training, pairs=self.pairs)
        super().fit(training, target=target, seed=seed, made=made)
        self.training = TaughtCells.of_training(made)
        self.repeats = made.cells.repeats / made.scale
        self.known = np.unique(training["tire_id"].to_numpy(dtype=str))
        return self

    def predict(self, source: pd.DataFrame) -> Prediction:
        """Predict the target's scores of every source file, by what the other tires of ``source`` taught."""
        before = super().predict(source)
        teaches = self._teaches(source, before)
        names = source["tire_id"].to_numpy(dtype=str)
        fold = np.unique(names, return_inverse=True)[1] % FOLDS
        found = {name: getattr(before, name).copy() for name in vars(before)}
        for k in np.unique(fold):
            asked, taught = np.flatnonzero(fold == k), np.flatnonzero((fold != k) & teaches)
            if not taught.size:
                continue
            cells = TaughtCells.of_files(self.model, source.iloc[taught])
            model = learn_from(self.model, cells, self.training, self.repeats)
            rows = source.iloc[asked]
            one = cautious(model, model.predict(rows, self.target, trust=self.trust))
            one = replace(without_failed_fits(model, one), taught=np.full(asked.size, float(taught.size)))
            for name, values in found.items():
                values[asked] = getattr(one, name)
        return Prediction(**found)

    def _teaches(self, source: pd.DataFrame, found: Prediction) -> np.ndarray:
        """Tell who is not refused, whose category is sure, and whose tire is no training tire's, (n,)."""
        near = self.reach.distance(self.model, source, found) <= self.farthest
        sure = np.ones(len(source), dtype=bool)
        if "category_probability" in source:
            sure = source["category_probability"].to_numpy(dtype=float) >= TEACHING_PROBABILITY
        new = ~np.isin(source["tire_id"].to_numpy(dtype=str), self.known)
        return np.asarray(near & sure & new)

    def to_state(self) -> dict[str, Any]:
        """Give arrays, strings and numbers that bring the fitted translator back."""
        return {
            **super().to_state(),
            **self.training.to_state(),
            "taught_repeats": self.repeats,
            "taught_known": self.known,
        }

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Bring back what :meth:`to_state` gave; it translates the same."""
        translator = super().from_state(state)
        translator.training = TaughtCells.from_state(state)
        translator.repeats = np.asarray(state["taught_repeats"])
        translator.known = np.asarray(state["taught_known"], dtype=str)
        return translator


class PairedBatchMixedModel(BatchMixedModel):
    """The same, with the tires that several categories measured, in the training files and in the batch."""

    name: ClassVar[str] = "paired_batch_mixed_model"
    uses_pairs: ClassVar[bool] = True
