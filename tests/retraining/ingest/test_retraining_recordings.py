"""A folder of recordings: links, FIFOs, files that are too large and readers that fail stop no other."""

from __future__ import annotations

import io
import json
import os

import pytest

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
