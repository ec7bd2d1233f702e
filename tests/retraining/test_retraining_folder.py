"""Whatever lies in the folder: one entry never stops or distorts the rest."""

from __future__ import annotations

import io
import json
import os
import socket
import time
import unicodedata
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st
from retraining_files import put, tir_text

from tire_pipeline.classifiers.suppliers import KnownSuppliers
from tire_pipeline.datasets import RecordingFolderDataset, TextFolderDataset, TirFolderDataset
from tire_pipeline.errors import DomainError, RecordingError, TirError
from tire_pipeline.file_names import name_on_disk, path_of, shown_name
from tire_pipeline.files.folder_walk import walk
from tire_pipeline.files.packed import unpack
from tire_pipeline.files.regular_file import NotRegularError, open_regular
from tire_pipeline.recordings.readers import limits
from tire_pipeline.reporting.explained_recordings import ExplainParameters, explain_each
from tire_pipeline.retraining import Manifest, Store, difference, ingest, look_at, settled_difference
from tire_pipeline.retraining.places import UNREADABLE, fingerprint
from tire_pipeline.tir import read_tir
from tire_pipeline.tire_table.read_files import IngestParameters, join_files, read_files
from tire_pipeline.translation.translated_block import Given, Sources

LATIN = os.fsdecode(b"M\xfcnchen.tir")
root = pytest.mark.skipif(os.geteuid() != 0, reason="needs root to drop rights")


@pytest.fixture
def folder(tmp_path):
    put(tmp_path / "tir", "A/1.tir", tir_text(1, "A"))
    put(tmp_path / "tir", "B/2.tir", tir_text(2, "B"))
    return tmp_path / "tir"


def _update(folder, store=None):
    store = store or Store()
    store, report = ingest(store, folder, difference(folder, store.manifest, settle_seconds=0.0))
    by_file = report.set_index("file")
    return store, by_file["status"].to_dict(), by_file["reason"].to_dict()


def _round_trip(store, report, tmp_path):
    """What the catalog writes."""
    store.table.to_parquet(tmp_path / "table.parquet")
    pd.DataFrame({"file": list(report), "status": list(report.values())}).to_csv(tmp_path / "report.csv")
    return pd.read_parquet(tmp_path / "table.parquet")["file"].tolist()


@given(st.binary(min_size=1).filter(lambda name: b"\0" not in name and b"/" not in name))
def test_every_name_is_shown_as_utf8_and_comes_back(name):
    shown = shown_name(os.fsdecode(name))
    shown.encode()
    assert [c for c in shown if unicodedata.category(c) == "Cc" and c.isascii()] == []
    assert os.fsencode(name_on_disk(shown)) == name


def test_usual_names_stay_as_they_are():
    for name in ("Reifen größer.tir", "a b.tir", r"back\slash.tir", "x41.tir", "轮胎.tir"):
        assert shown_name(name) == name
    assert shown_name(r"a\x41.tir") == r"a\x5cx41.tir"


def test_a_link_to_itself_is_told_and_stops_nothing(folder):
    (folder / "A/loop.tir").symlink_to("loop.tir")
    (folder / "loop").symlink_to("loop")
    (folder / "A/nowhere.tir").symlink_to("absent.tir")
    store, status, reason = _update(folder)
    assert store.table["file"].tolist() == ["A/1.tir", "B/2.tir"]
    assert reason["A/loop.tir"] == reason["loop"] == "a link that leads to itself"
    assert reason["A/nowhere.tir"] == "a link that leads nowhere"
    assert status["A/loop.tir"] == "set aside"


def test_a_link_to_the_folder_itself_or_above_takes_nothing_twice(folder):
    (folder / "again").symlink_to(folder)
    (folder / "A/up").symlink_to("../..")
    (folder / "A/side").symlink_to("../B")
    (folder / "B/same.tir").symlink_to("../A/1.tir")
    store, status, reason = _update(folder)
    assert store.table["file"].tolist() == ["A/1.tir", "B/2.tir"]
    assert reason["again"] == "a link to ./"
    assert reason["A/side"] == "a link to B/"
    assert reason["B/same.tir"] == "a link to A/1.tir"
    assert reason["A/up"] == "a link to a folder above this one"
    assert status["again"] == status["B/same.tir"] == "taken already"
    assert list(TirFolderDataset(path=str(folder)).load()) == ["A/1.tir", "A/up", "B/2.tir"]


