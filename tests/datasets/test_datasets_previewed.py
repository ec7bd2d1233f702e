"""Previews in kedro-viz have few digits and show every character; what is stored has all of them."""

from __future__ import annotations

import json

import pandas as pd
import pytest

from tire_pipeline.datasets import CsvTableDataset, JsonFileDataset, ParquetTableDataset

TABLE = pd.DataFrame({"file": ["a", "b"], "PKY1": [-17.340312345, 0.000123456], "files": [3648, 12345]})


@pytest.mark.parametrize("kind", [CsvTableDataset, ParquetTableDataset])
def test_a_preview_has_four_digits_and_the_stored_table_all(tmp_path, kind):
    dataset = kind(filepath=str(tmp_path / "table"))
    dataset.save(TABLE)
    pd.testing.assert_frame_equal(dataset.load(), TABLE)
    shown = dataset.preview(nrows=1)
    assert shown["data"] == [["a", -17.34, 3648]]
    assert shown["columns"] == list(TABLE)
    assert dataset.preview(nrows=5)["data"][1] == ["b", 0.0001235, 12345]


@pytest.mark.parametrize("kind", [CsvTableDataset, ParquetTableDataset])
def test_a_preview_of_a_table_shows_every_character(tmp_path, kind):
    table = pd.DataFrame({"A\u2066": [1.5], "file": ["a\u202erit."]})
    dataset = kind(filepath=str(tmp_path / "table"))
    dataset.save(table)
    shown = dataset.preview()
    assert shown["columns"] == ["A⟨U+2066⟩", "file"]
    assert shown["data"] == [[1.5, "a⟨U+202E⟩rit."]]


def test_a_preview_of_json_shows_every_character(tmp_path):
    dataset = JsonFileDataset(filepath=str(tmp_path / "summary.json"))
    outcome = {"read_by_category": {"D\u202e": 3}, "first": ["\u2066x"], "share": 0.5, "none": None}
    dataset.save(outcome)
    assert dataset.load() == outcome
    shown = json.loads(dataset.preview())
    assert shown == {"read_by_category": {"D⟨U+202E⟩": 3}, "first": ["⟨U+2066⟩x"], "share": 0.5, "none": None}
