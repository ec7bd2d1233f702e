"""What the thesis' grid of 48 agents costs with stable-baselines3 as it comes, and with larger batches.

Every form steps the same compiled batch of environments; what differs is the update. One update
is one roll-out of 1,280 steps and what is learnt from it. Processor time on one thread, as other programs may
run meanwhile; minutes on two cores are half of the sum over 24 agents of PPO and 24 of A2C.

Run: python benchmarks/bench_agents.py --table normalized_table.parquet [--out folder]
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median
from typing import Any

import pandas as pd
import torch
from bench_environment import bins_and_labels, newest_table
from sklearn.ensemble import RandomForestClassifier
from stable_baselines3 import A2C, PPO

from tire_pipeline.classifiers.methods.compiled_forest import compile_forest
from tire_pipeline.translation.thesis.batch_environment import BatchEnv
from tire_pipeline.translation.thesis.rules import Rules
from tire_pipeline.translation.thesis.training import TOTAL_STEPS, make_model

STEPS = 1280
ROUNDS = 3
AGENTS = {"PPO": 24, "A2C": 24}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--table", type=Path, help="normalised tire table; the newest run's if left out")
    parser.add_argument("--out", type=Path, help="folder for agents.json")
    options = parser.parse_args()
    torch.set_num_threads(1)
    starts, labels = bins_and_labels(pd.read_parquet(options.table or newest_table()))
    forest = compile_forest(RandomForestClassifier(30, max_depth=10, random_state=0).fit(starts, labels))
    rules = Rules(starts.shape[1], 20, target=0)

    def env(n_envs: int = 4) -> BatchEnv:
        return BatchEnv(starts, forest, rules, n_envs=n_envs, seed=0)

    def plain(cls: Any, n_envs: int = 4, compiled: bool = False, **more: Any) -> Any:
        agent = cls("MlpPolicy", env(n_envs), n_steps=STEPS // n_envs, seed=0, device="cpu", **more)
        if compiled:
            agent.policy.evaluate_actions = torch.compile(agent.policy.evaluate_actions)
        return agent

    forms: dict[str, tuple[str, Callable[[], Any]]] = {
        "as it comes (minibatches of 64)": ("PPO", lambda: make_model(env(), algorithm="PPO", seed=0)),
        "as it comes": ("A2C", lambda: make_model(env(), algorithm="A2C", seed=0)),
        "torch.compile": ("PPO", lambda: plain(PPO, compiled=True)),
        "minibatches of 256": ("PPO", lambda: plain(PPO, batch_size=256)),
        "minibatches of 1280": ("PPO", lambda: plain(PPO, batch_size=STEPS)),
        "64 environments, minibatches of 1280": ("PPO", lambda: plain(PPO, 64, batch_size=STEPS)),
        "64 environments": ("A2C", lambda: plain(A2C, 64)),
    }
    result = []
    for name, (algorithm, make) in forms.items():
        row: dict[str, Any] = {"algorithm": algorithm, "form": name}
        try:
            seconds = per_update(make())
        except Exception as error:  # no compiler on this machine, for torch.compile
            row["error"] = str(error).splitlines()[0][:200]
        else:
            updates = -(-TOTAL_STEPS[algorithm] // STEPS)
            row["updates_per_s"] = round(1.0 / seconds, 3)
            row["minutes_of_24_agents_on_two_cores"] = round(
                AGENTS[algorithm] * updates * seconds / 60.0 / 2.0, 1
            )
        result.append(row)
        print(json.dumps(row), flush=True)
    if options.out:
        options.out.mkdir(parents=True, exist_ok=True)
        (options.out / "agents.json").write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")


def per_update(agent: Any) -> float:
    """Processor seconds of one update, the median of some; the first warms up."""
    agent.learn(STEPS)
    times = []
    for _ in range(ROUNDS):
        start = time.process_time()
        agent.learn(STEPS)
        times.append(time.process_time() - start)
    return median(times)


if __name__ == "__main__":
    main()
