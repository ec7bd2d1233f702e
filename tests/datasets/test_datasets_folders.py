"""Folders are written whole, and what belongs to the user is never touched."""

import os
import subprocess
import sys

import pytest
from kedro.io import DatasetError

from tire_pipeline.datasets import (
    HtmlPageDataset,
    RecordingFolderDataset,
    TextFolderDataset,
    TirFolderDataset,
)
from tire_pipeline.errors import DomainError
from tire_pipeline.files.added_files import AddedFiles
from tire_pipeline.files.folder_walk import walk


def test_text_folder_round_trip_and_replacement(tmp_path):
    dataset = TextFolderDataset(path=str(tmp_path / "out"), suffix=".tir")
    dataset.save({"A/one.tir": "1", "B/two.tir": b"2"})
    loaded = dataset.load()
    assert loaded == {"A/one.tir": b"1", "B/two.tir": b"2"}
    (tmp_path / "out/B/two.tir").write_bytes(b"3")
    assert loaded["B/two.tir"] == b"3"  # read when it is asked for: all at once may be gigabytes
    dataset.save({"A/three.tir": "3"})
    assert dataset.load() == {"A/three.tir": b"3"}
    assert [p.name for p in tmp_path.iterdir()] == ["out"]


def test_a_folder_that_nothing_was_written_into_is_empty(tmp_path):
    dataset = TextFolderDataset(path=str(tmp_path / "out"), suffix=".tir")
    assert dataset.empty
    dataset.save({"A/one.tir": "1"})
    assert not dataset.empty
    dataset.save({})
    assert dataset.empty


def test_files_of_the_user_are_never_replaced(tmp_path):
    mine = tmp_path / "out" / "A" / "mine.tir"
    mine.parent.mkdir(parents=True)
    mine.write_text("mine")
    with pytest.raises(DatasetError, match="not made by this project"):
        TextFolderDataset(path=str(tmp_path / "out")).save({"A/mine.tir": "yours"})
    assert mine.read_text() == "mine"


def _link_to_folder(place, elsewhere):
    (elsewhere / "mine.tir").write_text("mine")
    place.symlink_to(elsewhere)


@pytest.mark.parametrize(
    "put",
    [
        pytest.param(_link_to_folder, id="a link to a folder"),
        pytest.param(lambda place, _: place.symlink_to(place), id="a link to itself"),
        pytest.param(lambda place, _: os.mkfifo(place), id="a FIFO"),
    ],
)
def test_what_is_no_file_belongs_to_the_user_too(tmp_path, put):
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "out" / "A").mkdir(parents=True)
    mine = tmp_path / "out" / "A" / "mine"
    put(mine, tmp_path / "elsewhere")
    with pytest.raises(DatasetError, match="not made by this project"):
        TextFolderDataset(path=str(tmp_path / "out")).save({"A/b.tir": "yours"})
    assert os.path.lexists(mine)


def test_folders_that_hold_nothing_are_replaced(tmp_path):
    (tmp_path / "out" / "A" / "empty").mkdir(parents=True)
    (tmp_path / "out" / ".gitkeep").touch()
    dataset = TextFolderDataset(path=str(tmp_path / "out"))
    dataset.save({"A/b.tir": "1"})
    assert dataset.load()["A/b.tir"] == b"1"


@pytest.mark.parametrize("name", ["../escape.tir", "/tmp/escape.tir", "A/../../escape.tir"])
def test_nothing_is_written_outside(tmp_path, name):
    dataset = TextFolderDataset(path=str(tmp_path / "out"))
    dataset.save({"a": "old"})
    with pytest.raises(DatasetError, match="outside"):
        dataset.save({"b": "new", name: "x"})
    assert dataset.load() == {"a": b"old"}


def test_a_failed_write_leaves_the_old_folder(tmp_path):
    dataset = TextFolderDataset(path=str(tmp_path / "out"))
    dataset.save({"a": "old"})
    with pytest.raises(DatasetError, match="encode"):
        dataset.save({"b": "new", "c": None})
    assert dataset.load() == {"a": b"old"}
    assert [p.name for p in tmp_path.iterdir()] == ["out"]


def test_added_texts_stay_beside_earlier_ones_of_any_name(tmp_path):
    """A name with a character that ends a line elsewhere was listed in two pieces, and never taken away."""
    dataset = TextFolderDataset(path=str(tmp_path / "out"))
    odd = "A/two\u2028lines\x85.tir"
    dataset.save({odd: "1", "B/two.tir": "2", "B/three.tir": "3"})
    dataset.save(AddedFiles({"C/four.tir": "4", "B/two.tir": "22", "never/there.tir": None}))
    assert dict(dataset.load()) == {odd: b"1", "B/three.tir": b"3", "B/two.tir": b"22", "C/four.tir": b"4"}
    dataset.save(AddedFiles({odd: None, "B/three.tir": None}))
    assert dict(dataset.load()) == {"B/two.tir": b"22", "C/four.tir": b"4"}
    marker = (tmp_path / "out" / ".made_by_tire_pipeline").read_text(encoding="utf-8")
    assert marker.split("\n")[1:] == ["B/two.tir", "C/four.tir", ""]


