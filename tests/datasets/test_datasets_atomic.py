"""What is replaced is there whole, as it was or as it is now; nothing else is left behind."""

import errno
import os
import subprocess
import sys

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
    with pytest.raises(FileNotFoundError) as raised:
        write_bytes(tmp_path / "absent/a", b"x")
    assert raised.value.filename == str(tmp_path / "absent/a")  # not the temporary file's
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


KILLED = """
import sys
from tire_pipeline.files import atomic

if sys.argv[2] == "two renamings":
    atomic.swapped = lambda *_: False
atomic.shutil.rmtree = lambda *_, **__: os._exit(9)
renamings = int(sys.argv[3])

def kill(event, arguments):
    global renamings
    if event == "os.rename":
        if renamings == 0:
            os._exit(9)
        renamings -= 1

import os
sys.addaudithook(kill)
with atomic.replaced_folder(sys.argv[1]) as temporary:
    (temporary / "a").write_bytes(b"new")
"""


@pytest.mark.parametrize("renamings", [0, 1, 2])
@pytest.mark.parametrize("how", ["swapped", "two renamings"])
def test_a_kill_loses_no_folder_and_the_next_call_tidies(tmp_path, how, renamings):
    made = tmp_path / "made"
    with replaced_folder(made) as temporary:
        (temporary / "a").write_bytes(b"old")
    killed = subprocess.run([sys.executable, "-c", KILLED, str(made), how, str(renamings)], check=False)
    assert killed.returncode == 9
    assert len(list(tmp_path.iterdir())) == 2  # or nothing was killed in the middle
    if how == "swapped":
        assert content(made) == {"a": b"new"}
    (tmp_path / ".made.mine.old").mkdir()
    with replaced_folder(made) as temporary:
        assert content(made)["a"] == (b"new" if how == "swapped" or renamings == 2 else b"old")
        (temporary / "b").write_bytes(b"2")
    assert content(made) == {"b": b"2"}
    assert sorted(p.name for p in tmp_path.iterdir()) == [".made.mine.old", "made"]


def test_a_folder_behind_a_link_is_replaced_there(tmp_path):
    (tmp_path / "disk").mkdir()
    (tmp_path / "made").symlink_to("disk")
    with replaced_folder(tmp_path / "made") as temporary:
        (temporary / "a").write_bytes(b"1")
    assert (tmp_path / "made").is_symlink()
    assert content(tmp_path / "disk") == {"a": b"1"}


def test_a_failed_second_renaming_is_undone(tmp_path, monkeypatch):
    with replaced_folder(tmp_path / "made") as temporary:
        (temporary / "a").write_bytes(b"old")
    monkeypatch.setattr("tire_pipeline.files.atomic.swapped", lambda *_: False)
    rename = type(tmp_path).rename

    def stop_at_the_new(self, target):
        if self.suffix == ".part":
            raise PermissionError(errno.EACCES, "no", str(target))
        return rename(self, target)

    monkeypatch.setattr("pathlib.Path.rename", stop_at_the_new)
    with pytest.raises(PermissionError), replaced_folder(tmp_path / "made") as temporary:
        (temporary / "a").write_bytes(b"new")
    assert content(tmp_path) == {"made/a": b"old"}
