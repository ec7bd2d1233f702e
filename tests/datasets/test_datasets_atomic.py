"""What is replaced is there whole, as it was or as it is now; nothing else is left behind."""

import errno
import os

import pytest

from tire_pipeline.files.atomic import replaced_file, replaced_folder, write_bytes


def content(folder):
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def test_a_file_is_replaced_and_may_be_read_by_others(tmp_path):
    file = tmp_path / "a"
    write_bytes(file, b"old")
    write_bytes(file, b"new")
    assert content(tmp_path) == {"a": b"new"}
    assert file.stat().st_mode & 0o777 == 0o644


def test_folders_above_are_made_only_if_asked(tmp_path):
    with replaced_file(tmp_path / "deep/er/a") as temporary:
        temporary.write_bytes(b"x")
    assert content(tmp_path) == {"deep/er/a": b"x"}
    with pytest.raises(FileNotFoundError):
        write_bytes(tmp_path / "absent/a", b"x")
    assert not (tmp_path / "absent").exists()


@pytest.mark.parametrize("call", ["fsync", "replace"])
def test_a_full_disk_leaves_the_old_file(tmp_path, monkeypatch, call):
    write_bytes(tmp_path / "a", b"old")

    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, call, full)
    with pytest.raises(OSError, match="No space"):
        write_bytes(tmp_path / "a", b"new")
    assert content(tmp_path) == {"a": b"old"}


def test_readers_see_the_old_file_until_the_end(tmp_path):
    write_bytes(tmp_path / "a", b"old")
    with replaced_file(tmp_path / "a") as temporary:
        temporary.write_bytes(b"ne")
        assert (tmp_path / "a").read_bytes() == b"old"
        temporary.write_bytes(b"new")
    assert content(tmp_path) == {"a": b"new"}


def test_a_folder_is_replaced_whole(tmp_path):
    for text in (b"1", b"2"):
        with replaced_folder(tmp_path / "made") as temporary:
            (temporary / text.decode()).write_bytes(text)
    assert content(tmp_path) == {"made/2": b"2"}


def test_a_failure_leaves_the_old_folder(tmp_path):
    with replaced_folder(tmp_path / "made") as temporary:
        (temporary / "a").write_bytes(b"old")

    def half():
        with replaced_folder(tmp_path / "made") as temporary:
            (temporary / "a").write_bytes(b"half")
            raise RuntimeError("stopped")

    with pytest.raises(RuntimeError, match="stopped"):
        half()
    assert content(tmp_path) == {"made/a": b"old"}


def test_a_failed_second_renaming_is_undone(tmp_path, monkeypatch):
    with replaced_folder(tmp_path / "made") as temporary:
        (temporary / "a").write_bytes(b"old")
    rename = type(tmp_path).rename

    def stop_at_the_new(self, target):
        if self.suffix == ".part":
            raise PermissionError(errno.EACCES, "no", str(target))
        return rename(self, target)

    monkeypatch.setattr("pathlib.Path.rename", stop_at_the_new)
    with pytest.raises(PermissionError), replaced_folder(tmp_path / "made") as temporary:
        (temporary / "a").write_bytes(b"new")
    assert content(tmp_path) == {"made/a": b"old"}
