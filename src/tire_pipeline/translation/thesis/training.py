"""Training of one agent with stable-baselines3: PPO or A2C, 320 roll-out steps, 4 environments."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.classifiers.methods.compiled_forest import CompiledForest
from tire_pipeline.errors import DomainError
from tire_pipeline.progress.training import learn
from tire_pipeline.translation.thesis.policy import GreedyPolicy
from tire_pipeline.translation.thesis.rules import Rules

ALGORITHMS = ("PPO", "A2C")
N_STEPS = 320
N_ENVS = 4
TOTAL_STEPS = {"PPO": 100_000, "A2C": 300_000}
"""Steps of all environments together. The thesis does not give its number. A2C updates once where PPO
updates 200 times, so it gets more steps and still takes less time (``benchmarks/bench_agents.py``)."""


@dataclass(frozen=True)
class TrainedAgent:
    """The result of a training.

    Attributes
    ----------
    policy : GreedyPolicy
    learning_curve : DataFrame
        One row an episode: ``step`` (steps of all environments so far), ``reward``, ``length``.
    """

    policy: GreedyPolicy
    learning_curve: pd.DataFrame


def train_agent(
    starts: np.ndarray,
    forest: CompiledForest,
    rules: Rules,
    *,
    algorithm: str = "PPO",
    total_steps: int | None = None,
    seed: int = 0,
    n_steps: int = N_STEPS,
    n_envs: int = N_ENVS,
) -> TrainedAgent:
    """Train one agent; everything not named here is stable-baselines3's default.

    Parameters
    ----------
    starts : ndarray of int, shape (n, d)
        Bins of the training tires.
    forest : CompiledForest
        The classifier.
    rules : Rules
    algorithm : {"PPO", "A2C"}
    total_steps : int, optional
        Steps of all environments together; ``TOTAL_STEPS`` if not given.
    seed : int
    n_steps, n_envs : int
        Steps of each environment between two updates, and environments.
    """
    from tire_pipeline.numerics.small_networks import one_torch_thread
    from tire_pipeline.translation.thesis.batch_environment import BatchEnv

    with one_torch_thread():
        env = BatchEnv(starts, forest, rules, n_envs=n_envs, seed=seed)
        model = make_model(env, algorithm=algorithm, seed=seed, n_steps=n_steps)
        steps = TOTAL_STEPS[algorithm] if total_steps is None else total_steps
        learn(model, steps, n_steps * n_envs, "training the thesis' agent")
    return TrainedAgent(
        policy=GreedyPolicy.from_model(model, rules.n_bins),
        learning_curve=pd.DataFrame(env.episodes, columns=["step", "reward", "length"]),
    )


def make_model(env: object, *, algorithm: str, seed: int, n_steps: int = N_STEPS) -> Any:
    """Return an untrained PPO or A2C with the thesis' settings."""
    import stable_baselines3
    import torch

    from tire_pipeline.numerics.small_networks import uncompiled

    if algorithm not in ALGORITHMS:
        raise DomainError(
            f"there is no algorithm {algorithm!r}", todo=f"choose one of {', '.join(ALGORITHMS)}"
        )
    cls: Any = getattr(stable_baselines3, algorithm)
    options: dict[str, Any] = {}
    if algorithm == "PPO":  # A2C brings an optimiser of its own
        options["policy_kwargs"] = {"optimizer_class": uncompiled(torch.optim.Adam)}
    return cls("MlpPolicy", env, n_steps=n_steps, seed=seed, device="cpu", verbose=0, **options)
