"""What is computed once is not computed again, and nothing half-written is ever taken for done."""

import time
from functools import partial
from pathlib import Path

import pytest
from kedro.io import DatasetError

from tire_pipeline.code_hash import code_hash
from tire_pipeline.datasets import ComputedFolderDataset, RecordingFolderDataset
from tire_pipeline.errors import DomainError
from tire_pipeline.files.packed import pack, unpack


def _count(folder: Path, name: str) -> bytes:
    with (folder / f"{name}.calls").open("a") as calls:
        calls.write("x")
    return name.encode()


def _fails_once_stored(folder: Path, other: str) -> bytes:
    """Fail when another part is stored: two processes end in any order."""
    for _ in range(6000):
        if (folder / "out" / other).exists():
            raise ValueError("stopped on purpose")
        time.sleep(0.01)
    raise ValueError(f"{other} was not stored while this part was under way")


def _dataset(tmp_path: Path) -> ComputedFolderDataset:
    return ComputedFolderDataset(path=str(tmp_path / "out"))


def test_what_is_there_is_not_computed_again(tmp_path):
    work = {name: partial(_count, tmp_path, name) for name in ("a", "b")}
    _dataset(tmp_path).save(work)
    _dataset(tmp_path).save({**work, "c": partial(_count, tmp_path, "c")})
    assert {n: r() for n, r in _dataset(tmp_path).load().items()} == {"a": b"a", "b": b"b", "c": b"c"}
    assert [(tmp_path / f"{n}.calls").read_text() for n in "abc"] == ["x", "x", "x"]


def test_an_interrupted_computation_goes_on_where_it_stopped(tmp_path):
    first = {"a": partial(_count, tmp_path, "a"), "b": partial(_fails_once_stored, tmp_path, "a")}
    with pytest.raises(DatasetError, match="on purpose"):
        _dataset(tmp_path).save(first)
    assert not _dataset(tmp_path).exists()
    assert (tmp_path / "out" / "a").read_bytes() == b"a"
    assert not (tmp_path / "out" / "b").exists()
    _dataset(tmp_path).save({**first, "b": partial(_count, tmp_path, "b")})
    assert (tmp_path / "a.calls").read_text() == "x"


def test_what_is_stored_and_damaged_is_told_by_its_name_and_made_again(tmp_path):
    work = {"deep/a.zip": partial(pack, {"letters": b"abcdefgh" * 99})}
    _dataset(tmp_path).save(work)
    place = tmp_path / "out/deep/a.zip"
    whole = place.read_bytes()
    said = set()
    for position in range(len(whole)):
        place.write_bytes(whole[:position] + bytes([whole[position] ^ 0xFF]) + whole[position + 1 :])
        read = _dataset(tmp_path).load()["deep/a.zip"]
        try:
            assert unpack(read()).popitem()[1] == b"abcdefgh" * 99  # a byte that carries nothing
        except DomainError as error:
            said.add(str(error))
    assert said == {f"{place}: this stored file is damaged -> delete it and run again: it is made again"}
    place.unlink()
    _dataset(tmp_path).save(work)
    assert place.read_bytes() == whole


def test_only_what_was_asked_for_last_is_loaded(tmp_path):
    _dataset(tmp_path).save({"old": partial(_count, tmp_path, "old")})
    _dataset(tmp_path).save({"new": partial(_count, tmp_path, "new")})
    assert list(_dataset(tmp_path).load()) == ["new"]


def test_the_hash_follows_the_source():
    assert code_hash("tir") == code_hash("tir")
    assert code_hash("tir") != code_hash("tir", "magic_formula")


def test_a_recording_needs_one_tire(tmp_path):
    folder = tmp_path / "case"
    folder.mkdir()
    (folder / "recording.csv").write_text(
        "time,slip_angle,normal_load,fy\n0,0.01,4000,10\n0.1,0.02,4000,20\n"
    )
    dataset = RecordingFolderDataset(path=str(tmp_path))
    load = dataset.load()["case/recording.csv"]
    with pytest.raises(Exception, match=r"no \.tir file lies beside"):
        load()


def test_an_empty_folder_of_recordings_says_what_to_do(tmp_path):
    with pytest.raises(DatasetError, match="no recordings below"):
        RecordingFolderDataset(path=str(tmp_path)).load()
