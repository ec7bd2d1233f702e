"""Previews of tables in kedro-viz have few digits, and what is stored has all of them."""

from __future__ import annotations

import pandas as pd
import pytest

from tire_pipeline.datasets import CsvTableDataset, ParquetTableDataset

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
