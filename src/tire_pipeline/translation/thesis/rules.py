"""The rules of the thesis' environment (section 4.5), apart from any library.

What the thesis leaves open, and what is done here:

* A move out of bounds costs 1 and leaves the state as it was.
* "Improvement" is a valuation above the best one seen in the episode, the start's included.
* The end after five steps without improvement stands in the section on *Maximize Reward* only. With
  *Reach Target Fast* nothing improves before the target is reached, so five steps would end every
  longer way; there an episode ends at the target, or is cut off after ``max_steps``.
* ``max_steps`` is 100: the step penalties then add up to that of one move out of bounds.
* The reward of an imaginary state is -0.01 whatever else it is; no valuation is taken there.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from tire_pipeline.errors import DomainError

OUT_OF_BOUNDS = -1.0
STEP = -0.01
REACHED = 1.0
PATIENCE = 5
MAX_STEPS = 100

REWARDS = ("reach_target_fast", "maximize_reward")


def _everything_is_real() -> np.ndarray:
    return np.ones((0, 1, 1, 1), dtype=np.bool_)


def _no_groups() -> np.ndarray:
    return np.zeros((0, 3), dtype=np.int64)


class RulesForCompiledCode(NamedTuple):
    """What of :class:`Rules` compiled code reads; ``maximize`` says *Maximize Reward*."""

    maximize: bool
    n_bins: int
    target: int
    patience: int
    max_steps: int
    real_features: np.ndarray
    real_lookup: np.ndarray


@dataclass(frozen=True)
class Rules:
    """What an environment needs to know besides the classifier and the tires.

    Attributes
    ----------
    n_features, n_bins : int
        The state is a vector of ``n_features`` bin numbers from 0 to ``n_bins - 1``.
    target : int
        Column of the target in the classifier's probabilities.
    reward : {"reach_target_fast", "maximize_reward"}
    patience : int
        Steps without improvement that end an episode with ``maximize_reward``.
    max_steps : int
        Steps after which any episode is cut off.
    real_features : ndarray of int, shape (groups, 3)
        Features that together decide whether a solution is real (power series: one group a load).
    real_lookup : ndarray of bool, shape (groups, n_bins, n_bins, n_bins)
        By their bins: whether it is.
    """

    n_features: int
    n_bins: int
    target: int
    reward: str = "reach_target_fast"
    patience: int = PATIENCE
    max_steps: int = MAX_STEPS
    real_features: np.ndarray = field(default_factory=_no_groups)
    real_lookup: np.ndarray = field(default_factory=_everything_is_real)

    def __post_init__(self) -> None:
        if self.reward not in REWARDS:
            raise DomainError(
                f"there is no reward {self.reward!r}", todo=f"choose one of {', '.join(REWARDS)}"
            )
        if self.n_bins < 2:
            raise DomainError("an environment needs at least two bins", todo="raise n_bins")

    @property
    def n_actions(self) -> int:
        """One feature, down or up: the thesis' shape (n, 2), counted through."""
        return 2 * self.n_features

    def is_real(self, state: np.ndarray) -> bool:
        """Tell whether a state (shape (n_features,)) has a real solution."""
        return all(
            self.real_lookup[group, state[a], state[b], state[c]]
            for group, (a, b, c) in enumerate(self.real_features)
        )

    def for_compiled_code(self) -> RulesForCompiledCode:
        """Return the rules as numba takes them."""
        return RulesForCompiledCode(
            self.reward == "maximize_reward",
            self.n_bins,
            self.target,
            self.patience,
            self.max_steps,
            np.ascontiguousarray(self.real_features, dtype=np.int64).reshape(-1, 3),
            np.ascontiguousarray(self.real_lookup, dtype=np.bool_),
        )

    def to_state(self) -> dict[str, Any]:
        """Return all attributes by name."""
        return {name: getattr(self, name) for name in self.__dataclass_fields__}

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Rules:
        """Restore what :meth:`to_state` returned."""
        return cls(
            n_features=int(state["n_features"]),
            n_bins=int(state["n_bins"]),
            target=int(state["target"]),
            reward=str(state["reward"]),
            patience=int(state["patience"]),
            max_steps=int(state["max_steps"]),
            real_features=np.asarray(state["real_features"], dtype=np.int64).reshape(-1, 3),
            real_lookup=np.asarray(state["real_lookup"], dtype=np.bool_),
        )


def feature_and_direction(action: int) -> tuple[int, int]:
    """Return the feature that an action moves, and -1 (down) or +1 (up)."""
    return action // 2, 1 if action % 2 else -1
