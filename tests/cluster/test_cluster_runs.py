"""Whole runs on a cluster: the same results, nothing done twice, bad files by name."""

from __future__ import annotations

import shutil
import sys
import threading
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import cluster_tasks as tasks
import pandas as pd
import pytest
from noted_loader import NotedLoader

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "retraining"))
from retraining_files import put, tir_text

from tire_pipeline.cluster import ClusterHooks, work_map
from tire_pipeline.command.stored import translator_state
from tire_pipeline.datasets import ComputedFolderDataset, RecordingFolderDataset, TirFolderDataset
from tire_pipeline.files.rows_on_disk import joined
from tire_pipeline.reporting.mismatch.explained_recordings import (
    ExplainParameters,
    collect_explained,
    explain_each,
)
from tire_pipeline.tire_table.one_nominal_load import NormalizeParameters
from tire_pipeline.tire_table.read_blocks import divided
from tire_pipeline.tire_table.read_files import IngestParameters, join_files, read_files
from tire_pipeline.translation.files import translated_folder
from tire_pipeline.translation.files.translated_folder import join_translated, translate_each
from tire_pipeline.translation.parameters import TranslateParameters

ROOT = Path(__file__).resolve().parents[2]
STORED = ROOT / "tests" / "data_of_0_1"


def _choose(**parameters) -> None:
    """What Kedro calls before a run with these parameters of the cluster."""
    context = SimpleNamespace(config_loader={"parameters": {"cluster": parameters}})
    ClusterHooks().after_context_created(context)


@pytest.fixture
def chosen(cluster):
    """The run's parameters name the cluster, as a run's hook does it."""
    _choose(scheduler=cluster.address, wait_seconds=120)
    yield
    ClusterHooks().after_pipeline_run()
    _choose()


@pytest.fixture
def raw(tmp_path):
    """Some tires, three that are none, a recording, and one that is none."""
    for number in range(12):
        put(tmp_path / "tir", f"{'AB'[number % 2]}/{number}.tir", tir_text(number))
    for number in range(3):
        put(tmp_path / "tir", f"A/bad{number}.tir", "no tire")
    for tire in (STORED / "07_model_output" / "translated").rglob("*.tir"):
        put(tmp_path / "tir", f"A/{tire.name}", tire.read_bytes())
    place = tmp_path / "recordings" / "rig"
    place.mkdir(parents=True)
    shutil.copy(ROOT / "examples" / "tire.tir", place / "model.tir")
    run = pd.read_csv(ROOT / "examples" / "rig_run.csv")
    run.drop(columns=["V", "P"])[:400:4].to_csv(place / "recording.csv", index=False)
    (tmp_path / "recordings" / "bad").mkdir()
    (tmp_path / "recordings" / "bad" / "recording.csv").write_text("time,slip_angle\n0,0.01\n")
    return tmp_path


def _translate(files: dict, folder: Path) -> None:
    """Translate the files by a stored translator, in blocks of a few."""
    (table,) = (STORED / "03_primary").rglob("*.parquet/*/*.parquet")
    state, _ = translator_state(STORED / "06_models" / "translator.npz")
    blocks = ComputedFolderDataset(path=str(folder))
    given = (pd.read_parquet(table), TranslateParameters(farthest=3.0), NormalizeParameters(), 0)
    blocks.save(translate_each(state, files, *given))
    texts, found, *_ = join_translated(blocks.load(), state, given[1])
    report = joined(found)
    assert len(report) == len(files)
    assert sorted(texts) == sorted(report.loc[report["verdict"] == "translated", "file"]) != []


def _stored(raw: Path, folder: Path) -> dict[str, bytes]:
    """Read all files and explain all recordings with the run's workers; every file that this leaves."""
    files = TirFolderDataset(path=str(raw / "tir")).load()
    recordings = RecordingFolderDataset(path=str(raw / "recordings")).load()
    blocks = ComputedFolderDataset(path=str(folder / "blocks"))
    blocks.save(read_files(files))
    table, report, _ = join_files(blocks.load(), IngestParameters())
    assert list(table.frame()["file"]) == sorted(f for f in files if "bad" not in f)
    assert (joined(report)["status"] == "set aside").sum() == 3
    _translate(files, folder / "translated")
    explained = ComputedFolderDataset(path=str(folder / "explained"))
    explained.save(explain_each(recordings, ExplainParameters()))
    reports, overview, pages, _ = collect_explained(explained.load())
    assert list(reports) == ["rig/recording.csv"]
    assert joined(overview).set_index("recording").loc["bad/recording.csv", "problem"]
    assert all(b"<html" in read() for read in pages.values())
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def test_results_are_the_same_to_the_last_bit(raw, request, monkeypatch):
    monkeypatch.setattr(translated_folder, "TRANSLATED_TOGETHER", 6)
    alone = _stored(raw, raw / "alone")
    request.getfixturevalue("chosen")
    assert work_map().__class__.__name__ == "_DaskMap"
    assert _stored(raw, raw / "clustered") == alone
    assert len(alone) >= 5


