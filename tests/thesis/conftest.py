"""Fixtures of the thesis tests: a synthetic table, and one small run that is killed and goes on."""

from __future__ import annotations

import importlib.util
import os
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

import pytest
from thesis_stored import Stored, stored_results

TESTS = Path(__file__).parents[1]


def _module(path: Path, name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@dataclass(frozen=True)
class InterruptedRun:
    """A run that was killed, and the one after it."""

    folder: Path
    left: dict[str, Stored]
    done: subprocess.CompletedProcess[str]
    kedro: object


@pytest.fixture(scope="session")
def table():
    """300 synthetic tires of three categories."""
    path = TESTS / "representations" / "synthetic_tires.py"
    return _module(path, "synthetic_tires_for_thesis").synthetic_table(300, "ABC", seed=1)


@pytest.fixture(scope="session")
def interrupted_run(tmp_path_factory: pytest.TempPathFactory) -> InterruptedRun:
    """The two cells of the small environment: killed when the first agent is stored, then run again."""
    helper = _module(TESTS / "pipelines" / "conftest_kedro.py", "conftest_kedro_for_thesis")
    folder = tmp_path_factory.mktemp("thesis_run")
    shutil.copytree(helper.fleet_folder(tmp_path_factory) / "data", folder / "data")
    made = helper.kedro_here(folder, "--pipelines", "ingest_tir,dedupe_filter,normalize,represent,bin")
    assert made.returncode == 0, made.stdout + made.stderr
    command = [sys.executable, "-m", "kedro", "run", "--env", "small", "--conf-source", str(folder / "conf")]
    running = subprocess.Popen(
        [*command, "--pipeline", "reproduce_thesis", "--namespaces", "representations,agents,floor"],
        cwd=helper.ROOT,
        env={**os.environ, "OMP_NUM_THREADS": "1"},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    agents = folder / "data" / "06_models" / "thesis"
    while running.poll() is None and not list(agents.glob("*/*/seed_*.npz")):
        time.sleep(0.02)
    running.send_signal(signal.SIGKILL)
    running.wait()
    time.sleep(1.0)  # workers notice that they are alone
    left = stored_results(folder)
    done = helper.kedro_here(folder, "--pipeline", "reproduce_thesis")
    return InterruptedRun(folder, left, done, helper.kedro)
