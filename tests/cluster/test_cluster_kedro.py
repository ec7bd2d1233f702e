"""``kedro run --env cluster`` as a process, beside a scheduler and two workers that are processes, too."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from dask_processes import Processes

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "pipelines"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "retraining"))
from conftest_kedro import ROOT, fleet_folder, kedro_here, small_conf
from retraining_files import put, tir_text

pytestmark = pytest.mark.long
TIME_OF_RUN = re.compile(r"\d{4}-\d\d-\d\d(T\d\d\.\d\d\.\d\d\.\d{3}Z| \d\d:\d\d)")


def _running(folder: Path, environment: str, pipeline: str, **more: str) -> subprocess.Popen[str]:
    conf = folder / "conf"
    command = [sys.executable, "-m", "kedro", "run", "--env", environment, "--conf-source", str(conf)]
    return subprocess.Popen(
        [*command, "--pipeline", pipeline, "--params", "cluster.wait_seconds=120"],
        cwd=ROOT,
        env={**os.environ, "OMP_NUM_THREADS": "1", **more},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


def _ended(running: subprocess.Popen[str]) -> str:
    """Everything that a run says that ends well, on one line."""
    said, _ = running.communicate(timeout=900)
    assert running.returncode == 0, said
    return " ".join(said.split())


def _conf(folder: Path) -> None:
    """The configuration of a small run, in the environment ``cluster``, too."""
    conf = small_conf(folder)
    shutil.copy(conf / "small" / "globals.yml", conf / "cluster")
    with (conf / "cluster" / "parameters.yml").open("a") as file:
        file.write((conf / "small" / "parameters.yml").read_text())


@pytest.fixture
def raw(tmp_path_factory) -> Path:
    """A small fleet with its normalized table; a recording, one that is none, and a file that is no tire."""
    folder = tmp_path_factory.mktemp("run")
    shutil.copytree(fleet_folder(tmp_path_factory) / "data", folder / "data")
    _conf(folder)
    made = kedro_here(folder, "--pipelines", "ingest_tir,dedupe_filter,normalize")
    assert made.returncode == 0, made.stdout + made.stderr
    put(folder / "data" / "01_raw" / "tir", "A/bad.tir", "no tire")
    rig, bad = (folder / "data" / "01_raw" / "recordings" / name for name in ("rig", "bad"))
    for place in (rig, bad):
        place.mkdir(parents=True)
        shutil.copy(ROOT / "examples" / "tire.tir", place / "model.tir")
    rows = (ROOT / "examples" / "rig_run.csv").read_text().splitlines()
    (rig / "recording.csv").write_text("\n".join([*rows[:2], *rows[2:800:4]]) + "\n")
    (bad / "recording.csv").write_text("time,slip_angle\n0,0.01\n")
    return folder


def _results(data: Path) -> dict[str, str]:
    """What a run leaves, but for the time of the run."""
    found = {}
    for path in sorted(data.rglob("*")):
        name = str(path.relative_to(data))
        if path.is_file() and name.startswith(("06_", "07_", "08_")):
            content = path.read_bytes().decode("latin-1")
            found[TIME_OF_RUN.sub("", name)] = TIME_OF_RUN.sub("", content)
    return found


@pytest.mark.parametrize("pipeline", ["translate", "explain_mismatch"])
def test_a_run_by_the_cluster_leaves_the_same_bits(raw, tmp_path, cluster, pipeline):
    """The same files in the same folder both times: their dates and places are in names and pages."""
    data, before = raw / "data", tmp_path / "before"
    shutil.copytree(data, before, ignore=shutil.ignore_patterns("01_raw"))
    alone = _ended(_running(raw, "small", pipeline))
    assert "Dask" not in alone
    wanted = _results(data)
    for folder in data.iterdir():
        if folder.name != "01_raw":
            shutil.rmtree(folder)
    shutil.copytree(before, data, dirs_exist_ok=True)
    said = _ended(_running(raw, "cluster", pipeline, TIRE_PIPELINE_SCHEDULER=cluster.address))
    assert "2 Dask workers at" in said
    found = _results(data)
    assert sorted(found) == sorted(wanted)
    assert [name for name in wanted if found[name] != wanted[name]] == []
    assert len([name for name in wanted if name.endswith(".tir" if pipeline == "translate" else ".html")]) > 1


def test_the_run_after_a_killed_scheduler_reads_none_of_the_blocks_that_are_stored(raw, tmp_path, cluster):
    for number in range(2000):
        put(raw / "data" / "01_raw" / "tir", f"B/more{number}.tir", tir_text(number, "B"))
    blocks = raw / "data" / "02_intermediate" / "tir_blocks"

    def stored() -> dict[str, int]:
        return {str(path): path.stat().st_mtime_ns for path in blocks.rglob("*.zip")}

    shutil.rmtree(blocks)
    own = Processes(tmp_path)
    try:
        running = _running(raw, "cluster", "ingest_tir", TIRE_PIPELINE_SCHEDULER=own.address)
        while running.poll() is None and len(stored()) < 2:
            time.sleep(0.005)
        own.kill_scheduler()
        said, _ = running.communicate(timeout=300)
    finally:
        own.end()
    done = stored()
    assert running.returncode == 1
    assert "Traceback" not in said
    assert "the Dask scheduler does not answer any more" in " ".join(said.split())
    again = _ended(_running(raw, "cluster", "ingest_tir", TIRE_PIPELINE_SCHEDULER=cluster.address))
    assert "A/bad.tir is set aside" in again
    now = stored()
    assert len(now) == 16
    assert {name: now[name] for name in done} == done
