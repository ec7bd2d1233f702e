"""Retraining from a bucket and to it: the same store and model as from a folder, whatever is killed."""

from __future__ import annotations

import sys
import warnings
from pathlib import Path

import pandas as pd
import pytest
from kedro.io import DatasetError

from tire_pipeline.datasets import FolderDataset, IngestStoreDataset, ReleaseDataset
from tire_pipeline.files.objects import Objects, UnreachableError
from tire_pipeline.retraining import Manifest, Store, difference, ingest
from tire_pipeline.tir.sidecar import write_sidecar

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "retraining"))
from changing_data import (
    PARAMETERS,
    SHAPE,
    DedupeFilterParameters,
    RepresentParameters,
    keep_usable,
    nodes,
    restore_previous,
    to_one_nominal_load,
)
from retraining_files import put, put_fleet, tir_text


@pytest.fixture
def folder(bucket):
    return Objects(f"{bucket}/tir")


def _both(folder: Objects, local: Path, name: str, content: str) -> None:
    put(local, name, content)
    folder.write(name, content.encode())


def _update(place, store):
    store, report = ingest(store, place, difference(place, store.manifest, settle_seconds=0.0))
    return store, dict(zip(report["file"], report["status"], strict=True))


def test_a_bucket_gives_the_same_store_as_a_folder(folder, tmp_path):
    local = tmp_path / "tir"
    for number in range(4):
        _both(folder, local, f"{'AB'[number % 2]}/{number}.tir", tir_text(number))
    _both(folder, local, "A/bad.tir", "no tire")
    _both(folder, local, "A/empty.tir", "")
    _both(folder, local, "A/odd\tname.TIR", tir_text(7))
    _both(folder, local, "B/.hidden/8.tir", tir_text(8))
    write_sidecar(local / "A/0.tir", {"wear": {"rate": 1e-9}})
    folder.write("A/0.tir.sidecar.json", (local / "A/0.tir.sidecar.json").read_bytes())
    here, said = _update(local, Store())
    there, said_there = _update(folder, Store())
    pd.testing.assert_frame_equal(there.table, here.table)
    assert said_there == said
    assert said[r"A/odd\x09name.TIR"] == "read"
    assert there.manifest.digest == here.manifest.digest
    kept, _ = Manifest.from_json(there.manifest.to_json())
    assert not difference(folder, kept)

    _both(folder, local, "A/bad.tir", tir_text(9))
    _both(folder, local, "B/1.tir", tir_text(10))
    (local / "B/3.tir").unlink()
    folder.delete(["B/3.tir"])
    there, said = _update(folder, Store(kept, there.partition))
    assert said == {"A/bad.tir": "read", "A/empty.tir": "pending", "B/1.tir": "read", "B/3.tir": "removed"}
    here, _ = _update(local, here)
    pd.testing.assert_frame_equal(there.table, here.table)
    assert there.manifest.digest == here.manifest.digest


def test_an_object_that_is_replaced_while_it_is_read_waits_for_the_next_run(folder):
    folder.write("A/1.tir", tir_text(1).encode())
    folder.write("A/2.tir", tir_text(2).encode())
    found = difference(folder, Manifest())
    folder.write("A/2.tir", tir_text(3).encode())
    store, report = ingest(Store(), folder, found)
    assert report["status"].tolist() == ["read", "growing"]
    assert _update(folder, store)[0].table["file"].tolist() == ["A/1.tir", "A/2.tir"]


def test_an_object_that_may_not_be_read_stops_nothing_and_is_read_when_it_may(folder, monkeypatch):
    for number in (1, 2):
        folder.write(f"A/{number}.tir", tir_text(number).encode())
    read_many = Objects.read_many

    def denied(self, names, most):
        found = read_many(self, names, most)
        return {n: PermissionError("Forbidden") if n == "A/2.tir" else c for n, c in found.items()}

    monkeypatch.setattr(Objects, "read_many", denied)
    store, said = _update(folder, Store())
    assert said == {"A/1.tir": "read", "A/2.tir": "pending"}
    assert not difference(folder, store.manifest)
    monkeypatch.undo()
    assert _update(folder, store)[1] == {"A/2.tir": "read"}


