"""CSV tables: no cell begins a formula, numbers stay numbers, and a load gives every text as it was."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from tire_pipeline.datasets import CsvTableDataset
from tire_pipeline.pages.safe_csv import original_text, safe_text

ROOT = Path(__file__).resolve().parents[2]
HOSTILE = ["=1+1", "+x", "-x", "@SUM(A1)", "\t=1", "\r=1", "a;=1+1", "a|-x", "x\n=1", "'=1", "''-x", "＝1"]
HARMLESS = ["plain", "it's; -3 is", 'say "no", now', "München", "a-b", "⟨U+0041⟩", "⟨", "A/b.tir"]


def test_texts_come_back_and_numbers_stay_numbers(tmp_path):
    texts = [*HOSTILE, *HARMLESS]
    numbers = -np.arange(len(texts)) / 3
    table = pd.DataFrame({"=name": texts, "\u202en": numbers, "i": range(0, -len(texts), -1), "empty": None})
    dataset = CsvTableDataset(filepath=str(tmp_path / "a.csv"), save_args={"index": False})
    dataset.save(table)
    with open(tmp_path / "a.csv", newline="", encoding="utf-8") as stream:
        head, *rows = csv.reader(stream)
    assert head == ["'=name", "⟨U+202E⟩n", "i", "empty"]
    assert [row[1] for row in rows] == [str(number) for number in numbers]
    assert [row[0] for row in rows if row[0] in HARMLESS] == [t for t in HARMLESS if t != "⟨U+0041⟩"]
    back = dataset.load()
    assert list(back["=name"]) == texts
    pd.testing.assert_frame_equal(back[["\u202en", "i"]], table[["\u202en", "i"]])
    assert back["empty"].isna().all()


@pytest.mark.parametrize("text", ["-0.5", "-1e-5", "+3", "-.5", "-inf", "12", "-nan"])
def test_a_number_as_text_is_left_alone(text):
    assert safe_text(text) == text


@settings(max_examples=200)
@given(st.text(alphabet=st.sampled_from("'=+-@;|\n\r\t⟨⟩U027E8A \u202e1.e"), max_size=12))
def test_every_text_comes_back_and_none_begins_a_formula(text):
    safe = safe_text(text)
    assert original_text(safe) == text
    assert not set(safe) & set("\t\r\u202e")
    if safe != text or text[:1] in "=@":
        assert not any(
            part[:1] in set("=+-@") for part in safe.replace("|", ";").replace("\n", ";").split(";")
        )


UNGUARDED = ["concealed/real/published.py"]
"""Holds names of scores of the proof, which are the project's own."""
_WRITES = re.compile(r"\.to_csv\(|csv\.(Dict)?[wW]riter\(")


def test_no_table_is_written_but_with_guarded_cells():
    """Every CSV of the package goes through ``safe_table``, and Kedro's own dataset writes none."""
    package = ROOT / "src" / "tire_pipeline"
    bare = []
    for path in package.rglob("*.py"):
        writing = [line for line in path.read_text(encoding="utf-8").splitlines() if _WRITES.search(line)]
        if any("safe_table(" not in line and not line.strip().startswith(">>>") for line in writing):
            bare.append(path.relative_to(package).as_posix())
    assert bare == UNGUARDED
    catalog = (ROOT / "conf" / "base" / "catalog").glob("*.yml")
    entries = {name: each for path in catalog for name, each in yaml.safe_load(path.read_text()).items()}
    types = {each["type"] for each in entries.values()}
    assert "tire_pipeline.datasets.CsvTableDataset" in types
    assert "pandas.CSVDataset" not in types
