"""Whatever the files are called: each is read, shown and found again by its name."""

from __future__ import annotations

import os
import unicodedata
from pathlib import Path

import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st
from retraining_files import ingest_all, put, tir_text, update_store

from tire_pipeline.datasets import TextFolderDataset, TirFolderDataset
from tire_pipeline.errors import TirError
from tire_pipeline.file_names import name_on_disk, path_of, shown_name
from tire_pipeline.retraining import Manifest, Store, difference, ingest
from tire_pipeline.tir import read_tir
from tire_pipeline.tire_table.read_files import IngestParameters

LATIN = os.fsdecode(b"M\xfcnchen.tir")


def _round_trip(store, report, tmp_path):
    """What the catalog writes."""
    store.table.to_parquet(tmp_path / "table.parquet")
    pd.DataFrame({"file": list(report), "status": list(report.values())}).to_csv(tmp_path / "report.csv")
    return pd.read_parquet(tmp_path / "table.parquet")["file"].tolist()


@given(st.binary(min_size=1).filter(lambda name: b"\0" not in name and b"/" not in name))
def test_every_name_is_shown_as_utf8_and_comes_back(name):
    shown = shown_name(os.fsdecode(name))
    shown.encode()
    assert [c for c in shown if unicodedata.category(c) == "Cc" and c.isascii()] == []
    assert os.fsencode(name_on_disk(shown)) == name


def test_usual_names_stay_as_they_are():
    for name in ("Reifen größer.tir", "a b.tir", r"back\slash.tir", "x41.tir", "轮胎.tir"):
        assert shown_name(name) == name
    assert shown_name(r"a\x41.tir") == r"a\x5cx41.tir"


def test_a_name_that_is_not_utf8_is_kept_and_shown(folder, tmp_path):
    put(folder, f"A/{LATIN}", tir_text(3, "A"))
    put(folder, "A/bad\n\x1b[31m.tir", "no tire")
    os.mkdir(os.fsencode(folder) + b"/\xe4")
    put(folder / os.fsdecode(b"\xe4"), "5.tir", tir_text(5))
    put(folder, os.fsdecode(b"A/\xff.tir"), "no tire")
    store, status, reason = update_store(folder)
    expected = ["A/1.tir", r"A/M\xfcnchen.tir", "B/2.tir", r"\xe4/5.tir"]
    assert _round_trip(store, reason, tmp_path) == expected
    assert status[r"A/bad\x0a\x1b[31m.tir"] == status[r"A/\xff.tir"] == "pending"
    assert path_of(folder, r"A/M\xfcnchen.tir") == str(folder / "A" / LATIN)
    again, _ = Manifest.from_json(store.manifest.to_json())
    assert not difference(folder, again)
    partitions = TirFolderDataset(path=str(folder)).load()
    table, report, _ = ingest_all(partitions, IngestParameters())
    table.frame().to_parquet(tmp_path / "raw.parquet")
    report.to_csv(tmp_path / "ingest.csv")
    assert table.frame()["file"].tolist() == expected
    assert report["file"].str.contains("xff").sum() == 1


def test_names_of_255_bytes_are_read_and_their_results_can_be_written(folder, tmp_path):
    long = "x" * 251 + ".tir"
    odd = os.fsdecode(b"\xfc" * 251 + b".tir")
    for name in (long, odd):
        put(folder, f"A/{name}", tir_text(len(name), "A"))
    store, status, reason = update_store(folder)
    assert set(status.values()) == {"read"}, reason
    results = TextFolderDataset(path=str(tmp_path / "out"))
    names = store.table["file"].tolist()
    results.save(dict.fromkeys(names, "text"))
    written = results.load()
    assert len(written) == len(names)
    assert f"A/{long}" in written
    assert all(name.endswith(".tir") for name in written)


@pytest.mark.slow
def test_ten_thousand_folders_and_as_deep_as_a_path_goes(tmp_path):
    for number in range(10_000):
        (tmp_path / f"{number % 100}/{number}").mkdir(parents=True)
    put(tmp_path, "99/9999/1.tir", tir_text(1))
    deep = tmp_path
    here = os.getcwd()
    try:
        os.chdir(deep)
        for _ in range(3000):  # deeper than a path can be long, and than Python calls itself
            os.mkdir("d")
            os.chdir("d")
    finally:
        os.chdir(here)
    _, status, reason = update_store(tmp_path)
    assert status.pop("99/9999/1.tir") == "read"
    (told,) = status
    assert "File name too long" in reason[told]
    _remove_deep(tmp_path)


def _remove_deep(folder: Path) -> None:
    """What shutil cannot remove, for it calls itself for each folder."""
    here = os.getcwd()
    try:
        os.chdir(folder)
        for _ in range(3000):
            os.chdir("d")
        for _ in range(3000):
            os.chdir("..")
            os.rmdir("d")
    finally:
        os.chdir(here)


def test_a_name_with_a_line_break_forges_no_line(folder):
    name = "a\nerror: all is lost\x1b[31m.tir"
    (folder / name).write_text("no tire")
    with pytest.raises(TirError) as raised:
        read_tir(folder / name)
    assert "\n" not in str(raised.value)
    assert "a\\x0aerror: all is lost\\x1b[31m.tir" in str(raised.value)
    _, report = ingest(Store(), folder, difference(folder, Manifest(), settle_seconds=0))
    (row,) = report[report["file"].str.contains("lost")].to_dict("records")
    assert "\n" not in row["file"] + row["reason"]
