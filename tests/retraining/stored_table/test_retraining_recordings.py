"""A folder of recordings: links, FIFOs, files that are too large and readers that fail stop no other."""

from __future__ import annotations

import io
import json
import os

import pytest
from no_rights_of_root import rights

from tire_pipeline.datasets import RecordingFolderDataset
from tire_pipeline.errors import RecordingError
from tire_pipeline.files.packed import unpack
from tire_pipeline.recordings.readers import limits
from tire_pipeline.reporting.mismatch.explained_recordings import ExplainParameters, explain_each


def test_odd_entries_beside_recordings_are_told(tmp_path):
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


def _explained(tasks, recording):
    (task,) = (each for each in tasks.values() if each.name == recording)
    return json.loads(unpack(task())["row.json"])["problem"]


@pytest.mark.skipif(os.geteuid() != 0, reason="needs root to drop rights")
def test_a_folder_that_may_not_be_listed_or_entered_stops_no_other_recording(tmp_path):
    for folder in ("listed", "entered", "linking", "good"):
        (tmp_path / folder).mkdir()
        for name in ("run.csv", "model.tir"):
            (tmp_path / folder / name).write_text("time,slip_angle\n0,0.1\n")
    (tmp_path / "linking/link.csv").symlink_to("../entered/run.csv")
    (tmp_path / "good/other.tir").symlink_to("../listed/model.tir")
    (tmp_path / "listed").chmod(0o444)
    (tmp_path / "entered").chmod(0o111)
    with rights(of_root=False):
        found = RecordingFolderDataset(path=str(tmp_path)).load()
        tasks = explain_each(found, ExplainParameters())
        assert {"entered/run.csv", "listed/run.csv"} < set(found)
        assert "may not be listed (Permission denied)" in _explained(tasks, "entered/run.csv")
        assert "cannot be accessed (Permission denied)" in _explained(tasks, "listed/run.csv")
        assert "2 .tir files could belong" in _explained(tasks, "good/run.csv")
        assert "model.tir" in _explained(tasks, "linking/run.csv")  # it was read, and is no tire
    for folder in ("listed", "entered"):
        (tmp_path / folder).chmod(0o755)


def test_a_recording_that_a_reader_fails_on_stops_no_other():
    def load(**_how):
        raise TypeError("a slip")

    (task,) = explain_each({"rig/run.csv": load}, ExplainParameters()).values()
    row = json.loads(unpack(task())["row.json"])
    assert "a fault of this program (TypeError: a slip)" in row["problem"]


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
