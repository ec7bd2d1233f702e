"""A report in parts: the same rows in the same order, and the same CSV as of the whole."""

from __future__ import annotations

import io
import os
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest
from kedro.io import Version
from kedro.io.core import VersionNotFoundError

from tire_pipeline.datasets import CsvTableDataset, ReportPartsDataset
from tire_pipeline.errors import DomainError
from tire_pipeline.files import rows_on_disk
from tire_pipeline.files.rows_on_disk import FramesOfRows, RowsOnDisk, joined, plain_rows

TYPES = {"file": "str", "line": "Int64", "ratio": "float64", "=what": "str"}
NEWEST = Version(None, None)


def _table() -> pd.DataFrame:
    """Names that no locale would sort so, texts that begin formulas, and missing values of each kind."""
    rng = np.random.default_rng(5)
    names = ["A/ä.tir", "A/z.tir", "a/1.tir", "B/\U0001f600.tir", "B/\ufb01.tir", "-1.tir", "=1+1.tir"]
    names += [f"C/{n}.tir" for n in range(20)]
    frame = pd.DataFrame({"file": rng.permutation(names), "line": rng.integers(1, 99, len(names))})
    frame["line"] = frame["line"].where(frame["line"] > 50)
    frame["ratio"] = np.where(rng.random(len(names)) < 0.3, np.nan, rng.normal(size=len(names)))
    frame["=what"] = np.where(rng.random(len(names)) < 0.5, "=2;+3", None)
    return frame.astype(TYPES)


@pytest.fixture
def rows(monkeypatch):
    monkeypatch.setattr(rows_on_disk, "REPORT_ROWS", 4)
    rows = RowsOnDisk(TYPES)
    rows.add(plain_rows(_table()))
    return FramesOfRows(rows, "select * from rows order by file", TYPES)


def _stored(folder, data) -> ReportPartsDataset:
    place = str(folder / "report.json")
    ReportPartsDataset(filepath=place, version=Version(None, "1"), float_format="%.3g").save(data)
    return ReportPartsDataset(filepath=place, version=NEWEST, float_format="%.3g")


def test_rows_come_back_sorted_as_often_as_they_are_asked_for(rows):
    frames = list(rows)
    assert [len(frame) for frame in frames] == [4, 4, 4, 4, 4, 4, 3]
    expected = _table().sort_values("file", ignore_index=True)
    pd.testing.assert_frame_equal(joined(frames), expected)
    pd.testing.assert_frame_equal(joined(rows), expected)


def test_parts_give_the_csv_of_the_whole_to_the_last_byte(rows, tmp_path):
    dataset = _stored(tmp_path, rows)
    pd.testing.assert_frame_equal(joined(dataset.load()), joined(rows))
    assert len(list((tmp_path / "report.json/1").glob("part-*.parquet"))) == 7
    written = io.StringIO(newline="")
    dataset.write_plain(written)
    whole = CsvTableDataset(
        filepath=str(tmp_path / "whole.csv"), save_args={"index": False, "float_format": "%.3g"}
    )
    whole.save(_table().sort_values("file", ignore_index=True))
    assert written.getvalue().encode() == (tmp_path / "whole.csv").read_bytes()
    assert "\n'=1+1.tir" in written.getvalue()
    assert dataset.preview(2)["columns"] == ["file", "line", "ratio", "=what"]


def test_a_report_without_rows_keeps_its_columns(tmp_path):
    dataset = _stored(tmp_path, FramesOfRows(RowsOnDisk(TYPES), "select * from rows", TYPES))
    (frame,) = dataset.load()
    assert frame.dtypes.astype(str).to_dict() == TYPES
    written = io.StringIO(newline="")
    dataset.write_plain(written)
    assert written.getvalue() == "file,line,ratio,'=what\n"


def test_what_a_former_version_stored_is_loaded_until_there_is_more(tmp_path):
    for version in ("1", "2"):
        former = CsvTableDataset(
            filepath=str(tmp_path / "report.csv"), version=Version(None, version), save_args={"index": False}
        )
        former.save(_table().assign(file=version))
    dataset = ReportPartsDataset(filepath=str(tmp_path / "report.json"), version=NEWEST)
    loaded = joined(dataset.load())
    assert list(loaded["file"].astype(str)) == ["2"] * len(_table())
    assert list(loaded["=what"].dropna().unique()) == ["=2;+3"]
    assert len(joined(_stored(tmp_path, [_table().head(3)]).load())) == 3


def test_what_is_not_there_or_damaged_is_said(rows, tmp_path):
    with pytest.raises(VersionNotFoundError):
        ReportPartsDataset(filepath=str(tmp_path / "other.json"), version=NEWEST).load()
    dataset = _stored(tmp_path, rows)
    (tmp_path / "report.json/1/part-000003.parquet").write_bytes(b"")
    with pytest.raises(DomainError, match=r"part-000003\.parquet: this part of the table is damaged"):
        joined(dataset.load())


FULL = """
from tire_pipeline.files.rows_on_disk import RowsOnDisk

RowsOnDisk(["text"]).add(("x" * 1000,) for _ in range(20_000))
"""


def test_a_full_disk_of_temporary_files_is_told_by_its_place(tmp_path):
    mount = ["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", str(tmp_path)]
    if subprocess.run(mount, check=False).returncode != 0:
        pytest.skip("no right to mount a small disk here")
    try:
        small = {**os.environ, "TMPDIR": str(tmp_path)}
        command = [sys.executable, "-c", FULL]
        done = subprocess.run(command, env=small, capture_output=True, text=True, check=False)
    finally:
        subprocess.run(["umount", str(tmp_path)], check=True)
    assert f"OSError: [Errno 28] No space left on device: '{tmp_path} (temporary files" in done.stderr
