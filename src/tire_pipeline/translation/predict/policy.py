"""The agent: proximal policy optimisation on the log density ratio given the metadata."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, ClassVar, Self

import numpy as np
import pandas as pd
import torch
from stable_baselines3 import PPO
from torch import nn

from tire_pipeline.translation.judge.shrinkage import failed_fits
from tire_pipeline.translation.population.fit import Prepared
from tire_pipeline.translation.population.model import Prediction
from tire_pipeline.translation.predict.curiosity import Curiosity
from tire_pipeline.translation.predict.likelihood_environment import (
    REACH,
    STEPS,
    BatchLikelihoodEnvironment,
    observe,
    situation_of,
)
from tire_pipeline.translation.translator import FARTHEST, MixedModel

TIRES = 64
ROLL_OUT = 48
UPDATES = 100


class LikelihoodAgent(MixedModel):
    """Translates by a policy that was trained with stable-baselines3, without pairs.

    Parameters
    ----------
    updates : int
        Roll-outs of 64 tires and 48 steps that it learns from.
    gate, farthest
        As in :class:`.translator.MixedModel`; the agent by itself never refuses.
    """

    name: ClassVar[str] = "likelihood_agent"
    curious: ClassVar[bool] = False

    def __init__(
        self,
        *,
        updates: int = UPDATES,
        gate: bool = False,
        pairs: bool = False,
        farthest: float = FARTHEST,
    ) -> None:
        super().__init__(pairs=pairs, trust=0.0, gate=gate, farthest=farthest)
        self.updates = int(updates)

    def fit(
        self, training: pd.DataFrame, *, target: str, seed: int = 0, made: Prepared | None = None
    ) -> Self:
        """Fit the densities, then train the policy.

        Raises
        ------
        DomainError
            If the table has no tire of the target, or none of any other category.
        """
        super().fit(training, target=target, seed=seed, made=made)
        sources = training.loc[training["category"].astype(str) != target].reset_index(drop=True)
        situation = situation_of(self.model, sources, target)
        curiosity = Curiosity(situation.observation_size, seed) if self.curious else None
        threads = torch.get_num_threads()
        torch.set_num_threads(1)
        try:
            environment = BatchLikelihoodEnvironment(situation, TIRES, seed, curiosity)
            agent = PPO(
                "MlpPolicy",
                environment,
                n_steps=ROLL_OUT,
                batch_size=512,
                n_epochs=8,
                learning_rate=lambda left: 1e-3 * max(left, 0.02),
                gamma=1.0,
                gae_lambda=0.9,
                ent_coef=0.0,
                policy_kwargs={"log_std_init": -1.2, "net_arch": [64], "activation_fn": nn.Tanh},
                seed=seed,
                device="cpu",
            )
            agent.learn(self.updates * TIRES * ROLL_OUT)
        finally:
            torch.set_num_threads(threads)
        self.learning = [float(info["r"]) for info in agent.ep_info_buffer or []]
        self.layers = _layers(agent)
        return self

    def act(self, seen: np.ndarray) -> np.ndarray:
        """Give the policy's mean action, (n, p), in [-1, 1]."""
        first, first_bias, last, last_bias = self.layers
        return np.clip(np.tanh(seen @ first + first_bias) @ last + last_bias, -1.0, 1.0)

    def predict(self, source: pd.DataFrame) -> Prediction:
        """Let the agent move the scores."""
        found = self.model.predict(source, self.target, trust=0.0)
        situation = situation_of(self.model, source, self.target)
        rows = np.arange(len(source))
        moved = np.zeros_like(situation.scores)
        for _ in range(STEPS):
            moved = moved + REACH * self.act(observe(moved, situation, rows))
        target = found.source + moved * situation.unit
        place = self.model.space.slices["aligning torque"]
        failed = failed_fits(self.model, found)
        target[failed, place] = found.expected[failed, place]
        return replace(found, shift=moved * situation.unit, target=target)

    def to_state(self) -> dict[str, Any]:
        """Give arrays, strings and numbers that bring the trained agent back."""
        return {
            **super().to_state(),
            "option_updates": self.updates,
            **{f"policy_{k}": layer for k, layer in enumerate(self.layers)},
        }

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Bring back what :meth:`to_state` gave; it translates the same and cannot learn on."""
        agent = super().from_state(state)
        agent.updates = int(state["option_updates"])
        agent.layers = [np.asarray(state[f"policy_{k}"]) for k in range(4)]
        return agent

    @classmethod
    def _with_options(cls, state: Mapping[str, Any]) -> Self:
        return cls(gate=bool(state["option_gate"]), pairs=bool(state["option_pairs"]))


class CuriousAgent(LikelihoodAgent):
    """The same with random network distillation: a bonus for states that it has seldom seen."""

    name: ClassVar[str] = "curious_agent"
    curious: ClassVar[bool] = True


def _layers(agent: PPO) -> list[np.ndarray]:
    """Weights (input x output) and biases of the policy's two layers, double precision."""
    inner, outer = agent.policy.mlp_extractor.policy_net[0], agent.policy.action_net
    found = []
    for layer in (inner, outer):  # type: Any
        weight, bias = (each.detach().numpy().astype(float) for each in layer.parameters())
        found += [weight.T, bias]
    return found
