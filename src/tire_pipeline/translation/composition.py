"""What a fitted translator is composed of, and how its parts predict together."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import pandas as pd

from tire_pipeline.translation.curves.load_scale import LoadScale
from tire_pipeline.translation.decode.scores_to_coefficients import Decoder
from tire_pipeline.translation.judge.verdict import VerdictRules
from tire_pipeline.translation.population.model import CurveMixedModel, Prediction
from tire_pipeline.translation.predict.base import Predictor
from tire_pipeline.translation.predict.batch import BatchLearning, Taught


@dataclass(frozen=True)
class Parts:
    """What a fitted translator is composed of.

    Attributes
    ----------
    model : CurveMixedModel
        The population: what each category would measure of which tire.
    predictor : Predictor
        Scores of the target's file.
    batch : BatchLearning or None
        Learns from the files to translate, if it is asked for.
    taught : Taught or None
        What a batch has taught already; None: the files that are predicted are the batch.
    decoder : Decoder
        Coefficients from scores.
    loads : LoadScale
        By how much the loads at which tires are compared are larger than those of car tires. All other parts
        take and give tires that are scaled by it.
    verdict : VerdictRules
        Which files are translated.
    """

    model: CurveMixedModel
    predictor: Predictor
    batch: BatchLearning | None
    decoder: Decoder
    verdict: VerdictRules
    taught: Taught | None = None
    loads: LoadScale = field(default_factory=LoadScale)

    def predict(self, source: pd.DataFrame) -> Prediction:
        """Predict the target's scores of every source file."""
        found = self.predictor.predict(self.model, source, self.verdict.target)
        if self.batch is None:
            return found
        taught = self.taught
        if taught is None:
            teachers = self._teachers(self.batch, source, found)
            taught = self.batch.learn(self.model, source["tire_id"].to_numpy(dtype=str), teachers)
        return taught.predict(source, self.verdict.target, before=found, predictor=self.predictor)

    def teachers(self, source: pd.DataFrame) -> pd.DataFrame:
        """The source files that may teach, none if nothing is learned from a batch."""
        if self.batch is None:
            return source.iloc[:0]
        found = self.predictor.predict(self.model, source, self.verdict.target)
        return self._teachers(self.batch, source, found)

    def _teachers(self, batch: BatchLearning, source: pd.DataFrame, found: Prediction) -> pd.DataFrame:
        teach = self.verdict.near(self.model, source, found) & batch.sure_and_new(source)
        return source.iloc[np.flatnonzero(teach)]
