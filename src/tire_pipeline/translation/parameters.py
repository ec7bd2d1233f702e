"""Parameters of ``translate`` and ``train_agent``."""

from __future__ import annotations

from typing import Any, Literal, Self

from pydantic import Field, field_validator, model_validator

from tire_pipeline.parameters import Parameters, Several
from tire_pipeline.translation.base import RENAMED
from tire_pipeline.translation.judge.verdict import FARTHEST_DISTANCE
from tire_pipeline.translation.result import EDGE


class TranslateParameters(Parameters):
    """Parameters of ``translate``.

    Attributes
    ----------
    translator : str
        Which of those that give bands and verdicts.
    pairs : bool
        Whether to use tires measured by more than one organisation; the agent never does.
    learn_from_batch : bool
        Whether the mixed model learns from the files to translate as well; the agent cannot.
    classify : bool
        Classify files whose folder is no known category. Otherwise, and where the classification is not
        sure, their supplier is unknown, and they are not translated.
    farthest : float
        Files farther from the training data are refused. 1 is the edge of the training data; more than 3 is
        not allowed.
    only : list of str
        Suppliers, files or patterns such as ``B/*_2019*.tir``; empty is all files. On the command line
        several are separated by ``;``.
    trials : int
        Most files that are translated; 0 is all.
    """

    translator: Literal["mixed_model", "likelihood_agent"] = "mixed_model"
    pairs: bool = True
    learn_from_batch: bool = False
    classify: bool = False
    farthest: float = Field(EDGE, gt=0, le=FARTHEST_DISTANCE)
    only: Several = []
    trials: int = Field(0, ge=0)

    @field_validator("translator", mode="before")
    @classmethod
    def _present_name(cls, value: object) -> object:
        """Say what a former name is called now."""
        if value in RENAMED:
            options = " ".join(f"translate.{k}={str(v).lower()}" for k, v in RENAMED[str(value)].items())
            raise ValueError(f"{value!r} is now: translate.translator=mixed_model {options}")
        return value

    @model_validator(mode="after")
    def _known_to_the_translator(self) -> Self:
        """Refuse an option that would do nothing."""
        if self.learn_from_batch and self.translator != "mixed_model":
            raise ValueError(
                f"learn_from_batch: {self.translator} cannot learn from the files to translate; leave it "
                "out, or take translate.translator=mixed_model"
            )
        return self

    @property
    def restricted(self) -> bool:
        """Whether not all files are translated."""
        return bool(self.only or self.trials)

    @property
    def options(self) -> dict[str, Any]:
        """What the translator is made with."""
        if self.translator == "likelihood_agent":
            return {"gate": True, "farthest": self.farthest}
        return {
            "pairs": self.pairs,
            "learn_from_batch": self.learn_from_batch,
            "farthest": self.farthest,
        }


class TrainAgentParameters(Parameters):
    """Parameters of ``train_agent``.

    Attributes
    ----------
    algorithm : {"PPO", "A2C"}
    reward : {"reach_target_fast", "maximize_reward"}
    environments, rollout_steps : int
        Environments side by side, and their steps between two updates (thesis, Tables 2.3 and 2.4).
    total_steps : int
        Of all environments together.
    likelihood_updates : int
        Updates of our agent's policy.
    """

    algorithm: Literal["PPO", "A2C"] = "PPO"
    reward: Literal["reach_target_fast", "maximize_reward"] = "reach_target_fast"
    environments: int = Field(4, ge=1, le=256)
    rollout_steps: int = Field(320, ge=2)
    total_steps: int = Field(100_000, ge=1)
    likelihood_updates: int = Field(100, ge=1)
