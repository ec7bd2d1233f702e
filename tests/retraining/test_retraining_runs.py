"""`kedro run --pipeline retrain` as cron starts it, with all that can arrive, and killed in between."""

from __future__ import annotations

import contextlib
import io
import json
import multiprocessing
import os
import shutil
import subprocess
import sys
import threading
import time
from dataclasses import replace
from pathlib import Path

import pandas as pd
import pytest
from retraining_files import put, put_fleet, tir_text

from tire_pipeline.datasets import IngestStoreDataset, ReleaseDataset
from tire_pipeline.retraining import Manifest, ModelRegistry, Store, difference, ingest, judge

pytestmark = pytest.mark.slow
ROOT = Path(__file__).resolve().parents[2]
SETTLE = 1


def _prepared(folder: Path) -> Path:
    shutil.copytree(ROOT / "conf", folder / "conf")
    data = folder / "data"
    (folder / "conf/small/globals.yml").write_text(f"data: {data}\ntir_folder: {data}/01_raw/tir\n")
    put_fleet(data / "01_raw/tir", range(40))
    return folder


def _settings(parameters: dict[str, object]) -> dict[str, object]:
    return {"retrain.settle_seconds": SETTLE, "dedupe_filter.minimum_per_category": 5, **parameters}


def _command(folder: Path, pipeline: str = "retrain", **parameters: object) -> str:
    """As cron starts it."""
    text = ",".join(f"{name}={value}" for name, value in _settings(parameters).items())
    command = [sys.executable, "-m", "kedro", "run", "--env", "small", "--conf-source", str(folder / "conf")]
    done = subprocess.run(
        [*command, "--pipeline", pipeline, "--params", text],
        cwd=ROOT,
        env={**os.environ, "OMP_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        check=False,
        timeout=600,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def _run(folder: Path, pipeline: str = "retrain", **parameters: object) -> str:
    """The same in this process, which has all imports."""
    from kedro.framework.session import KedroSession
    from kedro.framework.startup import bootstrap_project

    nested: dict[str, dict[str, object]] = {}
    for name, value in _settings(parameters).items():
        group, key = name.split(".")
        nested.setdefault(group, {})[key] = value
    bootstrap_project(ROOT)
    said = io.StringIO()
    with (
        contextlib.redirect_stdout(said),
        KedroSession.create(
            project_path=ROOT, env="small", conf_source=str(folder / "conf"), runtime_params=nested
        ) as session,
    ):
        session.run(pipeline_names=[pipeline])
    return said.getvalue()


def _outcome(folder: Path) -> dict[str, object]:
    files = (folder / "data/07_model_output/retraining_outcome.json").glob("*/*.json")
    return json.loads(sorted(files)[-1].read_text())


def _stored(folder: Path) -> Store:
    return IngestStoreDataset(path=str(folder / "data/02_intermediate/ingested")).load()


def _released(folder: Path) -> ReleaseDataset:
    return ReleaseDataset(path=str(folder / "data/06_models/released"))


def _in_use(folder: Path) -> ModelRegistry:
    return _released(folder).load()


def _assert_right(folder: Path) -> None:
    """The stored table is that of one reading of all that lies there now."""
    tir = folder / "data/01_raw/tir"
    fresh, _ = ingest(Store(), tir, difference(tir, Manifest(), settle_seconds=0.0))
    stored = _stored(folder)
    pd.testing.assert_frame_equal(stored.table, fresh.table)
    assert stored.manifest.digest == fresh.manifest.digest
    assert _in_use(folder).release.judged.digest == fresh.manifest.digest


def test_files_that_arrive_before_and_during_a_run(tmp_path):
    folder = _prepared(tmp_path)
    tir = folder / "data/01_raw/tir"
    _command(folder)
    assert _outcome(folder)["event"] == "released"
    first = _in_use(folder).release.current

    # a hundred at once, the same again, a bad one; and a half-written one that its writer goes on with
    put_fleet(tir, range(100, 140))
    put(tir, "A/again.tir", tir_text(100, "A"))
    put(tir, "A/bad.tir", bytes(range(256)))
    put(tir, "D/early_name.tir", tir_text(200, "D"))
    half = tir_text(201, "D")
    put(tir, "D/half.tir", half[: len(half) // 2], age=0.0)
    ended = threading.Event()

    def keep_writing() -> None:
        at = len(half) // 2
        while not ended.wait(0.3):
            at = min(at + 5, len(half) - 1)
            put(tir, "D/half.tir", half[:at], age=0.0)
            put(tir, f"B/late{at}.tir", tir_text(at + 1000, "B"), age=0.0)

    writer = threading.Thread(target=keep_writing)
    writer.start()
    try:
        _run(folder, **{"retrain.most_wait_seconds": 2})
    finally:
        ended.set()
        writer.join()
    files = _stored(folder).table["file"]
    assert "D/half.tir" not in set(files)
    assert not files.str.startswith("B/late").all()
    assert {"A/again.tir", "D/early_name.tir"} <= set(files)
    assert "A/bad.tir" not in set(files)

    put(tir, "D/half.tir", half)
    put(tir, "A/bad.tir", tir_text(203, "A"))
    time.sleep(SETTLE)
    _run(folder)
    _assert_right(folder)
    assert {"D/half.tir", "A/bad.tir"} <= set(_stored(folder).table["file"])

    # nothing new: nothing happens; then back to the model before
    before = _in_use(folder).release
    _run(folder)
    assert _outcome(folder)["event"] == "unchanged"
    assert "Nothing changed" in (folder / "data/08_reporting/retraining.html").read_text()
    assert _in_use(folder).release == before
    later = replace(before.judged, digest="of other files")
    after = judge(before, "later", later, better=True, time="now", figures={})
    _released(folder).save(ModelRegistry(after, _in_use(folder).model))
    assert _in_use(folder).release.current == "later"
    said = _run(folder, "rollback")
    assert "An earlier model was put back: later was taken back by the pipeline rollback." in said
    assert f"Model in use: {before.current}." in said
    assert _in_use(folder).release.current == before.current
    assert first in before.models
    page = (folder / "data/08_reporting/retraining.html").read_text()
    assert "An earlier model was put back" in page  # it named the model that was taken back as the one in use
    assert f"Model in use: {before.current}." in page
    assert "http:" not in page
    assert "https:" not in page


@pytest.fixture
def processes():
    """Each is forked from one that has the imports and nothing else."""
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(
        [
            "kedro.framework.session",
            "tire_pipeline.kedro_runs.around_run",
            "tire_pipeline.retraining.train_and_release",
        ]
    )
    return context


def test_a_killed_run_loses_nothing_and_the_next_ends_right(tmp_path, processes):
    folder = _prepared(tmp_path)
    data = folder / "data"
    marks = {
        "before anything is stored": ".runs/*.json",
        "files stored, nothing released": "02_intermediate/ingested/part-*",
        "compared, perhaps released": "07_model_output/retraining_comparison.csv/*/*",
        "released": "06_models/released/record.json",
    }
    tires = iter(range(1000, 2000))
    for place, mark in marks.items():
        put_fleet(data / "01_raw/tir", range(number := next(tires), number + 3))
        seen = set(data.glob(mark))
        dates = {path: path.stat().st_mtime_ns for path in seen}
        running = processes.Process(target=_run, args=(folder,))
        running.start()
        while running.is_alive():
            now = set(data.glob(mark))
            if any(path not in dates or _date(path) != dates[path] for path in now):
                break
            time.sleep(0.002)
        assert running.is_alive(), f"the run ended before it could be killed: {place}"
        running.kill()
        running.join()
        _stored(folder)  # the old state or the new one: both load
        _in_use(folder)
    _run(folder)
    _assert_right(folder)
    assert list((data / ".runs").glob("*.json")) == []
    released = _in_use(folder).release
    assert len({event["model"] for event in released.history}) == len(released.history)


def _date(path: Path) -> int:
    try:
        return path.stat().st_mtime_ns
    except FileNotFoundError:
        return -1
