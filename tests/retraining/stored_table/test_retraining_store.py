"""What is stored is the old state or the new one, whatever happens in between."""

from __future__ import annotations

import hashlib
import json
import os
import sys
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from kedro.io import DatasetError
from retraining_files import put, put_fleet, tir_text

from tire_pipeline.classifiers.methods.random_forest import RandomForest
from tire_pipeline.datasets import FolderDataset, IngestStoreDataset, ReleaseDataset
from tire_pipeline.errors import DomainError
from tire_pipeline.files.packed import as_parquet
from tire_pipeline.files.rows_on_disk import joined
from tire_pipeline.representations import make_representation
from tire_pipeline.retraining import (
    Judged,
    Manifest,
    ModelRegistry,
    Store,
    difference,
    ingest,
    ingest_in_steps,
    judge,
    roll_back,
)
from tire_pipeline.retraining import train_model as train
from tire_pipeline.retraining.stored_table.partition import Partition
from tire_pipeline.tir import read_tir

REPLACE = os.replace


def _ingested(dataset, folder):
    store = dataset.load()
    return ingest(store, folder, difference(folder, store.manifest))[0]


@pytest.fixture
def dataset(tmp_path):
    return IngestStoreDataset(path=str(tmp_path / "ingested"))


@pytest.fixture
def files(tmp_path):
    put(tmp_path / "tir", "A/1.tir", tir_text(1))
    return tmp_path / "tir"


class _Killed(BaseException):
    """Stands for the end of the process at one place."""


def _killed_at_step(monkeypatch, step: int) -> None:
    """End at the step-th renaming: just before it, so that all before it has happened."""
    steps = iter(range(100))

    def rename(source, target):
        if next(steps) == step:
            raise _Killed
        return REPLACE(source, target)

    monkeypatch.setattr(os, "replace", rename)


def test_it_is_empty_at_first_and_comes_back(dataset, files):
    assert dataset.load().table.empty
    store = _ingested(dataset, files)
    dataset.save(store)
    again = dataset.load()
    pd.testing.assert_frame_equal(again.table, store.table)
    assert again.manifest == replace(store.manifest, revision=1)


@pytest.mark.parametrize("step", [0, 1])
def test_killed_while_saving_leaves_the_old_state_and_the_next_run_ends_right(
    dataset, files, monkeypatch, step
):
    dataset.save(_ingested(dataset, files))
    before = dataset.load()
    put(files, "A/2.tir", tir_text(2))
    _killed_at_step(monkeypatch, step)
    with pytest.raises(_Killed):
        dataset.save(_ingested(dataset, files))
    monkeypatch.setattr(os, "replace", REPLACE)
    assert dataset.load().manifest == before.manifest
    pd.testing.assert_frame_equal(dataset.load().table, before.table)
    dataset.save(_ingested(dataset, files))
    assert dataset.load().table["file"].tolist() == ["A/1.tir", "A/2.tir"]
    assert len(list((files.parent / "ingested").glob("*.parquet"))) == 1


def test_two_runs_at_once_do_not_overwrite_each_other(dataset, files):
    first = _ingested(dataset, files)
    put(files, "A/2.tir", tir_text(2))
    second = _ingested(dataset, files)
    dataset.save(first)
    with pytest.raises(DatasetError, match="another run has stored revision 1"):
        dataset.save(second)
    assert dataset.load().table["file"].tolist() == ["A/1.tir"]


@pytest.mark.parametrize("name", ["manifest.json", "part-*.parquet"])
def test_a_damaged_part_is_named_with_what_to_do(dataset, files, name):
    dataset.save(_ingested(dataset, files))
    (path,) = (files.parent / "ingested").glob(name)
    path.write_bytes(path.read_bytes()[:-30])
    with pytest.raises(Exception, match=f"{path.name}.*damaged.*the next run reads all files again"):
        len(dataset.load().table)
    path.unlink()
    if name != "manifest.json":
        with pytest.raises(DomainError, match=f"{path.name}.*missing.*the next run reads all files again"):
            len(dataset.load().table)


def test_what_is_new_changes_few_parts_and_no_more_are_read(dataset, tmp_path, monkeypatch):
    monkeypatch.setattr("tire_pipeline.retraining.stored_table.partition.PIECE_ROWS", 4)
    folder = tmp_path / "tir"
    put_fleet(folder, range(10), "AB")
    dataset.save(_ingested(dataset, folder))
    before = {path.name for path in (tmp_path / "ingested").glob("part-*.parquet")}
    assert len(before) >= 5
    put(folder, "A/new.tir", tir_text(99))
    store = dataset.load()
    read = []

    def noted(load):
        return lambda: read.append(1) or load()

    parts = {n: replace(p, load=noted(p.load)) for n, p in store.partition.parts.items()}
    store = Store(store.manifest, Partition(store.partition.count, parts))
    dataset.save(ingest(store, folder, difference(folder, store.manifest))[0])
    assert len(read) <= 1
    after = {path.name for path in (tmp_path / "ingested").glob("part-*.parquet")}
    assert len(after - before) == 1
    assert len(before - after) <= 1
    whole = ingest(Store(), folder, difference(folder, Manifest()))[0]
    pd.testing.assert_frame_equal(dataset.load().table, whole.table)


