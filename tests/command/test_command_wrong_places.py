"""``tire`` on files that are archives, folders or in the wrong order, and where it cannot write."""

from __future__ import annotations

import errno
import gzip
import json
import os
import zipfile
from pathlib import Path

import pytest
from command_line import record, run

from tire_pipeline.files import atomic

pytestmark = pytest.mark.slow


@pytest.fixture
def full_disk(monkeypatch):
    """The system does not say into which file it cannot write."""

    def refuse(*_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(atomic.Path, "write_bytes", refuse)


def test_a_page_that_does_not_fit_on_the_disk_costs_no_result_and_is_named(folder, full_disk):
    """It was a traceback, and what had been computed was gone."""
    done = run("show", "a.tir", "-o", "page.html", code=2)
    assert "Magic Formula 5.2" in done.stdout
    assert "written" not in done.stdout
    assert done.stderr.endswith("error: page.html: the disk is full: make room, then run again\n")
    done = run("show", "a.tir", "-o", "page.html", "--json", code=2)
    assert json.loads(done.stdout)["written"] == []


def test_a_file_that_does_not_fit_on_the_disk_is_named(folder, full_disk):
    error = run("convert", "a.tir", "--to", "6.1", "-o", "b.tir", code=2).stderr
    assert error.endswith("error: b.tir: the disk is full: make room, then run again\n")
    assert sorted(each.name for each in Path().glob("*.part")) == []


def test_a_folder_is_no_target(folder):
    """With --overwrite the name of a temporary file was told."""
    for name in ("b.tir", "page.html"):
        Path(name).mkdir()
    error = run("convert", "a.tir", "--to", "6.1", "-o", "b.tir", "--overwrite", code=2).stderr
    assert error.endswith("error: b.tir: this is a folder -> choose another -o\n")
    error = run("show", "a.tir", "-o", "page.html", code=2).stderr
    assert error.endswith("error: page.html: this is a folder: choose another name\n")


@pytest.mark.parametrize("kind", ["zip", "gz"])
def test_an_archive_is_to_be_unpacked(folder, kind):
    name = f"a.{kind}"
    if kind == "zip":
        with zipfile.ZipFile(name, "w") as archive:
            archive.write("a.tir")
    else:
        Path(name).write_bytes(gzip.compress(Path("a.tir").read_bytes()))
    what = "a ZIP archive" if kind == "zip" else "compressed by gzip"
    assert f"it is {what} -> unpack it, and give the .tir file" in run("show", name, code=2).stderr
    assert f"it is {what} -> unpack it, and give the recordings" in run("check", name, code=2).stderr


def test_recording_and_tire_in_the_wrong_order(folder):
    record("run.csv", seconds=2.0)
    error = run("explain", "run.csv", "a.tir", code=2).stderr
    assert error.endswith("error: a.tir: this is no recording -> give the .tir file first\n")


def test_a_file_whose_name_begins_like_an_option(folder):
    record("-run.csv", seconds=2.0)
    assert "No such option '-r'. A file whose name begins with - is given as ./-run.csv" in (
        run("check", "-run.csv", code=2).stderr
    )
    assert "given as" not in run("check", "-other.csv", code=2).stderr
