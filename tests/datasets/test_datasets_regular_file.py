"""One place says whether a path is a regular file, in the same words for recordings and for their tires."""

from __future__ import annotations

import os

import pytest

from tire_pipeline.datasets.users_files.recording_folder import read_pair
from tire_pipeline.errors import RecordingError
from tire_pipeline.files import regular_file
from tire_pipeline.files.regular_file import NotRegularError, no_regular_file, open_regular
from tire_pipeline.recordings import read_recording


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "a").write_text("x")
    (tmp_path / "below").mkdir()
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "itself").symlink_to("itself")
    (tmp_path / "nowhere").symlink_to("gone")
    (tmp_path / "link").symlink_to("a")
    return tmp_path


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("a", ""),
        ("link", ""),
        ("below", "this is a folder"),
        ("pipe", "this is a FIFO, not a regular file"),
        ("itself", "a link that leads to itself"),
        ("nowhere", "no such file"),
        ("a/b", "no such file"),
        ("a\0b", "no such file"),
    ],
)
def test_what_is_no_file_is_said_by_kind_and_a_recording_says_the_same(folder, name, said):
    assert no_regular_file(folder / name) == said
    if said:
        with pytest.raises(RecordingError, match=said):
            read_recording(folder / name)
    if "regular" in said:
        with pytest.raises(NotRegularError):
            open_regular(folder / name)


def test_what_may_not_be_looked_at_may_be_a_file(folder, monkeypatch):
    """Beside a recording it counts as a model: which of two is meant cannot be told."""
    (folder / "run.csv").write_text("time,slip_angle,normal_load,fy\n0,0.1,4000,9\n1,0.2,4000,10\n")
    for name in ("pipe.tir", "itself.tir"):
        (folder / name).symlink_to(name.removesuffix(".tir"))
    (folder / "one.tir").write_text("x")
    (folder / "closed.tir").write_text("x")
    look = os.stat

    def closed(path, *given, **named):
        if os.fspath(path).endswith("closed.tir"):
            raise PermissionError(13, "Permission denied", path)
        return look(path, *given, **named)

    monkeypatch.setattr(regular_file.os, "stat", closed)
    with pytest.raises(PermissionError):
        no_regular_file(folder / "closed.tir")
    with pytest.raises(RecordingError, match=r"2 \.tir files could belong"):
        read_pair(folder / "run.csv")
