"""Links, FIFOs, sockets and devices in the folder: told, taken once or never opened."""

from __future__ import annotations

import os
import socket
from types import SimpleNamespace

import pytest
from retraining_files import ingest_all, put, tir_text, update_store

from tire_pipeline.datasets import TirFolderDataset
from tire_pipeline.errors import DomainError, TirError
from tire_pipeline.files.folder_walk import walk
from tire_pipeline.files.regular_file import NotRegularError, open_regular
from tire_pipeline.retraining import look_at
from tire_pipeline.retraining.scan.places import UNREADABLE, fingerprint
from tire_pipeline.tir import read_tir
from tire_pipeline.tire_table.read_files import IngestParameters


def test_a_link_to_itself_is_told_and_stops_nothing(folder):
    (folder / "A/loop.tir").symlink_to("loop.tir")
    (folder / "loop").symlink_to("loop")
    (folder / "A/nowhere.tir").symlink_to("absent.tir")
    store, status, reason = update_store(folder)
    assert store.table["file"].tolist() == ["A/1.tir", "B/2.tir"]
    assert reason["A/loop.tir"] == reason["loop"] == "a link that leads to itself"
    assert reason["A/nowhere.tir"] == "a link that leads nowhere"
    assert status["A/loop.tir"] == "set aside"


def test_a_link_to_the_folder_itself_or_above_takes_nothing_twice(folder):
    (folder / "again").symlink_to(folder)
    (folder / "A/up").symlink_to("../..")
    (folder / "A/side").symlink_to("../B")
    (folder / "B/same.tir").symlink_to("../A/1.tir")
    store, status, reason = update_store(folder)
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


def test_a_link_that_brings_in_more_that_is_no_tire_file_than_there_are_files_stops_nothing(folder, tmp_path):
    """A project's folder, a home or /proc: links that lead nowhere, and none is called .tir."""
    (tmp_path / "project").mkdir()
    for number in range(50):
        (tmp_path / f"project/tool{number}").symlink_to("absent")
        (tmp_path / f"project/all{number}").symlink_to(folder)
    (folder / "B/project").symlink_to(tmp_path / "project")
    partitions = TirFolderDataset(path=str(folder)).load()
    _, report, summary = ingest_all(partitions, IngestParameters())
    assert (summary["read"], summary["set_aside"]) == (2, 50)
    assert (report["status"] == "set aside").sum() == 50
    for name in ("1.tir", "3.tir", "4.tir"):
        put(folder, f"A/{name}", "no tire")
    with pytest.raises(DomainError, match=r"3 of 4 files cannot be read; the first: A/1\.tir"):
        ingest_all(TirFolderDataset(path=str(folder)).load(), IngestParameters())


def test_links_to_what_is_taken_are_named_in_the_log_up_to_twenty(folder, caplog):
    for number in range(25):
        (folder / f"again{number}").symlink_to(folder)
    with caplog.at_level("INFO"):
        TirFolderDataset(path=str(folder)).load()
    said = [record.getMessage() for record in caplog.records]
    assert sum("taken already." in line for line in said) == 21
    assert said[-1] == "5 more links lead to what is taken already."


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
        store, status, reason = update_store(folder)
        partitions = TirFolderDataset(path=str(folder)).load()
        _, report, summary = ingest_all(partitions, IngestParameters(most_failed_share=1.0))
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