def test_a_store_of_before_there_were_parts_is_read_and_goes_on(dataset, files):
    store = _ingested(dataset, files)
    (files.parent / "ingested").mkdir()
    content = as_parquet(store.table)
    (files.parent / "ingested/table-000001-1.parquet").write_bytes(content)
    table = {"name": "table-000001-1.parquet", "sha256": hashlib.sha256(content).hexdigest()}
    old = replace(store.manifest, revision=1).to_json(table=table)
    (files.parent / "ingested/manifest.json").write_bytes(old)
    pd.testing.assert_frame_equal(dataset.load().table, store.table)
    put(files, "A/2.tir", tir_text(2))
    dataset.save(_ingested(dataset, files))
    assert dataset.load().table["file"].tolist() == ["A/1.tir", "A/2.tir"]
    assert [path.name[:5] for path in (files.parent / "ingested").glob("*.parquet")] == ["part-"]


def test_a_manifest_cannot_point_outside_of_its_folder(dataset, files, tmp_path):
    dataset.save(_ingested(dataset, files))
    path = files.parent / "ingested" / "manifest.json"
    content = json.loads(path.read_text())
    content["table"]["parts"]["0"][0] = "../part-1.parquet"
    path.write_text(json.dumps(content))
    with pytest.raises(DatasetError, match="damaged"):
        dataset.load()


def test_files_of_the_user_are_never_written(tmp_path):
    with pytest.raises(Exception, match="never changed"):
        FolderDataset(path=str(tmp_path)).save(tmp_path)
    with pytest.raises(Exception, match="does not exist"):
        FolderDataset(path=str(tmp_path / "absent")).load()


# released models


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    folder = tmp_path_factory.mktemp("fleet")
    put_fleet(folder, range(15), "AB")
    tires = ingest(Store(), folder, difference(folder, Manifest()))[0].table
    representation = make_representation("coefficients")
    return train(tires, representation, RandomForest(3, 3), nominal_load=4000.0, seed=1)


@pytest.fixture
def place(tmp_path):
    return tmp_path / "released"


@pytest.fixture
def registry(place):
    return ReleaseDataset(path=str(place))


def _next(registry: ModelRegistry, name: str, model) -> ModelRegistry:
    judged = Judged(digest=name, settings="s", sequence=1, split="x")
    return ModelRegistry(judge(registry.release, name, judged, better=True, time="t", figures={}), model)


def test_release_and_roll_back(registry, model):
    assert registry.load() == ModelRegistry()
    registry.save(_next(registry.load(), "m1", model))
    registry.save(_next(registry.load(), "m2", model))
    assert registry.load().release.current == "m2"
    registry.save(ModelRegistry(roll_back(registry.load().release, time="t")))
    back = registry.load()
    assert back.release.current == "m1"
    np.testing.assert_array_equal(back.model.bins.edges, model.bins.edges)


@pytest.mark.parametrize("step", [0, 1])
def test_killed_while_releasing_leaves_the_old_model_in_use(registry, model, monkeypatch, step):
    registry.save(_next(registry.load(), "m1", model))
    after = _next(registry.load(), "m2", model)
    _killed_at_step(monkeypatch, step)
    with pytest.raises(_Killed):
        registry.save(after)
    monkeypatch.setattr(os, "replace", REPLACE)
    assert registry.load().release.current == "m1"
    registry.save(after)
    assert registry.load().release.current == "m2"


def test_two_releases_at_once(registry, model):
    first, second = _next(registry.load(), "m1", model), _next(registry.load(), "m2", model)
    registry.save(first)
    with pytest.raises(DatasetError, match="another run"):
        registry.save(second)


def test_a_tampered_model_or_record_is_not_loaded(registry, model, tmp_path):
    registry.save(_next(registry.load(), "m1", model))
    path = tmp_path / "released/models/m1.npz"
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(content)
    with pytest.raises(DatasetError, match="not loaded"):
        registry.load()
    record = tmp_path / "released/record.json"
    record.write_text(record.read_text().replace('"m1"', '"../../m1"'))
    with pytest.raises(DatasetError, match="damaged"):
        registry.load()


# the file of the model in use is missing


def _going_back(place):
    return ReleaseDataset(path=str(place), for_going_back=True)


def _file(place, name):
    return place / "models" / f"{name}.npz"


def _rolled_back(registry, place):
    loaded = _going_back(place).load()
    registry.save(ModelRegistry(roll_back(loaded.release, time="t", unusable=loaded.unusable)))
    return registry.load()


@pytest.fixture
def three(registry, model):
    for name in ("m1", "m2", "m3"):
        registry.save(_next(registry.load(), name, model))
    return registry


