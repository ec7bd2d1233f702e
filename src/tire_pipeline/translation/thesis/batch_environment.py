"""The thesis' environment for stable-baselines3: N tires stepped by one compiled call."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import gymnasium
import numpy as np
from stable_baselines3.common.vec_env import VecEnv

from tire_pipeline.classifiers.methods.compiled_forest import CompiledForest
from tire_pipeline.translation.thesis.compiled_step import advance
from tire_pipeline.translation.thesis.rules import Rules


class BatchEnv(VecEnv):
    """N copies of :class:`TranslationEnv`, with the same semantics step for step.

    Parameters
    ----------
    starts : ndarray of int, shape (n, d)
        Bins of the training tires.
    forest : CompiledForest
        Its sums are the class probabilities.
    rules : Rules
    n_envs : int
    seed : int
        Seed of the start tires.

    Attributes
    ----------
    episodes : list of (steps taken by all environments so far, episode reward, episode length)
        The learning curve.
    rows : ndarray of int, shape (N,)
        The tire that each environment started from.
    """

    def __init__(
        self, starts: np.ndarray, forest: CompiledForest, rules: Rules, *, n_envs: int, seed: int
    ) -> None:
        space = gymnasium.spaces.MultiDiscrete([rules.n_bins] * rules.n_features)
        self.render_mode = None
        super().__init__(n_envs, space, gymnasium.spaces.Discrete(rules.n_actions))
        self.starts = np.ascontiguousarray(starts, dtype=np.int64)
        self.rules = rules
        real = np.array([rules.is_real(state) for state in self.starts])
        self._start_values = np.where(real, forest.sums(self.starts)[:, rules.target], 0.0)
        self._constants = (rules.for_compiled_code(), forest.arrays())
        self._random = np.random.default_rng(seed)
        self._states = np.zeros((n_envs, rules.n_features), dtype=np.int64)
        self._best = np.zeros(n_envs)
        self._without_improvement = np.zeros(n_envs, dtype=np.int64)
        self._steps = np.zeros(n_envs, dtype=np.int64)
        self._frozen = np.zeros(n_envs, dtype=np.bool_)
        self._returns = np.zeros(n_envs)
        self._actions = np.zeros(n_envs, dtype=np.int64)
        self.rows = np.zeros(n_envs, dtype=np.int64)
        self.taken = 0
        self.episodes: list[tuple[int, float, int]] = []

    def reset(self) -> np.ndarray:
        """Start every environment at a random tire."""
        for index in range(self.num_envs):
            self._restart(index)
        return self._states.copy()

    def step_async(self, actions: np.ndarray) -> None:
        """Note the actions, shape (N,)."""
        self._actions = np.asarray(actions, dtype=np.int64)

    def step_wait(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, list[dict[str, Any]]]:
        """Take the actions; environments whose episode is over start again."""
        n = self.num_envs
        rewards = np.empty(n)
        ended, cut = np.empty(n, dtype=np.bool_), np.empty(n, dtype=np.bool_)
        advance(
            self._actions,
            self._states,
            self._best,
            self._without_improvement,
            self._steps,
            rewards,
            ended,
            cut,
            self._frozen,
            *self._constants,
        )
        self._returns += rewards
        self.taken += n
        done = ended | cut
        infos: list[dict[str, Any]] = [{} for _ in range(n)]
        for index in done.nonzero()[0].tolist():
            length, reward = int(self._steps[index]), float(self._returns[index])
            self.episodes.append((self.taken, reward, length))
            infos[index] = {
                "terminal_observation": self._states[index].copy(),
                "TimeLimit.truncated": bool(cut[index]),
                "episode": {"r": reward, "l": length},
            }
            self._restart(index)
        return self._states.copy(), rewards, done, infos

    def _restart(self, index: int) -> None:
        row = self._random.integers(len(self.starts))
        self.rows[index] = row
        self._states[index] = self.starts[row]
        self._best[index] = self._start_values[row]
        self._without_improvement[index] = 0
        self._steps[index] = 0
        self._returns[index] = 0.0

    def close(self) -> None:
        """Nothing is open."""

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """Return an attribute once for each environment."""
        return [getattr(self, attr_name)] * len(list(self._get_indices(indices)))

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """Refuse: the environments share their attributes."""
        raise NotImplementedError("the environments of a batch share their attributes")

    def env_method(self, method_name: str, *args: Any, indices: Any = None, **kwargs: Any) -> Any:
        """Refuse: there are no single environments."""
        raise NotImplementedError("a batch has no single environments to call")

    def env_is_wrapped(self, wrapper_class: Any, indices: Any = None) -> list[bool]:
        """Nothing is wrapped."""
        return [False] * len(list(self._get_indices(indices)))

    def seed(self, seed: int | None = None) -> Sequence[int | None]:
        """Seed the draw of start tires."""
        self._random = np.random.default_rng(seed)
        return [seed] * self.num_envs

    def _get_indices(self, indices: Any) -> Iterable[int]:
        if indices is None:
            return range(self.num_envs)
        return [indices] if isinstance(indices, int) else indices
