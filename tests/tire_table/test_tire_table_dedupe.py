"""What is dropped, in which order, and what the report says."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.errors import DomainError
from tire_pipeline.tire_table import IDENTICAL, NO_VALUE, OVERFLOWS, TOO_SMALL, dedupe_and_filter, from_models


def table(rows: int = 6, categories: str = "AAABBB") -> pd.DataFrame:
    numbers = np.arange(rows, dtype=float)
    return pd.DataFrame(
        {
            "file": [f"{c}/{i}.tir" for i, c in enumerate(categories)],
            "category": list(categories),
            "version": "5.2",
            "PCY1": 1.3 + numbers,
            "PDY1": 1.0,
            "LMUY": 1.0,
            "FNOMIN": 4000.0,
            "FZMAX": 9000.0,
            "MASS": 9.0,
            "tire_id": "t",
        }
    )


def test_nothing_to_drop():
    kept, report = dedupe_and_filter(table(), 3, ["PCY1"])
    pd.testing.assert_frame_equal(kept, table())
    assert report.empty
    assert list(report.columns) == ["file", "category", "reason", "detail"]


def test_doubles_keep_the_first_whatever_its_category():
    data = table()
    data.loc[[2, 4], "PCY1"] = data.loc[0, "PCY1"]
    data.loc[4, ["FZMAX", "MASS"]] = 1.0  # no coefficients of a force
    kept, report = dedupe_and_filter(data, 1)
    assert kept["file"].tolist() == ["A/0.tir", "A/1.tir", "B/3.tir", "B/5.tir"]
    assert report.to_dict("records") == [
        {"file": "A/2.tir", "category": "A", "reason": IDENTICAL, "detail": "as A/0.tir"},
        {"file": "B/4.tir", "category": "B", "reason": IDENTICAL, "detail": "as A/0.tir"},
    ]


@pytest.mark.parametrize("name", ["PDY1", "LMUY", "FNOMIN"])
def test_one_other_coefficient_makes_no_double(name: str):
    data = table()
    data.loc[2, "PCY1"] = data.loc[0, "PCY1"]
    data.loc[2, name] = np.nextafter(data.loc[0, name], np.inf)
    kept, _ = dedupe_and_filter(data, 1)
    assert len(kept) == 6


def test_a_missing_value_equals_a_missing_value():
    data = table()
    data["PHY1"] = [np.nan, 1, np.nan, 2, 3, 0.0]
    data.loc[[2, 5], "PCY1"] = data.loc[0, "PCY1"]
    _, report = dedupe_and_filter(data, 1)
    assert report["file"].tolist() == ["A/2.tir"]


def test_files_without_a_feature_are_dropped():
    data = table()
    data.loc[1, "PCY1"] = np.nan
    data.loc[3, ["PCY1", "PDY1"]] = np.nan
    data.loc[5, "MASS"] = np.nan  # no feature
    kept, report = dedupe_and_filter(data, 1, ["PCY1", "PDY1"])
    assert kept["file"].tolist() == ["A/0.tir", "A/2.tir", "B/4.tir", "B/5.tir"]
    assert report["reason"].tolist() == [NO_VALUE, NO_VALUE]
    assert report["detail"].tolist() == ["PCY1", "PCY1, PDY1"]


def test_files_whose_values_overflow_are_dropped():
    data = table()
    data.loc[1, "PDY1"], data.loc[2, ["PCY1", "MASS"]], data.loc[3, "PCY1"] = -1e40, 1e300, 1e9
    data.loc[4, "FNOMIN"] = 1e-300
    kept, report = dedupe_and_filter(data, 1, ["PCY1"])
    assert list(kept["file"]) == ["A/0.tir", "B/3.tir", "B/5.tir"]
    assert report[["reason", "detail"]].to_numpy().tolist() == [
        [OVERFLOWS, "PDY1"],
        [OVERFLOWS, "PCY1, MASS"],
        [OVERFLOWS, "FNOMIN"],
    ]


def test_small_categories_are_counted_after_the_other_steps():
    data = table(7, "AAABBBB")
    data.loc[1, "PCY1"] = np.nan
    kept, report = dedupe_and_filter(data, 3, ["PCY1"])
    assert kept["category"].tolist() == ["B"] * 4
    assert dict(zip(report["file"], report["reason"], strict=True)) == {
        "A/0.tir": TOO_SMALL,
        "A/1.tir": NO_VALUE,
        "A/2.tir": TOO_SMALL,
    }
    assert report["detail"].tolist() == ["2 usable, 3 needed", "PCY1", "2 usable, 3 needed"]


def test_every_row_is_kept_or_reported_once():
    rng = np.random.default_rng(5)
    data = table(400, "".join(rng.choice(list("ABCDE"), 400, p=[0.5, 0.3, 0.1, 0.08, 0.02])))
    data["PCY1"] = rng.integers(0, 150, 400).astype(float)
    data.loc[rng.random(400) < 0.1, "PDY1"] = np.nan
    kept, report = dedupe_and_filter(data, 20, ["PCY1", "PDY1"])
    assert sorted([*kept["file"], *report["file"]]) == sorted(data["file"])
    assert not kept.duplicated(["PCY1", "PDY1"]).any()
    assert kept[["PCY1", "PDY1"]].notna().all(axis=None)
    assert kept["category"].value_counts().min() >= 20


def test_a_feature_that_no_file_has():
    with pytest.raises(DomainError, match="no file has a value for PKY9"):
        dedupe_and_filter(table(), 1, ["PCY1", "PKY9"])


def test_a_table_without_files_is_not_said_to_lack_coefficients():
    """An empty folder was answered by the advice to choose another representation."""
    with pytest.raises(DomainError, match=r"there is no file to learn from -> put \.tir files into"):
        dedupe_and_filter(from_models([]), 1, ["PKY1"])