def test_a_model_in_use_that_is_gone_is_rolled_back(three, place):
    _file(place, "m3").unlink()
    with pytest.raises(DatasetError, match=r"the file of the model in use is missing.*rollback"):
        three.load()
    back = _rolled_back(three, place)
    assert back.release.current == "m2"
    assert back.model is not None
    assert "m3" in back.release.last_event["reason"]


def test_a_damaged_model_is_rolled_back_and_models_that_are_gone_are_skipped(three, place):
    path = _file(place, "m3")
    path.write_bytes(path.read_bytes()[:-40])
    _file(place, "m2").unlink()
    back = _rolled_back(three, place)
    assert back.release.models == ("m1",)
    assert "unusable: m2, m3" in back.release.last_event["reason"]


@pytest.mark.parametrize("share", [0.02, 0.2, 0.5, 0.8])
def test_a_model_in_use_that_is_damaged_anywhere_is_rolled_back(three, place, share):
    path = _file(place, "m3")
    content = bytearray(path.read_bytes())
    start = int(share * len(content))
    content[start : start + 9] = bytes(each ^ 0xFF for each in content[start : start + 9])
    path.write_bytes(content)
    with pytest.raises(DatasetError, match=r"the model.*(damaged|wrong).*it is not loaded.*rollback"):
        three.load()
    assert _rolled_back(three, place).release.current == "m2"


@pytest.mark.parametrize("count", [1, 2, 3])
def test_where_no_model_is_left_it_says_what_is_left_to_do(registry, place, model, count):
    names = [f"m{number}" for number in range(count)]
    for name in names:
        registry.save(_next(registry.load(), name, model))
    for name in names:
        _file(place, name).unlink()
    loaded = _going_back(place).load()
    with pytest.raises(DomainError) as caught:
        roll_back(loaded.release, time="t", unusable=loaded.unusable)
    text = str(caught.value)
    assert "no model left to go back to" in text
    assert all(f"{name} is gone" in text for name in names)
    with pytest.raises(DatasetError, match="the file of the model in use is missing") as of_the_retraining:
        registry.load()
    for said in (text, str(of_the_retraining.value)):
        assert "from a backup" in said
        assert "move the folder of released models away" in said
        assert "rollback" not in said


def test_where_only_the_earlier_models_are_gone_the_one_in_use_is_kept(three, place):
    for name in ("m1", "m2"):
        _file(place, name).unlink()
    loaded = _going_back(place).load()
    with pytest.raises(DomainError, match=r"m2 is gone.*m1 is gone.*keep m3, which is in use and whole"):
        roll_back(loaded.release, time="t", unusable=loaded.unusable)
    assert three.load().release.current == "m3"


def _parts_of(monkeypatch, rows: int) -> None:
    for module in ("in_steps", "partition"):
        monkeypatch.setattr(
            sys.modules[f"tire_pipeline.retraining.stored_table.{module}"], "PIECE_ROWS", rows
        )


def test_a_run_that_ends_while_it_reads_repeats_nothing_that_was_stored(dataset, tmp_path, monkeypatch):
    _parts_of(monkeypatch, 4)
    folder = tmp_path / "tir"
    put_fleet(folder, range(6), "AB")
    dataset.save(_ingested(dataset, folder))
    put_fleet(folder, range(6, 12), "AB")
    put(folder, "A/bad.tir", "no tire")
    (folder / "A/T0000.tir").unlink()
    read = []

    def noted(path):
        read.append(path)
        return read_tir(path)

    def steps():
        store = dataset.load()
        found = difference(folder, store.manifest)
        return ingest_in_steps(store, folder, found, noted, step_seconds=0.0, monotonic=float)

    begun = steps()
    for _ in range(2):
        dataset.save(next(begun)[0])
    begun.close()
    known = dataset.load().manifest.files
    assert 0 < len(read) < 13
    assert set(read) == {str(folder / name) for name in known if name[2:] > "T0005.tir"}
    for store, _ in steps():
        dataset.save(store)
    assert len(read) == len(set(read)) == 13
    whole = ingest(Store(), folder, difference(folder, Manifest()))[0]
    again = dataset.load()
    assert again.manifest.digest == whole.manifest.digest
    assert as_parquet(again.table) == as_parquet(whole.table)


def test_steps_are_stored_one_after_the_other(dataset, tmp_path, monkeypatch):
    _parts_of(monkeypatch, 2)
    folder = tmp_path / "tir"
    put_fleet(folder, range(5), "AB")
    taken = list(
        ingest_in_steps(Store(), folder, difference(folder, Manifest()), step_seconds=0.0, monotonic=float)
    )
    assert len(taken) >= 4
    reported = [len(joined(report)) for _, report in taken]
    assert [len(store.manifest.files) for store, _ in taken] == reported == sorted(set(reported))
    for store, _ in taken:
        assert set(store.table["file"]) == set(store.manifest.files)
        dataset.save(store)
    assert dataset.load().manifest.revision == len(taken)
    once = ingest(Store(), folder, difference(folder, Manifest()))[0]
    assert as_parquet(dataset.load().table) == as_parquet(once.table)
