"""An agent learns to translate: it moves a tire's scores and is rewarded by likelihood, not by probability.

Reward of a step: how much the log density ratio of target to source category given the metadata grows, less
the growth of half the squared distance moved, in the densities' own units. A classifier's probability says
"this looks like D" about anything that separates the classes; this says "for a tire of this size, mass and
pressure D would more probably have measured that, and it is still this tire".
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import gymnasium as gym
import numpy as np
import pandas as pd
from stable_baselines3.common.vec_env import VecEnv

from tire_pipeline.translation.population.model import CurveMixedModel

STEPS = 3
"""Moves in an episode."""

LONGEST_MOVE = 3.0
"""Largest move of one score in one step, in standard deviations of a tire about its expectation."""


@dataclass(frozen=True)
class Situation:
    """Tires to translate, in units of each score's standard deviation about its expectation.

    Attributes
    ----------
    scores : ndarray, shape (n, p)
        About the source category's expectation for such a tire.
    target : ndarray, shape (n, p)
        The target's expectation less the source's.
    context : ndarray, shape (n, c)
        Source category as indicators, metadata, probability of each class of tire, and of category and
        class, protocol.
    unit : ndarray, shape (p,)
        Standard deviation of each score.
    """

    scores: np.ndarray
    target: np.ndarray
    context: np.ndarray
    unit: np.ndarray

    @property
    def observation_size(self) -> int:
        """Numbers in an observation: scores, what was moved, context."""
        return 2 * self.scores.shape[1] + self.context.shape[1]


def situation_of(model: CurveMixedModel, table: pd.DataFrame, target: str) -> Situation:
    """Describe source files as the environment needs them."""
    found = model.predict(table, target, trust=0.0)
    unit = model.scale * np.array(
        [np.sqrt(sum(f.variances[n] for n in ("tire", "tire_category", "noise"))) for f in model.fitted]
    )
    surprise = np.clip(found.surprise, -4.0, 4.0)
    category = table["category"].to_numpy(dtype=str)
    organisation = (category[:, None] == np.array(model.categories)[None, :]).astype(float)
    metadata = np.clip(model.metadata.regressors(table), -4.0, 4.0)
    known = [
        organisation,
        metadata,
        found.classes,
        _both(organisation, found.classes),
        model.protocols.code(table),
    ]
    context = np.concatenate(known, axis=1)
    return Situation(surprise, found.shift / unit, context, unit)


def _both(organisation: np.ndarray, classes: np.ndarray) -> np.ndarray:
    """Category and class of tire together, (n, categories x classes)."""
    return (organisation[:, :, None] * classes[:, None, :]).reshape(len(organisation), -1)


def potential(moved: np.ndarray, situation: Situation, rows: np.ndarray) -> np.ndarray:
    """Log density ratio at the moved scores less half the squared distance, (n,), up to a constant a tire.

    With Gaussian densities of equal spread the ratio is linear in the scores.
    """
    gain = situation.target[rows]
    return (gain * moved).sum(axis=1) - 0.5 * (moved**2).sum(axis=1)


def observe(moved: np.ndarray, situation: Situation, rows: np.ndarray) -> np.ndarray:
    """What the agent sees, (n, observation_size)."""
    seen = [situation.scores[rows] + moved, moved, situation.context[rows]]
    return np.concatenate(seen, axis=1).astype(np.float32)


class LikelihoodEnvironment(gym.Env):
    """One tire at a time.

    Observation: scores now, what was moved so far, source category and metadata. Action: a move of every
    score in [-1, 1], times :data:`LONGEST_MOVE`. An episode has :data:`STEPS` moves.

    Parameters
    ----------
    situation : Situation
    """

    metadata: dict[str, Any] = {"render_modes": []}

    def __init__(self, situation: Situation) -> None:
        self.situation = situation
        scores = situation.scores.shape[1]
        self.observation_space = gym.spaces.Box(-np.inf, np.inf, (situation.observation_size,), np.float32)
        self.action_space = gym.spaces.Box(-1.0, 1.0, (scores,), np.float32)
        self.row = np.zeros(1, dtype=int)
        self.moved = np.zeros((1, scores))
        self.left = STEPS

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[np.ndarray, dict[str, Any]]:
        """Take another tire."""
        super().reset(seed=seed)
        self.row = self.np_random.integers(len(self.situation.scores), size=1)
        self.moved, self.left = np.zeros_like(self.moved), STEPS
        return observe(self.moved, self.situation, self.row)[0], {}

    def step(self, action: np.ndarray) -> tuple[np.ndarray, float, bool, bool, dict[str, Any]]:
        """Move the tire."""
        before = potential(self.moved, self.situation, self.row)
        self.moved = self.moved + LONGEST_MOVE * np.clip(action, -1.0, 1.0)[None, :]
        reward = potential(self.moved, self.situation, self.row) - before
        self.left -= 1
        return observe(self.moved, self.situation, self.row)[0], float(reward[0]), self.left == 0, False, {}


class BatchLikelihoodEnvironment(VecEnv):
    """Many tires at once: the same rules as :class:`LikelihoodEnvironment`.

    Parameters
    ----------
    situation : Situation
    count : int
        Tires side by side.
    seed : int
    curiosity : callable, optional
        From observations (n, d) to a bonus (n,), added to the reward.
    """

    def __init__(self, situation: Situation, count: int, seed: int, curiosity: Any = None) -> None:
        single = LikelihoodEnvironment(situation)
        super().__init__(count, single.observation_space, single.action_space)
        self.situation, self.curiosity = situation, curiosity
        self.rng = np.random.default_rng(seed)
        self.actions = np.zeros((count, situation.scores.shape[1]))

    def reset(self) -> np.ndarray:
        """Take other tires."""
        self.rows = self.rng.integers(len(self.situation.scores), size=self.num_envs)
        self.moved = np.zeros_like(self.actions)
        self.left, self.gained = STEPS, np.zeros(self.num_envs)
        return observe(self.moved, self.situation, self.rows)

    def step_async(self, actions: np.ndarray) -> None:
        """Keep the actions."""
        self.actions = actions

    def step_wait(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, list[dict[str, Any]]]:
        """Move all tires."""
        before = potential(self.moved, self.situation, self.rows)
        self.moved = self.moved + LONGEST_MOVE * np.clip(self.actions, -1.0, 1.0)
        reward = potential(self.moved, self.situation, self.rows) - before
        seen = observe(self.moved, self.situation, self.rows)
        self.gained += reward
        if self.curiosity is not None:
            reward = reward + self.curiosity(seen)
        self.left -= 1
        done = self.left == 0
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        if done:
            infos = [
                {"terminal_observation": last, "episode": {"r": float(gain), "l": STEPS, "t": 0.0}}
                for last, gain in zip(seen, self.gained, strict=True)
            ]
            seen = self.reset()
        return seen, reward.astype(np.float32), np.full(self.num_envs, done), infos

    def close(self) -> None:
        """Nothing to close."""

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """Return an attribute of this object for each tire."""
        return [getattr(self, attr_name, None)] * self.num_envs

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """Set an attribute of this object."""
        setattr(self, attr_name, value)

    def env_method(self, method_name: str, *args: Any, indices: Any = None, **options: Any) -> list[Any]:
        """Not offered: there are no single environments in here."""
        raise NotImplementedError(method_name)

    def env_is_wrapped(self, wrapper_class: Any, indices: Any = None) -> list[bool]:
        """Tell for each tire that it is not wrapped."""
        return [False] * self.num_envs