def test_a_store_that_does_not_answer_ends_the_reading_and_blames_no_file(folder, monkeypatch):
    folder.write("A/1.tir", tir_text(1).encode())
    found = difference(folder, Manifest())

    import s3fs

    monkeypatch.setenv("AWS_ENDPOINT_URL", "http://127.0.0.1:9")  # nothing listens there
    monkeypatch.setenv("AWS_MAX_ATTEMPTS", "1")
    s3fs.S3FileSystem.clear_instance_cache()
    with pytest.raises(UnreachableError, match="environment right"):
        ingest(Store(), Objects(str(folder)), found)
    s3fs.S3FileSystem.clear_instance_cache()


def test_an_empty_address_is_told(folder, bucket):
    with pytest.raises(Exception, match="nothing below this address"):
        FolderDataset(path=str(folder)).load()
    with pytest.raises(Exception, match="no such bucket"):
        FolderDataset(path=f"{bucket}-absent/tir").load()


class Shop:
    """The pipeline's own nodes in their order, each result stored where Kedro would store it."""

    def __init__(self, tir: Objects, data: Objects) -> None:
        self.tir = tir
        self.ingested = IngestStoreDataset(path=f"{data}/ingested")
        self.released = ReleaseDataset(path=f"{data}/released")
        self.going_back = ReleaseDataset(path=f"{data}/released", for_going_back=True)

    def retrain(self) -> None:
        for store, _ in nodes.read_new_files(self.ingested.load(), self.tir, PARAMETERS):
            self.ingested.save(store)
        table = nodes.stored_table(self.ingested.load())
        few = DedupeFilterParameters(minimum_per_category=1)
        kept, _ = keep_usable(table, few, RepresentParameters(), "D")
        training, held = nodes.hold_out(to_one_nominal_load(kept, SHAPE[0]), kept, PARAMETERS)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # few tires for the bins
            candidate = nodes.train_candidate(training, *SHAPE)
        registry = self.released.load()
        comparison = nodes.compare(candidate, registry, held, PARAMETERS)
        self.released.save(nodes.decide(candidate, registry, comparison, store, PARAMETERS, *SHAPE)[0])

    def roll_back(self) -> None:
        self.released.save(restore_previous(self.going_back.load()))


class Killed(BaseException):
    """Not an error that anything could catch and mend."""


def _kill_at(monkeypatch, step: int) -> None:
    left = step

    def killing(call):
        def instead(*arguments, **more):
            nonlocal left
            left -= 1
            if left < 0:
                raise Killed
            return call(*arguments, **more)

        return instead

    for name in ("write", "create", "replace"):
        monkeypatch.setattr(Objects, name, killing(getattr(Objects, name)))


def _does_not_answer_for_models(monkeypatch, shop: Shop) -> None:
    """That is no damage of a model, which going back would mend."""
    read = Objects.read

    def failing(self, name, most=None):
        if name.startswith("models/"):
            raise UnreachableError("the object store did not do what was asked", where=name, todo="wait")
        return read(self, name, most)

    with monkeypatch.context() as patched:
        patched.setattr(Objects, "read", failing)
        for dataset in (shop.released, shop.going_back):
            with pytest.raises(DatasetError, match="did not do what was asked") as found:
                dataset.load()
            assert "rollback" not in str(found.value)


def test_a_retraining_killed_before_any_write_loses_nothing(bucket, tmp_path, monkeypatch):
    local = tmp_path / "tir"
    put_fleet(local, range(8))
    tir = Objects(f"{bucket}/tir")
    tir.write_many({str(p.relative_to(local)): p.read_bytes() for p in local.rglob("*.tir")})
    shop = Shop(tir, Objects(f"{bucket}/data"))
    shop.retrain()
    first = shop.released.load().release
    assert first.current is not None
    assert len(shop.ingested.load().table) == 24
    _does_not_answer_for_models(monkeypatch, shop)

    put_fleet(local, range(8, 10))
    new = {str(p.relative_to(local)): p.read_bytes() for p in local.rglob("T000[89].tir")}
    tir.write_many(new)
    stored = False
    for step in (0, 1, 2, 1):  # at the table, the manifest, the model, the record
        with monkeypatch.context() as patched:
            _kill_at(patched, step)
            with pytest.raises(Killed):
                shop.retrain()
        stored = stored or step == 2
        assert len(shop.ingested.load().table) == (30 if stored else 24)
        assert shop.released.load().release == first
    shop.retrain()
    assert len(shop.ingested.load().table) == 30
    second = shop.released.load().release
    assert second.models == (first.current, second.current)
    shop.roll_back()
    assert shop.released.load().release.current == first.current
    assert shop.released.load().model is not None