def test_a_killed_scheduler_costs_what_was_under_way_only(tmp_path, cluster, caplog, monkeypatch):
    """With real files: the next run opens none whose rows are stored."""
    from dask_processes import Processes

    monkeypatch.setattr(divided, "__defaults__", (2,))
    places = [put(tmp_path / "tir", f"A/{n}.tir", tir_text(n, "A")) for n in range(300)]
    files = {f"A/{path.name}": NotedLoader(str(path)) for path in places}
    blocks = read_files(files)
    own = Processes(tmp_path)
    _choose(scheduler=own.address, wait_seconds=120)
    dataset = ComputedFolderDataset(path=str(tmp_path / "out"))

    def stored() -> set[str]:
        return {name for name in blocks if (tmp_path / "out" / name).exists()}

    over = threading.Event()

    def kill() -> None:
        while len(stored()) < 5:
            if over.wait(0.005):
                return
        own.kill_scheduler()

    killer = threading.Thread(target=kill)
    killer.start()
    try:
        with pytest.raises(Exception, match="the Dask scheduler does not answer any more") as found:
            dataset.save(blocks)
    finally:
        over.set()
        killer.join()
        own.end()
    assert "run again" in str(found.value)
    ClusterHooks().on_pipeline_error()
    assert [each for each in caplog.records if each.name.startswith("distributed")] == []
    done = stored()
    assert 5 <= len(done) < len(blocks)
    assert not dataset.exists()
    _choose(scheduler=cluster.address, wait_seconds=120)
    dataset.save(read_files(files))
    ClusterHooks().after_pipeline_run()
    _choose()
    table, _, _ = join_files(dataset.load(), IngestParameters())
    assert list(table.frame()["file"]) == sorted(files)
    for name, block in blocks.items():
        for loader in block.files.values():
            opened = len(Path(f"{loader.path}.read").read_text())
            assert opened == 1 if name in done else opened >= 1


@pytest.mark.long
def test_a_file_that_ends_its_reader_is_in_the_report_by_name(tmp_path, chosen):
    from tire_pipeline.datasets.users_files.tir_folder import TirLoader

    good = ROOT / "examples" / "tire.tir"
    files = {f"A/{n}.tir": TirLoader(str(good)) for n in range(3)}
    files["A/killer.tir"] = tasks.DiesUntil(tmp_path / "more memory", tmp_path / "log", str(good))
    dataset = ComputedFolderDataset(path=str(tmp_path / "blocks"))
    dataset.save(read_files(files))
    table, report, summary = join_files(dataset.load(), IngestParameters())
    assert table.frame()["file"].tolist() == ["A/0.tir", "A/1.tir", "A/2.tir"]
    assert summary["set_aside"] == 1
    row = joined(report).set_index("file").loc["A/killer.tir"]
    assert row["status"] == "set aside"
    assert "died three times" in row["reason"]
    (tmp_path / "log").unlink()
    (tmp_path / "more memory").touch()
    dataset.save(read_files(files))
    assert "A/killer.tir" in join_files(dataset.load(), IngestParameters())[0].frame()["file"].tolist()
    assert not (tmp_path / "log").exists()


def test_work_that_may_not_miss_a_part_names_it_after_all_else_is_stored(tmp_path, chosen):

    work = {f"{n}": partial(tasks.slow_bytes, tmp_path / f"calls{n}", n) for n in range(5)}
    work["killer"] = partial(tasks.dies, tmp_path / "log")
    with pytest.raises(Exception, match="1 of 6 could not be computed; the first: killer"):
        ComputedFolderDataset(path=str(tmp_path / "out")).save(work)
    assert {path.name for path in (tmp_path / "out").iterdir()} == set("01234")