def test_what_lies_elsewhere_is_taken_once_by_the_first_link(folder, tmp_path):
    put(tmp_path / "store", "deep/3.tir", tir_text(3))
    put(tmp_path / "other", "4.tir", tir_text(4))
    (folder / "D").symlink_to(tmp_path / "store/deep")  # a part of what C leads to
    (folder / "C").symlink_to(tmp_path / "store")
    (folder / "E").symlink_to(tmp_path / "store")
    (folder / "A/x.tir").symlink_to(tmp_path / "other/4.tir")
    (folder / "A/y.tir").symlink_to(tmp_path / "other/4.tir")
    assert list(look_at(folder)) == ["A/1.tir", "A/x.tir", "B/2.tir", "C/deep/3.tir"]
    assert walk(folder, lambda name: True).again == {"D": "C/deep/", "E": "C/", "A/y.tir": "A/x.tir"}
    (tmp_path / "store/back").symlink_to(folder)  # and from there back again
    assert list(look_at(folder)) == ["A/1.tir", "A/x.tir", "B/2.tir", "C/deep/3.tir"]


def test_a_name_that_is_not_utf8_is_kept_and_shown(folder, tmp_path):
    put(folder, f"A/{LATIN}", tir_text(3, "A"))
    put(folder, "A/bad\n\x1b[31m.tir", "no tire")
    os.mkdir(os.fsencode(folder) + b"/\xe4")
    put(folder / os.fsdecode(b"\xe4"), "5.tir", tir_text(5))
    put(folder, os.fsdecode(b"A/\xff.tir"), "no tire")
    store, status, reason = _update(folder)
    expected = ["A/1.tir", r"A/M\xfcnchen.tir", "B/2.tir", r"\xe4/5.tir"]
    assert _round_trip(store, reason, tmp_path) == expected
    assert status[r"A/bad\x0a\x1b[31m.tir"] == status[r"A/\xff.tir"] == "pending"
    assert path_of(folder, r"A/M\xfcnchen.tir") == folder / "A" / LATIN
    again, _ = Manifest.from_json(store.manifest.to_json())
    assert not difference(folder, again)
    partitions = TirFolderDataset(path=str(folder)).load()
    table, report, _ = _ingest(partitions, IngestParameters())
    table.frame().to_parquet(tmp_path / "raw.parquet")
    report.to_csv(tmp_path / "ingest.csv")
    assert table.frame()["file"].tolist() == expected
    assert report["file"].str.contains("xff").sum() == 1


def test_a_name_with_a_line_break_forges_no_line(folder):
    name = "a\nerror: all is lost\x1b[31m.tir"
    (folder / name).write_text("no tire")
    with pytest.raises(TirError) as raised:
        read_tir(folder / name)
    assert "\n" not in str(raised.value)
    assert "a\\x0aerror: all is lost\\x1b[31m.tir" in str(raised.value)
    _, report = ingest(Store(), folder, difference(folder, Manifest(), settle_seconds=0))
    (row,) = report[report["file"].str.contains("lost")].to_dict("records")
    assert "\n" not in row["file"] + row["reason"]


def test_fifos_sockets_and_devices_are_told_and_never_opened(folder, tmp_path):
    os.mkfifo(folder / "A/pipe.tir")
    os.mkfifo(folder / "A/1.tir.sidecar.json")
    os.mkfifo(tmp_path / "pipe")
    (folder / "A/link.tir").symlink_to(tmp_path / "pipe")
    (folder / "A/zero.tir").symlink_to("/dev/zero")
    with socket.socket(socket.AF_UNIX) as server:
        here = os.getcwd()
        os.chdir(folder)  # a socket's path must be short
        try:
            server.bind("s.tir")
        finally:
            os.chdir(here)
        store, status, reason = _update(folder)
        partitions = TirFolderDataset(path=str(folder)).load()
        _, report, summary = _ingest(partitions, IngestParameters(most_failed_share=1.0))
    assert store.table["file"].tolist() == ["B/2.tir"]
    assert reason["A/pipe.tir"] == reason["A/link.tir"] == "a FIFO, not a regular file"
    assert reason["A/zero.tir"] == "a device, not a regular file"
    assert reason["s.tir"] == "a socket, not a regular file"
    assert status["A/1.tir"] == "pending"  # its sidecar cannot be read
    assert "sidecar" in reason["A/1.tir"]
    assert summary["set_aside"] == 5
    assert report.set_index("file")["reason"]["A/pipe.tir"].endswith(
        "a FIFO, not a regular file -> take it out, or put a .tir file there"
    )


def test_a_fifo_that_takes_a_files_place_while_it_is_hashed_does_not_block(tmp_path):
    os.mkfifo(tmp_path / "late.tir")
    assert fingerprint(tmp_path / "late.tir").startswith(UNREADABLE)


