"""What is new is told by content; what still grows waits."""

from __future__ import annotations

import os
import time

import pytest
from retraining_files import put, tir_text

from tire_pipeline.errors import DomainError
from tire_pipeline.retraining import Manifest, Store, difference, ingest, look_at, settled_difference
from tire_pipeline.retraining.scan.folder_difference import check_removed
from tire_pipeline.retraining.scan.places import fingerprint
from tire_pipeline.tasks import Done, in_turn


@pytest.fixture
def known(tmp_path):
    """A folder of two files, and the manifest after both were read."""
    for tire in (1, 2):
        put(tmp_path, f"A/{tire}.tir", tir_text(tire))
    store, _ = ingest(Store(), tmp_path, difference(tmp_path, Manifest()))
    return tmp_path, store.manifest


def test_nothing_new_reads_nothing(known, monkeypatch):
    folder, manifest = known
    monkeypatch.setattr(
        "tire_pipeline.retraining.scan.places.fingerprint", lambda path: pytest.fail("was read")
    )
    assert not difference(folder, manifest)


def test_an_early_name_is_seen_as_new(known):
    folder, manifest = known
    put(folder, "A/0.tir", tir_text(0))
    assert set(difference(folder, manifest).added) == {"A/0.tir"}


def test_changed_content_under_the_same_name_size_and_date_is_seen(known):
    folder, manifest = known
    path = folder / "A/1.tir"
    stat = path.stat()
    text = path.read_text().replace("FNOMIN = 4000", "FNOMIN = 5000")
    path.write_text(text)
    os.utime(path, ns=(stat.st_atime_ns, stat.st_mtime_ns))
    assert path.stat().st_size == stat.st_size
    assert set(difference(folder, manifest).changed) == {"A/1.tir"}


def test_another_date_alone_is_no_change(known):
    folder, manifest = known
    os.utime(folder / "A/1.tir", (1e9, 1e9))
    found = difference(folder, manifest)
    assert not found
    assert set(found.touched) == {"A/1.tir"}


def test_a_new_sidecar_is_a_change(known):
    folder, manifest = known
    put(folder, "A/1.tir.sidecar.json", "{}")
    assert set(difference(folder, manifest).changed) == {"A/1.tir"}


def test_removed_and_hidden_files(known):
    folder, manifest = known
    (folder / "A/1.tir").unlink()
    put(folder, "A/.hidden.tir", tir_text(3))
    put(folder, ".git/x.tir", tir_text(3))
    found = difference(folder, manifest)
    assert found.removed == ["A/1.tir"]
    assert not found.added


def test_a_file_that_grows_waits(known):
    folder, manifest = known
    put(folder, "A/3.tir", tir_text(3), age=2.0)
    now = (folder / "A/3.tir").stat().st_mtime
    early = difference(folder, manifest, settle_seconds=5.0, now=now + 4.9)
    assert (early.growing, dict(early.added)) == (["A/3.tir"], {})
    assert not early
    assert set(difference(folder, manifest, settle_seconds=5.0, now=now + 5.0).added) == {"A/3.tir"}


def test_a_date_in_the_future_does_not_wait_for_ever(known):
    folder, manifest = known
    put(folder, "A/3.tir", tir_text(3), age=-1e6)
    assert set(difference(folder, manifest, settle_seconds=5.0).added) == {"A/3.tir"}


def test_a_run_waits_until_files_have_settled(known):
    folder, manifest = known
    path = put(folder, "A/3.tir", "half", age=0.0)
    naps = []

    def grow(seconds: float) -> None:
        naps.append(seconds)
        fresh = len(naps) < 3
        put(folder, "A/3.tir", tir_text(3)[: len(naps) * 50] if fresh else tir_text(3), age=0 if fresh else 9)

    found = settled_difference(folder, manifest, settle_seconds=5.0, most_wait_seconds=60.0, sleep=grow)
    assert naps == [5.0, 5.0, 5.0]
    assert found.added["A/3.tir"][1] == fingerprint(path)
    assert path.read_text() == tir_text(3)


def test_nothing_is_hashed_before_the_waiting_is_over(known):
    folder, manifest = known
    put(folder, "A/3.tir", tir_text(3))
    put(folder, "A/4.tir", tir_text(4), age=0.0)
    hashed = []

    def work(tasks, what):
        hashed.append([name for task in tasks.values() for name in task.names])
        return in_turn(tasks, what)

    found = settled_difference(
        folder, manifest, settle_seconds=5.0, most_wait_seconds=60.0, sleep=lambda seconds: None, work=work
    )
    assert hashed == [["A/3.tir", "A/4.tir"]]
    assert set(found.added) == {"A/3.tir", "A/4.tir"}


def test_a_worker_that_does_not_see_the_folder_hides_no_file(known):
    folder, manifest = known
    put(folder, "A/3.tir", tir_text(3))

    def elsewhere(tasks, what):
        return (Done(name, dict.fromkeys(task.names, "")) for name, task in tasks.items())

    assert difference(folder, manifest, work=elsewhere).added == difference(folder, manifest).added != {}


def test_a_run_does_not_wait_longer_than_asked(known):
    folder, manifest = known
    naps = []

    def grow(seconds: float) -> None:
        naps.append(seconds)
        put(folder, "A/3.tir", tir_text(3)[: 50 * len(naps)], age=0.0)

    grow(0.0)
    found = settled_difference(folder, manifest, settle_seconds=5.0, most_wait_seconds=12.0, sleep=grow)
    assert naps == [0.0, 5.0, 5.0, 2.0]
    assert found.growing == ["A/3.tir"]


def test_the_key_depends_on_contents_only(known):
    folder, manifest = known
    put(folder, "A/3.tir", tir_text(3))
    first = difference(folder, manifest).key
    put(folder, "A/3.tir", tir_text(3), age=99.0)
    assert difference(folder, manifest).key == first
    put(folder, "A/3.tir", tir_text(4))
    assert difference(folder, manifest).key != first


def test_a_vanished_folder_stops_the_run(known):
    folder, manifest = known
    for path in folder.rglob("*.tir"):
        path.unlink()
    found = difference(folder, manifest)
    with pytest.raises(DomainError, match="2 of 2 files are gone"):
        check_removed(found, manifest, 0.5, str(folder))
    check_removed(found, manifest, 1.0, str(folder))


def test_links_and_depth(tmp_path):
    put(tmp_path / "store", "deep/er/T.TIR", tir_text(1))
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder/A").symlink_to(tmp_path / "store")
    assert list(look_at(tmp_path / "folder")) == ["A/deep/er/T.TIR"]
    assert time.time() - look_at(tmp_path / "folder")["A/deep/er/T.TIR"].mtime_ns / 1e9 > 1000