@pytest.mark.parametrize("links", [True, False])
def test_a_failed_write_beside_earlier_texts_leaves_each_as_it_was(tmp_path, monkeypatch, links):
    def refused(*_):
        raise PermissionError("this file system has no hard links")

    if not links:
        monkeypatch.setattr(os, "link", refused)
    out = tmp_path / "out"
    dataset = TextFolderDataset(path=str(out), keep=True)
    dataset.save({"changed": "old", "kept": "old"})
    (out / "README.md").write_text("of the user")
    (out / "link").symlink_to("kept")
    before = (out / "kept").stat().st_ino
    marker = (out / ".made_by_tire_pipeline").read_bytes()

    def failing():
        raise OSError("no more")

    with pytest.raises(DatasetError, match="no more"):
        dataset.save({"changed": "new", "added": "new", "fails": failing})
    assert {p.name: p.read_text() for p in out.iterdir() if p.name[0] != "."} == {
        "changed": "old",
        "kept": "old",
        "link": "old",
        "README.md": "of the user",
    }
    assert (out / ".made_by_tire_pipeline").read_bytes() == marker
    dataset.save({"changed": "new"})
    assert (out / "changed").read_text() == "new"
    assert (out / "README.md").read_text() == "of the user"
    assert ((out / "kept").stat().st_ino == before) is links


MANY = 3_000
SAVE_OF_MANY_NAMES = """
import sys
import tracemalloc
from collections.abc import Mapping
from unittest import mock

from tire_pipeline.datasets import TextFolderDataset


class ManyNames(Mapping):
    # Names of 200 bytes, which are made when they are asked for.
    def __getitem__(self, name):
        return lambda: b""

    def __iter__(self):
        return (f"A/{number:0196d}.tir" for number in range(len(self)))

    def __len__(self):
        return int(sys.argv[2])


shown = "tire_pipeline.datasets.text_files.text_folder.track"
with mock.patch(shown, lambda items, *_, **__: items):  # its display takes more
    dataset = TextFolderDataset(path=sys.argv[1])
    dataset.save({"a": "1"})  # loads what a save imports
    tracemalloc.start()
    dataset.save(ManyNames())
    print(tracemalloc.get_traced_memory()[1])
"""


def test_the_names_of_the_texts_are_not_in_memory_together(tmp_path):
    """In a process of its own: in this one, whatever else is imported or runs meanwhile would count too."""
    command = [sys.executable, "-c", SAVE_OF_MANY_NAMES, str(tmp_path / "out"), str(MANY)]
    most = int(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    assert most < 200 * MANY
    assert sum(1 for _ in (tmp_path / "out" / "A").iterdir()) == MANY


def test_a_failed_page_leaves_the_old_page(tmp_path):
    dataset = HtmlPageDataset(filepath=str(tmp_path / "page.html"))
    dataset.save("old")
    with pytest.raises(DatasetError, match="surrogates"):
        dataset.save("\ud800")
    with pytest.raises(DatasetError, match="surrogates"):
        dataset.save(iter(["new", "\ud800"]))
    assert dataset.load() == "old"
    assert [p.name for p in tmp_path.iterdir()] == ["page.html"]


def test_an_empty_folder_says_what_to_do(tmp_path):
    with pytest.raises(DatasetError, match="make_fleet"):
        TirFolderDataset(path=str(tmp_path)).load()
    assert TirFolderDataset(path=str(tmp_path / "none"), may_be_absent=True).load() == {}


def test_what_is_there_in_place_of_files_is_said(tmp_path):
    """A folder that is not there, a file and a folder of archives had no .tir files "below this folder"."""
    with pytest.raises(
        DatasetError, match=r"/none: there are no \.tir files: there is no such folder -> put"
    ):
        TirFolderDataset(path=str(tmp_path / "none")).load()
    (tmp_path / "fleet.zip").write_bytes(b"PK")
    with pytest.raises(DatasetError, match=r"this is no folder -> name the folder that holds your files; or"):
        TirFolderDataset(path=str(tmp_path / "fleet.zip")).load()
    with pytest.raises(DatasetError, match=r"below this folder -> unpack fleet\.zip; or put files"):
        TirFolderDataset(path=str(tmp_path)).load()
    with pytest.raises(DatasetError, match=r"no recordings below this folder -> unpack fleet\.zip; or put"):
        RecordingFolderDataset(path=str(tmp_path)).load()
    with pytest.raises(DomainError, match="this is no folder -> name the folder"):
        walk(tmp_path / "fleet.zip", lambda name: True)


def test_a_folder_that_is_not_there_is_not_called_closed(tmp_path):
    with pytest.raises(DomainError, match="there is no such folder -> make it"):
        walk(tmp_path / "none", lambda name: True)


def test_files_are_found_in_any_case_and_depth(tmp_path):
    for name in ("A/one.tir", "A/deep/TWO.TIR", "B/.hidden.tir", "B/other.txt"):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("x")
    assert list(TirFolderDataset(path=str(tmp_path)).load()) == ["A/deep/TWO.TIR", "A/one.tir"]


@pytest.mark.skipif(os.name == "nt" or os.geteuid() != 0, reason="needs root to drop rights")
def test_a_folder_without_permission_is_named_and_stops_nothing_else(tmp_path):
    locked = tmp_path / "A"
    locked.mkdir(mode=0o700)
    (locked / "one.tir").write_text("x")
    tmp_path.chmod(0o755)
    for parent in tmp_path.parents:
        if parent.name.startswith(("pytest-", "popen-")):  # popen: pytest-xdist
            parent.chmod(0o755)
    code = (
        "import os; from tire_pipeline.datasets import TirFolderDataset;"
        f"os.setuid(65534); files = TirFolderDataset(path={str(tmp_path)!r}).load();"
        "print(list(files)); files['A/']()"
    )
    (tmp_path / "B.tir").write_text("x")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert "['A/', 'B.tir']" in done.stdout
    assert "this folder may not be read (Permission denied)" in done.stderr
    assert str(locked) in done.stderr