def test_a_regular_file_that_has_nothing_to_read_now_is_told(folder, monkeypatch):
    """The kernel's log is such a file; here a FIFO with a writer that writes nothing passes for one."""
    os.mkfifo(folder / "A/log.tir")
    os.mkfifo(folder / "B/2.tir.sidecar.json")
    writers = [os.open(path, os.O_RDWR) for path in (folder / "A/log.tir", folder / "B/2.tir.sidecar.json")]
    monkeypatch.setattr("tire_pipeline.files.regular_file.stat", SimpleNamespace(S_ISREG=lambda mode: True))
    try:
        for path in (folder / "A/log.tir", folder / "B/2.tir"):
            with pytest.raises(TirError, match="is not a regular file"):
                read_tir(path)
        with open_regular(folder / "A/log.tir") as stream, pytest.raises(NotRegularError):
            stream.read()
    finally:
        for writer in writers:
            os.close(writer)


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


def test_a_recording_that_a_reader_fails_on_stops_no_other():
    def load(**_how):
        raise TypeError("a slip")

    (task,) = explain_each({"rig/run.csv": load}, ExplainParameters()).values()
    row = json.loads(unpack(task())["row.json"])
    assert "a fault of this program (TypeError: a slip)" in row["problem"]


def _ingest(partitions, parameters):
    return join_files(read_files(partitions), parameters)


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
    store, _, _ = _update(folder)
    assert len(store.table) == 4
    (folder / "A/secret").chmod(0)
    (folder / "B/4.tir").chmod(0)
    put(folder, "B/5.tir", tir_text(5, "B"))

    def look():
        after, status, reason = _update(folder, store)
        assert after.table["file"].tolist() == ["A/1.tir", "A/secret/3.tir", "B/2.tir", "B/4.tir", "B/5.tir"]
        assert reason["A/secret/"] == "this folder may not be read (Permission denied)"
        assert status["B/4.tir"] == "pending"
        assert "an earlier reading stays" in reason["B/4.tir"]
        os.setuid(65534)

    _as_nobody(look)
    (folder / "A/secret").chmod(0o755)
    (folder / "A/secret/3.tir").unlink()
    assert _update(folder, store)[1]["A/secret/3.tir"] == "removed"


@root
def test_a_folder_that_may_be_listed_but_not_entered_is_told(folder, readable):
    store, _, _ = _update(folder)
    (folder / "A").chmod(0o744)

    def look():
        after, _, reason = _update(folder, store)
        assert len(after.table) == 2
        assert reason["A/1.tir"] == "cannot be looked at (Permission denied)"

    _as_nobody(look)


@root
def test_the_folder_itself_without_permission_is_an_error(folder, readable):
    folder.chmod(0)

    def look():
        with pytest.raises(DomainError, match="may not be read"):
            look_at(folder)

    _as_nobody(look)
    folder.chmod(0o755)


def test_names_of_255_bytes_are_read_and_their_results_can_be_written(folder, tmp_path):
    long = "x" * 251 + ".tir"
    odd = os.fsdecode(b"\xfc" * 251 + b".tir")
    for name in (long, odd):
        put(folder, f"A/{name}", tir_text(len(name), "A"))
    store, status, reason = _update(folder)
    assert set(status.values()) == {"read"}, reason
    results = TextFolderDataset(path=str(tmp_path / "out"))
    names = store.table["file"].tolist()
    results.save(dict.fromkeys(names, "text"))
    written = results.load()
    assert len(written) == len(names)
    assert f"A/{long}" in written
    assert all(name.endswith(".tir") for name in written)


@pytest.mark.slow
def test_ten_thousand_folders_and_as_deep_as_a_path_goes(tmp_path):
    for number in range(10_000):
        (tmp_path / f"{number % 100}/{number}").mkdir(parents=True)
    put(tmp_path, "99/9999/1.tir", tir_text(1))
    deep = tmp_path
    here = os.getcwd()
    try:
        os.chdir(deep)
        for _ in range(3000):  # deeper than a path can be long, and than Python calls itself
            os.mkdir("d")
            os.chdir("d")
    finally:
        os.chdir(here)
    _, status, reason = _update(tmp_path)
    assert status.pop("99/9999/1.tir") == "read"
    (told,) = status
    assert "File name too long" in reason[told]
    _remove_deep(tmp_path)


def _remove_deep(folder: Path) -> None:
    """What shutil cannot remove, for it calls itself for each folder."""
    here = os.getcwd()
    try:
        os.chdir(folder)
        for _ in range(3000):
            os.chdir("d")
        for _ in range(3000):
            os.chdir("..")
            os.rmdir("d")
    finally:
        os.chdir(here)


