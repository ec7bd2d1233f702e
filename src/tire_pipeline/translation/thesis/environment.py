"""The thesis' environment as gymnasium knows it: one tire, one step at a time."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import gymnasium
import numpy as np

from tire_pipeline.translation.thesis.rules import (
    OUT_OF_BOUNDS,
    REACHED,
    STEP,
    Rules,
    feature_and_direction,
)

Score = Callable[[np.ndarray], np.ndarray]


class TranslationEnv(gymnasium.Env[np.ndarray, np.int64]):
    """State: the bin of every feature. Action: one feature down or up by one bin.

    Parameters
    ----------
    starts : ndarray of int, shape (n, d)
        Bins of the training tires; an episode starts at one of them, drawn at random.
    score : callable
        From states, shape (m, d), to class probabilities, shape (m, classes): a classifier's
        ``predict_proba``.
    rules : Rules

    Notes
    -----
    Action a moves feature ``a // 2``, down if ``a`` is even and up if it is odd. ``reset`` takes
    ``options={"row": i}`` to start at a tire of one's choice.
    """

    metadata: dict[str, Any] = {"render_modes": []}

    def __init__(self, starts: np.ndarray, score: Score, rules: Rules) -> None:
        self.starts = np.asarray(starts, dtype=np.int64)
        self.score = score
        self.rules = rules
        self.observation_space = gymnasium.spaces.MultiDiscrete([rules.n_bins] * rules.n_features)
        self.action_space = gymnasium.spaces.Discrete(rules.n_actions)
        self.state = self.starts[0].copy()
        self.best = 0.0
        self.without_improvement = 0
        self.steps = 0

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[np.ndarray, dict[str, Any]]:
        """Start at a tire."""
        super().reset(seed=seed)
        row = (options or {}).get("row")
        if row is None:
            row = int(self.np_random.integers(len(self.starts)))
        self.state = self.starts[row].copy()
        self.without_improvement = 0
        self.steps = 0
        self.best = 0.0
        if self.rules.is_real(self.state):
            self.best = float(self._probabilities()[self.rules.target])
        return self.state.copy(), {}

    def step(self, action: np.int64) -> tuple[np.ndarray, float, bool, bool, dict[str, Any]]:
        """Move, and be rewarded by the rules."""
        reward, terminated = self._move(int(action))
        self.steps += 1
        truncated = not terminated and self.steps >= self.rules.max_steps
        return self.state.copy(), reward, terminated, truncated, {}

    def _move(self, action: int) -> tuple[float, bool]:
        feature, direction = feature_and_direction(action)
        wanted = self.state[feature] + direction
        if not 0 <= wanted < self.rules.n_bins:
            return OUT_OF_BOUNDS, self._nothing_gained()
        self.state[feature] = wanted
        if not self.rules.is_real(self.state):
            return STEP, self._nothing_gained()
        probabilities = self._probabilities()
        if self.rules.reward == "reach_target_fast":
            reached = bool(probabilities.argmax() == self.rules.target)
            return (REACHED if reached else STEP), reached
        gained = float(probabilities[self.rules.target]) - self.best
        if gained <= 0:
            return STEP, self._nothing_gained()
        self.best += gained
        self.without_improvement = 0
        return STEP + gained, False

    def _nothing_gained(self) -> bool:
        """Count a step without improvement; tell whether it ends the episode."""
        self.without_improvement += 1
        return self.rules.reward == "maximize_reward" and self.without_improvement >= self.rules.patience

    def _probabilities(self) -> np.ndarray:
        return self.score(self.state[None, :])[0]
