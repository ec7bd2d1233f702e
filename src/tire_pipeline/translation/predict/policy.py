"""Prediction by an agent: proximal policy optimisation on the log density ratio given the metadata."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
import pandas as pd
import torch
from stable_baselines3 import PPO
from torch import nn

from tire_pipeline.numerics.row_products import by_row
from tire_pipeline.numerics.small_networks import one_torch_thread, uncompiled
from tire_pipeline.progress.training import learn
from tire_pipeline.translation.population.model import CurveMixedModel, Prediction
from tire_pipeline.translation.predict.curiosity import Curiosity
from tire_pipeline.translation.predict.likelihood_environment import (
    LONGEST_MOVE,
    STEPS,
    BatchLikelihoodEnvironment,
    observe,
    situation_of,
)
from tire_pipeline.translation.predict.shrinkage import without_failed_fits

TIRES_TOGETHER = 64
ROLL_OUT = 48
UPDATES = 100


@dataclass(frozen=True)
class PolicyPredictor:
    """A policy that moves scores, trained with stable-baselines3, without pairs.

    Attributes
    ----------
    updates : int
        Roll-outs of 64 tires and 48 steps that it learns from.
    curious : bool
        With random network distillation: a bonus for states that it has seldom seen.
    layers : tuple of ndarray
        Weights and biases of both layers; empty until it is fitted.
    learning : tuple of float
        Rewards of the last episodes of the training.
    """

    updates: int = UPDATES
    curious: bool = False
    layers: tuple[np.ndarray, ...] = ()
    learning: tuple[float, ...] = ()

    def fit(self, model: CurveMixedModel, training: pd.DataFrame, target: str, seed: int) -> Self:
        """Train the policy."""
        sources = training.loc[training["category"].astype(str) != target].reset_index(drop=True)
        situation = situation_of(model, sources, target)
        curiosity = Curiosity(situation.observation_size, seed) if self.curious else None
        with one_torch_thread():
            environment = BatchLikelihoodEnvironment(situation, TIRES_TOGETHER, seed, curiosity)
            agent = PPO(
                "MlpPolicy",
                environment,
                n_steps=ROLL_OUT,
                batch_size=512,
                n_epochs=8,
                learning_rate=_learning_rate,
                gamma=1.0,
                gae_lambda=0.9,
                ent_coef=0.0,
                policy_kwargs={
                    "log_std_init": -1.2,
                    "net_arch": [64],
                    "activation_fn": nn.Tanh,
                    "optimizer_class": uncompiled(torch.optim.Adam),
                },
                seed=seed,
                device="cpu",
            )
            steps = self.updates * TIRES_TOGETHER * ROLL_OUT
            learn(agent, steps, TIRES_TOGETHER * ROLL_OUT, "training our agent")
        learning = tuple(float(info["r"]) for info in agent.ep_info_buffer or [])
        return replace(self, layers=tuple(_layers(agent)), learning=learning)

    def act(self, seen: np.ndarray) -> np.ndarray:
        """Return the policy's mean action, (n, p), in [-1, 1]."""
        first, first_bias, last, last_bias = self.layers
        hidden = np.tanh(by_row(seen, first) + first_bias)
        return np.clip(by_row(hidden, last) + last_bias, -1.0, 1.0)

    def predict(self, model: CurveMixedModel, source: pd.DataFrame, target: str) -> Prediction:
        """Let the agent move the scores."""
        found = model.predict(source, target, trust=0.0)
        situation = situation_of(model, source, target)
        rows = np.arange(len(source))
        moved = np.zeros_like(situation.scores)
        for _ in range(STEPS):
            moved = moved + LONGEST_MOVE * self.act(observe(moved, situation, rows))
        moved = moved * situation.unit
        return without_failed_fits(model, replace(found, shift=moved, target=found.source + moved))

    def to_state(self) -> dict[str, Any]:
        """Return the arrays, strings and numbers that restore the trained policy."""
        return {
            "option_updates": self.updates,
            **{f"policy_{k}": layer for k, layer in enumerate(self.layers)},
        }

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned; it moves alike, and can be trained again."""
        layers = tuple(np.asarray(state[f"policy_{k}"]) for k in range(4))
        return cls(int(state["option_updates"]), str(state["translator"]) == "curious_agent", layers)


def _learning_rate(left: float) -> float:
    """Falls from 0.001 with the share of the training that is left."""
    return 1e-3 * max(left, 0.02)


def _layers(agent: PPO) -> list[np.ndarray]:
    """Weights (input x output) and biases of the policy's two layers, double precision."""
    inner, outer = agent.policy.mlp_extractor.policy_net[0], agent.policy.action_net
    found = []
    for layer in (inner, outer):  # type: Any
        weight, bias = (each.detach().numpy().astype(float) for each in layer.parameters())
        found += [weight.T, bias]
    return found