def test_a_file_that_never_stops_growing_ends_the_reading(folder, monkeypatch):
    path = put(folder, "A/1.tir", tir_text(1, "A"))
    taken = []

    def read(file):
        taken.append(file)
        with path.open("a") as stream:
            stream.write("! one more line\n")
        return read_tir(file)

    store, report = ingest(Store(), folder, difference(folder, Manifest(), settle_seconds=0.0), read)
    assert dict(zip(report["file"], report["status"], strict=True))["A/1.tir"] == "growing"
    assert "A/1.tir" not in set(store.table["file"])
    huge = folder / "A/huge.tir"
    with huge.open("wb") as stream:
        stream.truncate(1 << 40)  # a terabyte that takes no room
    assert _update(folder)[1]["A/huge.tir"] == "pending"


def test_clocks_that_go_back_neither_keep_a_file_out_nor_let_half_of_one_in(folder):
    text = tir_text(3, "A")
    put(folder, "A/3.tir", text[:200], age=-86400)  # written before the clock went back a day
    naps = []

    def grow(seconds):
        naps.append(seconds)
        if len(naps) <= 3:
            put(folder, "A/3.tir", text if len(naps) == 3 else text[: 200 + len(naps)], age=-86400)

    found = settled_difference(folder, Manifest(), settle_seconds=5.0, most_wait_seconds=60.0, sleep=grow)
    assert "A/3.tir" in found.added
    assert found.added["A/3.tir"][1] == fingerprint(folder / "A/3.tir")
    assert (folder / "A/3.tir").read_text() == text
    assert naps == [5.0] * 4


def test_a_server_whose_clock_is_ahead_keeps_nothing_out(folder):
    put(folder, "A/3.tir", tir_text(3, "A"), age=-86400)
    found = settled_difference(
        folder, Manifest(), settle_seconds=5.0, most_wait_seconds=2.0, sleep=lambda seconds: None
    )
    assert "A/3.tir" in found.added


@pytest.mark.parametrize("date", [0, -86400, 1, 2**33])
def test_dates_of_1970_before_and_far_ahead(folder, date):
    os.utime(folder / "A/1.tir", (date, date))
    store, status, _ = _update(folder)
    assert status["A/1.tir"] == "read"
    again, _ = Manifest.from_json(store.manifest.to_json())
    assert not difference(folder, again)
    put(folder, "A/1.tir", tir_text(9, "A"))
    os.utime(folder / "A/1.tir", (date, date))
    assert set(difference(folder, again, now=time.time() + 60).changed) == {"A/1.tir"}


def test_recordings_too(tmp_path):
    (tmp_path / "a").mkdir()
    (tmp_path / "a/run.csv").write_text("time,slip_angle\n0,0.1\n")
    (tmp_path / "loop").symlink_to(tmp_path)
    (tmp_path / "self.csv").symlink_to("self.csv")
    os.mkfifo(tmp_path / "a/pipe.csv")
    os.mkfifo(tmp_path / "a/pipe.tir")
    (tmp_path / os.fsdecode(b"a/\xe4.csv")).write_text("time,slip_angle\n0,0.1\n")
    found = RecordingFolderDataset(path=str(tmp_path)).load()
    assert list(found) == [r"a/\xe4.csv", "a/pipe.csv", "a/run.csv", "self.csv"]
    with pytest.raises(RecordingError, match="a FIFO, not a regular file"):
        found["a/pipe.csv"]()
    with pytest.raises(RecordingError, match=r"no \.tir file"):
        found["a/run.csv"]()


class Unread(io.BufferedReader):
    def read(self, *_):
        raise AssertionError("it is read")

    readinto = read


def test_a_recording_larger_than_the_memory_is_told_and_not_read(tmp_path, monkeypatch):
    for name in ("a.tdx", "a.tir"):
        with (tmp_path / name).open("wb") as stream:
            stream.truncate(1 << 40)  # a terabyte that takes no room
    (load,) = RecordingFolderDataset(path=str(tmp_path)).load().values()
    module = "tire_pipeline.datasets.users_files.recording_folder.open_regular"
    monkeypatch.setattr(module, lambda path: Unread(io.FileIO(path)))
    before = load.fingerprint()
    assert load.fingerprint() == before
    with pytest.raises(RecordingError, match=r"1024\.0 GiB, too many for the memory"):
        load()
    os.truncate(tmp_path / "a.tdx", (1 << 40) + 1)
    assert load.fingerprint() != before


def test_the_memory_of_a_container_counts(tmp_path, monkeypatch):
    group = tmp_path / "memory.max"
    monkeypatch.setattr(limits, "GROUP_LIMITS", (str(tmp_path / "absent"), str(group)))
    whole = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    for text, most in (("max\n", whole / 2), ("4096\n", 2048.0)):
        group.write_text(text)
        limits.most_bytes.cache_clear()
        assert limits.most_bytes() == most
    limits.most_bytes.cache_clear()
