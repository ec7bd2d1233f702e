"""The thesis' translator from training table to translated tires."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Self

import numpy as np
import pandas as pd

from tire_pipeline.classifiers.methods.compiled_forest import CompiledForest
from tire_pipeline.classifiers.methods.random_forest import RandomForest
from tire_pipeline.errors import DomainError
from tire_pipeline.files.state_files import prefixed, without_prefix
from tire_pipeline.representations import (
    Representation,
    make_representation,
    representation_from_state,
)
from tire_pipeline.tire_table.binning import Binning
from tire_pipeline.translation.base import check_target
from tire_pipeline.translation.result import TranslationResult, without_estimate
from tire_pipeline.translation.thesis.policy import GreedyPolicy
from tire_pipeline.translation.thesis.real_states import real_states
from tire_pipeline.translation.thesis.roll_out import RollOut, roll_out
from tire_pipeline.translation.thesis.rules import MAX_STEPS, PATIENCE, Rules
from tire_pipeline.translation.thesis.training import N_ENVS, N_STEPS, train_agent


class AgentTranslator:
    """A random forest on binned features, and an agent that moves bins to make the target more probable.

    Parameters
    ----------
    algorithm : {"PPO", "A2C"}
    reward : {"reach_target_fast", "maximize_reward"}
    representation : str or fitted Representation
        A name of ``REPRESENTATIONS``; or one that is fitted already, then it is used as it is.
    n_bins : int
    total_steps : int, optional
        Training steps; see ``training.TOTAL_STEPS``.
    representation_options : mapping, optional
        For the constructor of a representation given by name.
    bins : Binning, optional
        Fitted on features of the same representation; instead of ``n_bins`` of equal width.
    n_steps, n_envs : int
        Steps of each environment between two updates, and environments.
    smote : bool
        For the forest.
    patience, max_steps : int
        See ``Rules``.

    Notes
    -----
    A feature moves by the distance between the centres of the bins where it ends and where it
    started: with equal width by whole bin widths. What the agent does not touch keeps its value.
    """

    name: ClassVar[str] = "agent"

    def __init__(
        self,
        algorithm: str = "PPO",
        reward: str = "reach_target_fast",
        representation: str | Representation = "coefficients",
        n_bins: int = 20,
        total_steps: int | None = None,
        *,
        representation_options: Mapping[str, Any] | None = None,
        bins: Binning | None = None,
        n_steps: int = N_STEPS,
        n_envs: int = N_ENVS,
        smote: bool = True,
        patience: int = PATIENCE,
        max_steps: int = MAX_STEPS,
    ) -> None:
        self.algorithm = algorithm
        self.reward = reward
        self.n_bins = n_bins if bins is None else bins.n_bins
        self._bins = bins
        self.total_steps = total_steps
        self.n_steps = n_steps
        self.n_envs = n_envs
        self.smote = smote
        self.patience = patience
        self.max_steps = max_steps
        self._given = None if isinstance(representation, str) else representation
        self._wanted = representation if isinstance(representation, str) else representation.name
        self._options = dict(representation_options or {})
        self.learning_curve = pd.DataFrame(columns=["step", "reward", "length"])
        self._parts: tuple[Representation, Binning, CompiledForest, Rules] | None = None
        self.policy: GreedyPolicy | None = None
        self.target = ""

    def fit(
        self,
        training: pd.DataFrame,
        *,
        target: str,
        seed: int,
        classifier: RandomForest | None = None,
    ) -> Self:
        """Fit the representation, the bins, the forest and the agent.

        Parameters
        ----------
        training : DataFrame
            Tire table with ``category``.
        target : str
        seed : int
        classifier : RandomForest, optional
            Trained on the bins of the same representation; trained here if not given.
        """
        check_target(training, target)
        representation = self._given or make_representation(self._wanted, **self._options)
        if self._given is None:
            representation.fit(training, seed=seed)
        features = representation.encode(training)
        bins = self._bins
        if bins is None:
            bins = Binning.fit(features, self.n_bins, names=representation.feature_names)
        starts = bins.transform(features)
        labels = training["category"].to_numpy().astype(str)
        if classifier is None:
            classifier = RandomForest(smote=self.smote).fit(starts, labels, seed=seed)
        if classifier.forest is None or target not in classifier.classes_:
            raise DomainError(
                f"the classifier does not know the target {target!r}", todo="train it on this table"
            )
        real_features, real_lookup = real_states(representation, bins)
        rules = Rules(
            n_features=features.shape[1],
            n_bins=bins.n_bins,
            target=int(np.flatnonzero(classifier.classes_ == target)[0]),
            reward=self.reward,
            patience=self.patience,
            max_steps=self.max_steps,
            real_features=real_features,
            real_lookup=real_lookup,
        )
        agent = train_agent(
            starts,
            classifier.forest,
            rules,
            algorithm=self.algorithm,
            total_steps=self.total_steps,
            seed=seed,
            n_steps=self.n_steps,
            n_envs=self.n_envs,
        )
        self.target = target
        self._parts = (representation, bins, classifier.forest, rules)
        self.policy, self.learning_curve = agent.policy, agent.learning_curve
        return self

    def translate(self, source: pd.DataFrame) -> pd.DataFrame:
        """Move every tire as the agent does, and decode where it ends up."""
        representation, features, _ = self._moved(source)
        return representation.decode(features, source)

    def translation(
        self, source: pd.DataFrame, *, bands: bool = True, farthest: float | None = None
    ) -> TranslationResult:
        """Translate; without bands or estimates of the error."""
        return without_estimate(source, self.translate(source), self.target, self.name)

    def translate_curves(self, source: pd.DataFrame) -> np.ndarray:
        """Return the curves as the thesis decodes them, N, shape (n, 3, 100)."""
        representation, features, _ = self._moved(source)
        return representation.decode_curves(features, source)

    def follow(self, source: pd.DataFrame) -> RollOut:
        """Return the roll-out itself: states, probabilities, actions."""
        return self._moved(source)[2]

    @property
    def action_names(self) -> tuple[str, ...]:
        """Feature and direction of every action, in order."""
        representation = self._fitted()[0]
        names = representation.feature_names
        return tuple(f"{name} {way}" for name in names for way in ("down", "up"))

    def to_state(self) -> dict[str, Any]:
        """Return everything that translating needs; the learning curve is not part of it."""
        representation, bins, forest, rules = self._fitted()
        assert self.policy is not None  # fit sets both
        return {
            "translator": self.name,
            "target": self.target,
            "algorithm": self.algorithm,
            "reward": self.reward,
            **prefixed("representation", representation.to_state()),
            **prefixed("bins", bins.to_state()),
            **prefixed("forest", forest.to_state()),
            **prefixed("rules", rules.to_state()),
            **prefixed("policy", self.policy.to_state()),
        }

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        representation = representation_from_state(without_prefix("representation", state))
        bins = Binning.from_state(without_prefix("bins", state))
        rules = Rules.from_state(without_prefix("rules", state))
        back = cls(
            algorithm=str(state["algorithm"]),
            reward=str(state["reward"]),
            representation=representation,
            bins=bins,
            patience=rules.patience,
            max_steps=rules.max_steps,
        )
        forest = CompiledForest.from_state(without_prefix("forest", state))
        back.target = str(state.get("target", "the target"))  # states of 0.1 do not tell it
        back._parts = (representation, bins, forest, rules)
        back.policy = GreedyPolicy.from_state(without_prefix("policy", state))
        return back

    def _fitted(self) -> tuple[Representation, Binning, CompiledForest, Rules]:
        if self._parts is None:
            raise DomainError("the agent is not trained", todo="call fit(...) first")
        return self._parts

    def _moved(self, source: pd.DataFrame) -> tuple[Representation, np.ndarray, RollOut]:
        representation, bins, forest, rules = self._fitted()
        assert self.policy is not None  # fit sets both
        features = representation.encode(source)
        starts = bins.transform(features)
        result = roll_out(self.policy, starts, forest, rules)
        moved = bins.inverse(result.states) - bins.inverse(starts)
        return representation, features + moved, result
