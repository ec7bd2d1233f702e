"""A file that another program is writing is left to the next run; half of it would be another tire."""

import os
import threading
import time
from contextlib import contextmanager

import pytest

from tire_pipeline.datasets import RecordingFolderDataset, TirFolderDataset
from tire_pipeline.errors import TirePipelineError
from tire_pipeline.files import growing


@contextmanager
def _written(path):
    """Write lines into a file, slowly, until the block ends."""
    over = threading.Event()

    def write():
        with path.open("a") as file:
            while not over.wait(0.01):
                file.write("$ one more line\n")
                file.flush()

    thread = threading.Thread(target=write)
    path.touch()
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()


@pytest.mark.parametrize(
    ("dataset", "suffix"), [(TirFolderDataset, ".tir"), (RecordingFolderDataset, ".csv")], ids=str
)
def test_a_file_that_grows_is_named_and_left_to_the_next_run(tmp_path, dataset, suffix):
    (tmp_path / f"whole{suffix}").write_text("whole")
    path = tmp_path / f"growing{suffix}"
    with _written(path):
        found = dataset(path=str(tmp_path)).load()
        with pytest.raises(TirePipelineError, match=r"it is being written.*run again when it is whole"):
            found[path.name]()
    again = dataset(path=str(tmp_path)).load()
    assert set(again) == set(found) == {path.name, f"whole{suffix}"}
    assert type(found[f"whole{suffix}"]) is type(again[path.name]) is type(again[f"whole{suffix}"])


def test_where_nothing_has_changed_of_late_nobody_waits(tmp_path, monkeypatch):
    path = tmp_path / "old.tir"
    path.write_text("whole")
    os.utime(path, (time.time() - 60.0,) * 2)
    monkeypatch.setattr(growing.time, "sleep", lambda seconds: pytest.fail("it waited"))
    assert list(TirFolderDataset(path=str(tmp_path)).load()) == ["old.tir"]


@pytest.mark.parametrize("date", [0.0, 2.0**33])
def test_a_date_of_1970_or_far_ahead_keeps_nothing_out(tmp_path, date):
    path = tmp_path / "odd.tir"
    path.write_text("whole")
    os.utime(path, (date, date))
    assert TirFolderDataset(path=str(tmp_path)).load()["odd.tir"].path == str(path)
