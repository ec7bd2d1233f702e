"""Translators whose scores are moved by what was trained instead of by the mixed model."""

from __future__ import annotations

from typing import ClassVar

from tire_pipeline.translation.judge.verdict import FARTHEST_DISTANCE
from tire_pipeline.translation.predict.base import Predictor
from tire_pipeline.translation.predict.cycle import ROUNDS, CyclePredictor
from tire_pipeline.translation.predict.policy import UPDATES, PolicyPredictor
from tire_pipeline.translation.translator import CurveOptions, CurveTranslator


class LikelihoodAgent(CurveTranslator):
    """Translates by a policy that is rewarded by likelihood (:class:`.predict.policy.PolicyPredictor`).

    Parameters
    ----------
    updates : int
        Roll-outs of 64 tires and 48 steps that it learns from.
    gate, pairs, farthest
        As in :class:`.translator.MixedModel`; the agent by itself never refuses.
    """

    name: ClassVar[str] = "likelihood_agent"
    predictors: ClassVar[type[Predictor]] = PolicyPredictor
    curious: ClassVar[bool] = False

    def __init__(
        self,
        *,
        updates: int = UPDATES,
        gate: bool = False,
        pairs: bool = False,
        farthest: float = FARTHEST_DISTANCE,
    ) -> None:
        options = CurveOptions(pairs, gate=gate, farthest=farthest)
        super().__init__(PolicyPredictor(int(updates), self.curious), options)


class CuriousAgent(LikelihoodAgent):
    """The same with random network distillation: a bonus for states that it has seldom seen."""

    name: ClassVar[str] = "curious_agent"
    curious: ClassVar[bool] = True


class CycleConsistent(CurveTranslator):
    """Translates by adversarial networks (:class:`.predict.cycle.CyclePredictor`).

    Parameters
    ----------
    rounds : int
        Training rounds.
    gate, pairs
        As in :class:`.translator.MixedModel`.
    """

    name: ClassVar[str] = "cycle_consistent"
    predictors: ClassVar[type[Predictor]] = CyclePredictor

    def __init__(self, *, rounds: int = ROUNDS, gate: bool = False, pairs: bool = False) -> None:
        super().__init__(CyclePredictor(int(rounds)), CurveOptions(pairs, gate=gate))
