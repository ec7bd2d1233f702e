"""What cannot be read, by rights or by a fault of the reader: told, and nothing else is stopped."""

from __future__ import annotations

import os
from functools import partial

import pytest
from no_rights_of_root import rights
from retraining_files import put, tir_text, update_store

from tire_pipeline.classifiers.suppliers import KnownSuppliers
from tire_pipeline.errors import DomainError, TirError
from tire_pipeline.retraining import Store, difference, ingest, look_at
from tire_pipeline.tir import read_tir
from tire_pipeline.tire_table.read_files import read_files
from tire_pipeline.translation.files.translated_block import Given, Sources

root = pytest.mark.skipif(os.geteuid() != 0, reason="needs root to drop rights")


def _fails_on(name, error):
    """Reads every file but one, as long as its error is there."""

    def read(path):
        if str(path).endswith(name) and error:
            raise error[0]
        return read_tir(path)

    return read


def _input_output_error():
    wrapped = TirError("cannot be read: Input/output error", path="1.tir")
    wrapped.__cause__ = OSError(5, "Input/output error")
    return wrapped


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (TypeError("a slip"), "a fault of this program (TypeError: a slip)"),
        (_input_output_error(), "Input/output"),
    ],
)
def test_a_reader_that_fails_on_one_file_stops_nothing_and_is_asked_again(folder, error, said):
    failing = [error]
    read = _fails_on("1.tir", failing)

    def update(store):
        found = difference(folder, store.manifest, settle_seconds=0.0)
        store, report = ingest(store, folder, found, read=read)
        return store, dict(
            zip(report["file"], zip(report["status"], report["reason"], strict=True), strict=True)
        )

    store, told = update(Store())
    status, reason = told["A/1.tir"]
    assert status == "pending"
    assert said in reason
    assert store.table["file"].tolist() == ["B/2.tir"]
    assert update(store)[1]["A/1.tir"] == (status, reason)
    loads = {name: partial(read, folder / name) for name in ("A/1.tir", "B/2.tir")}
    (block,) = read_files(loads).values()
    part = block()
    assert said in part.failures["A/1.tir"]
    assert part.passing  # the stored part does not count for the next run
    sources = Sources.read(loads, Given(None, KnownSuppliers(("A", "B")), 4000.0, 3.0))
    assert list(sources.models) == ["B/2.tir"]
    assert said in sources.unreadable[0]["reason"]
    assert sources.passing
    failing.clear()
    assert update(store)[0].table["file"].tolist() == ["A/1.tir", "B/2.tir"]


def _as_nobody(work) -> None:
    """Run in a child that has no rights of root."""
    child = os.fork()
    if child == 0:
        try:
            os.setgroups([])
            os.setgid(65534)
            os.setuid(65534)
            work()
            os._exit(0)
        except BaseException:
            import traceback

            traceback.print_exc()
        os._exit(1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


@pytest.fixture
def readable(tmp_path):
    """All folders above may be entered by everybody."""
    for parent in [tmp_path, *tmp_path.parents][:-2]:
        parent.chmod(parent.stat().st_mode | 0o055)


@root
def test_what_lies_in_a_folder_without_permission_is_told_and_not_lost(folder, readable):
    put(folder, "A/secret/3.tir", tir_text(3, "A"))
    put(folder, "B/4.tir", tir_text(4, "B"))
    store, _, _ = update_store(folder)
    assert len(store.table) == 4
    (folder / "A/secret").chmod(0)
    (folder / "B/4.tir").chmod(0)
    put(folder, "B/5.tir", tir_text(5, "B"))

    def look():
        after, status, reason = update_store(folder, store)
        assert after.table["file"].tolist() == ["A/1.tir", "A/secret/3.tir", "B/2.tir", "B/4.tir", "B/5.tir"]
        assert reason["A/secret/"] == "this folder may not be read (Permission denied)"
        assert status["B/4.tir"] == "pending"
        assert "an earlier reading stays" in reason["B/4.tir"]
        os.setuid(65534)

    _as_nobody(look)
    (folder / "A/secret").chmod(0o755)
    (folder / "A/secret/3.tir").unlink()
    assert update_store(folder, store)[1]["A/secret/3.tir"] == "removed"


@root
def test_a_folder_that_may_be_listed_but_not_entered_is_told(folder, readable):
    store, _, _ = update_store(folder)
    (folder / "A").chmod(0o744)

    def look():
        after, _, reason = update_store(folder, store)
        assert len(after.table) == 2
        assert reason["A/1.tir"] == "cannot be looked at (Permission denied)"

    _as_nobody(look)


def test_what_links_reach_in_a_folder_that_may_only_be_entered_is_no_other_file(folder):
    put(folder, "B/inner/3.tir", tir_text(3, "B"))
    put(folder, "B/inner/deep/4.tir", tir_text(4, "B"))
    store, _, _ = update_store(folder)
    names = ["A/1.tir", "B/2.tir", "B/inner/3.tir", "B/inner/deep/4.tir"]
    (folder / "A/link.tir").symlink_to(folder / "B/inner/3.tir")
    (folder / "A/link").symlink_to(folder / "B/inner/deep")
    (folder / "B/inner").chmod(0o111)
    put(folder, "B/inner/3.tir", tir_text(5, "B"))
    with rights(of_root=False):
        after, status, reason = update_store(folder, store)
    (folder / "B/inner").chmod(0o755)
    assert after.table["file"].tolist() == names
    assert status["B/inner/3.tir"] == "read"  # as it is now
    assert reason["A/link.tir"] == "a link to B/inner/3.tir"
    assert reason["A/link"] == "a link to B/inner/deep/"
    assert reason["B/inner/"] == "this folder may not be read (Permission denied)"
    again, status, _ = update_store(folder, after)
    assert again.table["file"].tolist() == names
    assert "read" not in status.values()


@root
def test_the_folder_itself_without_permission_is_an_error(folder, readable):
    folder.chmod(0)

    def look():
        with pytest.raises(DomainError, match="may not be read"):
            look_at(folder)

    _as_nobody(look)
    folder.chmod(0o755)
