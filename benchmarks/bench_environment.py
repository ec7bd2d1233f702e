"""Steps per second of the thesis' environment, and one agent's whole training, against the naive form.

Naive: stable-baselines3's DummyVecEnv of four gymnasium environments, each asking scikit-learn's
``predict_proba`` for one row a step. Ours: the same rules, forest, algorithm and hyperparameters, with a
batch of four environments stepped by one compiled call.
Both take turns, several rounds, in one process on one thread; each round's ratio is of neighbours in time,
the median of the ratios is given. Processor time, as other programs may run meanwhile.

Run: python benchmarks/bench_environment.py [--table normalized_table.parquet] [--out folder]
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
import pandas as pd
import torch
from sklearn.ensemble import RandomForestClassifier
from stable_baselines3 import A2C, PPO
from stable_baselines3.common.monitor import Monitor
from stable_baselines3.common.vec_env import DummyVecEnv

from tire_pipeline.classifiers.methods.compiled_forest import CompiledForest, compile_forest
from tire_pipeline.representations import make_representation
from tire_pipeline.tire_table import Binning
from tire_pipeline.translation.thesis.batch_environment import BatchEnv
from tire_pipeline.translation.thesis.environment import TranslationEnv
from tire_pipeline.translation.thesis.rules import Rules
from tire_pipeline.translation.thesis.training import make_model

N_ENVS = 4
ROUNDS = 5
ENV_STEPS = {"naive": 400, "ours": 200_000}
TRAINING_STEPS = 1280  # one roll-out of 4 x 320 steps and its update


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--table", type=Path, help="normalised tire table; the newest run's if left out")
    parser.add_argument("--out", type=Path, help="folder for bench_environment.json")
    options = parser.parse_args()
    torch.set_num_threads(1)
    table = pd.read_parquet(options.table or newest_table())
    starts, labels = bins_and_labels(table)
    model = RandomForestClassifier(30, max_depth=10, random_state=0).fit(starts, labels)
    rules = Rules(starts.shape[1], 20, target=0)
    forest = compile_forest(model)
    result: dict[str, Any] = {"tires": len(table), "environments": N_ENVS}
    result["environment"] = compare(
        lambda: naive_steps(starts, model, rules), lambda: our_steps(starts, forest, rules)
    )
    for name, cls in (("PPO", PPO), ("A2C", A2C)):
        result[f"training {name}"] = compare(
            lambda cls=cls: naive_training(cls, starts, model, rules),
            lambda name=name: our_training(name, starts, forest, rules),
        )
        result[f"share of ours, {name}"] = shares(name, starts, forest, rules)
    text = json.dumps(result, indent=1)
    print(text)
    if options.out:
        options.out.mkdir(parents=True, exist_ok=True)
        (options.out / "bench_environment.json").write_text(text, encoding="utf-8")


def newest_table() -> Path:
    found = sorted(Path("data/03_primary/normalized_table.parquet").glob("*/*.parquet"))
    if not found:
        raise SystemExit("no tire table yet -> run `make run` first, or give --table")
    return found[-1]


def bins_and_labels(table: pd.DataFrame) -> tuple[np.ndarray, np.ndarray]:
    features = make_representation("coefficients").encode(table)
    bins = Binning.fit(features, 20).transform(features)
    return bins, table["category"].to_numpy(dtype=str)


def compare(naive: Callable[[], float], ours: Callable[[], float]) -> dict[str, float]:
    """Steps a second of both, in turns; the first call of each warms up."""
    naive(), ours()
    rates = [(naive(), ours()) for _ in range(ROUNDS)]
    return {
        "naive_steps_per_s": round(median(n for n, _ in rates), 1),
        "ours_steps_per_s": round(median(o for _, o in rates), 1),
        "ratio": round(median(o / n for n, o in rates), 1),
        "ratio_least": round(min(o / n for n, o in rates), 1),
        "ratio_most": round(max(o / n for n, o in rates), 1),
    }


def rate(steps: int, run: Callable[[], object]) -> float:
    start = time.process_time()
    run()
    return steps / (time.process_time() - start)


def naive_env(starts: np.ndarray, model: Any, rules: Rules) -> DummyVecEnv:
    return DummyVecEnv([lambda: Monitor(TranslationEnv(starts, model.predict_proba, rules))] * N_ENVS)


def naive_steps(starts: np.ndarray, model: Any, rules: Rules) -> float:
    return _steps(naive_env(starts, model, rules), rules, ENV_STEPS["naive"])


def our_steps(starts: np.ndarray, forest: CompiledForest, rules: Rules) -> float:
    env = BatchEnv(starts, forest, rules, n_envs=N_ENVS, seed=0)
    return _steps(env, rules, ENV_STEPS["ours"])


def _steps(env: Any, rules: Rules, steps: int) -> float:
    actions = np.random.default_rng(0).integers(0, rules.n_actions, (steps // N_ENVS, N_ENVS))
    env.reset()

    def run() -> None:
        for action in actions:
            env.step(action)

    return rate(steps, run)


def naive_training(cls: Any, starts: np.ndarray, model: Any, rules: Rules) -> float:
    agent = cls("MlpPolicy", naive_env(starts, model, rules), n_steps=320, seed=0, device="cpu")
    return rate(TRAINING_STEPS, lambda: agent.learn(TRAINING_STEPS))


def our_training(name: str, starts: np.ndarray, forest: CompiledForest, rules: Rules) -> float:
    env = BatchEnv(starts, forest, rules, n_envs=N_ENVS, seed=0)
    agent: Any = make_model(env, algorithm=name, seed=0)
    steps = 8 * TRAINING_STEPS
    return rate(steps, lambda: agent.learn(steps))


def shares(name: str, starts: np.ndarray, forest: CompiledForest, rules: Rules) -> dict[str, float]:
    """Where our training's time goes: environment, nets in the roll-out, update, the rest."""
    env = BatchEnv(starts, forest, rules, n_envs=N_ENVS, seed=0)
    agent: Any = make_model(env, algorithm=name, seed=0)
    spent = dict.fromkeys(("environment", "policy in the roll-out", "update"), 0.0)

    def timed(part: str, function: Callable[..., Any]) -> Callable[..., Any]:
        def wrapper(*args: Any, **kwargs: Any) -> Any:
            start = time.perf_counter()
            try:
                return function(*args, **kwargs)
            finally:
                spent[part] += time.perf_counter() - start

        return wrapper

    env.step_wait = timed("environment", env.step_wait)  # type: ignore[method-assign]
    agent.policy.forward = timed("policy in the roll-out", agent.policy.forward)
    agent.train = timed("update", agent.train)
    start = time.perf_counter()
    agent.learn(8 * TRAINING_STEPS)
    total = time.perf_counter() - start
    parts = {part: round(seconds / total, 3) for part, seconds in spent.items()}
    return {**parts, "stable-baselines3's roll-out": round(1 - sum(parts.values()), 3)}


if __name__ == "__main__":
    main()
