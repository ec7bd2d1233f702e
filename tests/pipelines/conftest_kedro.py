"""Runs of the small environment, each in a data folder of its own."""

from __future__ import annotations

import contextlib
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner
from filelock import FileLock
from kedro.framework.startup import bootstrap_project

from tire_pipeline.cli import cli

ROOT = Path(__file__).resolve().parents[2]
SHORT_TRAINING = ",".join(
    (
        "train_agent.total_steps=1280",
        "train_agent.likelihood_updates=2",
        "train_classifier.ann.epochs=10",
        "train_classifier.trainings=1",
    )
)
"""How good agents and networks become is no matter of a whole run's tests."""
IN_TURN = "cluster.processes=1"
"""Without processes beside: what many of them do is the same, and each imports everything again."""
Run = Callable[..., subprocess.CompletedProcess[str]]


def small_conf(folder: Path) -> Path:
    """A copy of the configuration whose small environment keeps its data in ``folder``."""
    conf = folder / "conf"
    shutil.copytree(ROOT / "conf", conf)
    data = folder / "data"
    (conf / "small" / "globals.yml").write_text(f"data: {data}\ntir_folder: {data}/01_raw/tir\n")
    return conf


def kedro(folder: Path, *arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """``kedro run --env small`` with the data in ``folder``, as a user would start it."""
    conf = folder / "conf"
    if not conf.exists():
        small_conf(folder)
    command = [sys.executable, "-m", "kedro", "run", "--env", "small", "--conf-source", str(conf)]
    return subprocess.run(
        [*command, *arguments],
        cwd=ROOT,
        env={**os.environ, "OMP_NUM_THREADS": "1", **environment},
        capture_output=True,
        text=True,
        check=False,
        timeout=600,
    )


def kedro_here(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """The same command in this process alone, which need not start and import everything again.

    For runs that end early or do little. What is logged (not printed) is not in what it returns.
    """
    bootstrap_project(ROOT)
    conf = folder / "conf"
    if not conf.exists():
        small_conf(folder)
    command = ["run", "--env", "small", "--conf-source", str(conf), *_in_turn(arguments)]
    with contextlib.chdir(ROOT):
        done = CliRunner().invoke(cli, command)
    if done.exception is not None and not isinstance(done.exception, SystemExit):
        raise done.exception
    return subprocess.CompletedProcess(command, done.exit_code, done.stdout, done.stderr)


def _in_turn(arguments: tuple[str, ...]) -> list[str]:
    """Arguments with the parameter that keeps all work in one process."""
    given = list(arguments)
    if "--params" not in given:
        return [*given, "--params", IN_TURN]
    given[given.index("--params") + 1] += f",{IN_TURN}"
    return given


def fleet_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a small fleet, nothing run on it yet; made once for all processes of a test run."""
    base = tmp_path_factory.getbasetemp()
    shared = base.parent if "PYTEST_XDIST_WORKER" in os.environ else base
    folder = shared / "small_fleet"
    with FileLock(shared / "small_fleet.lock"):
        if not (folder / "made").exists():
            made = kedro(folder, "--pipeline", "make_fleet")
            assert made.returncode == 0, made.stdout + made.stderr
            (folder / "made").touch()
    return folder


@pytest.fixture(scope="session")
def small_fleet(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a small fleet; whoever changes something copies it."""
    return fleet_folder(tmp_path_factory)


@pytest.fixture(scope="session")
def small_run(tmp_path_factory: pytest.TempPathFactory, small_fleet: Path) -> Path:
    """The folder of one whole small run: fleet, then the eight pipelines."""
    folder = tmp_path_factory.mktemp("small_run")
    shutil.copytree(small_fleet / "data", folder / "data")
    done = kedro(folder, "--params", f"{SHORT_TRAINING},{IN_TURN}")
    assert done.returncode == 0, done.stdout + done.stderr
    (folder / "stdout.txt").write_text(done.stdout)
    return folder
