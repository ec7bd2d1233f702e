"""Drift is found where it was put, and seldom elsewhere."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.reporting import retraining_page
from tire_pipeline.reporting.retraining_page import build_retraining_report
from tire_pipeline.retraining import ModelRegistry, Release, drift_of_features
from tire_pipeline.retraining.release.drift import DRIFT, NEW, SAME, TOO_FEW, stability_index

sys.path.insert(0, str(Path(__file__).parents[2] / "viz"))

from viz_browser import browser, needs_browser, read_page


def _features(rng, rows):
    return pd.DataFrame(rng.standard_normal((rows, 5)), columns=list("abcde"))


def test_a_shift_of_one_feature_in_one_category_is_found():
    rng = np.random.default_rng(1)
    features = _features(rng, 600)
    categories = np.repeat(["A", "B"], 300)
    incoming = np.tile(np.arange(300) >= 250, 2)
    features.loc[incoming & (categories == "B"), "c"] += 1.5
    table = drift_of_features(features, categories, incoming)
    moved = table[table["verdict"] == DRIFT]
    assert moved[["category", "feature"]].to_numpy().tolist() == [["B", "c"]]


@pytest.mark.slow
def test_false_alarms_are_rarer_than_the_stated_risk():
    alarms = 0
    for seed in range(200):
        rng = np.random.default_rng(seed)
        features = _features(rng, 120)
        incoming = np.arange(120) >= 100
        table = drift_of_features(features, np.full(120, "A"), incoming)
        alarms += bool((table["verdict"] == DRIFT).any())
    assert alarms <= 0.05 * 200 + 2 * np.sqrt(0.05 * 0.95 * 200)


def test_few_files_and_new_categories_get_no_figures():
    rng = np.random.default_rng(0)
    categories = np.array(["A"] * 20 + ["B"] * 10)
    incoming = np.array([False] * 17 + [True] * 3 + [True] * 10)
    table = drift_of_features(_features(rng, 30), categories, incoming)
    verdicts = table.groupby("category")["verdict"].unique().map(list).to_dict()
    assert verdicts == {"A": [TOO_FEW], "B": [NEW]}
    assert table["psi"].isna().all()


def test_no_incoming_files_give_an_empty_table():
    rng = np.random.default_rng(0)
    assert drift_of_features(_features(rng, 20), np.full(20, "A"), np.zeros(20, dtype=bool)).empty


def test_the_index_is_the_textbook_one():
    earlier = np.repeat([0.0, 1.0], [60, 40])
    incoming = np.repeat([0.0, 1.0], [30, 70])
    expected = (0.3 - 0.6) * np.log(0.3 / 0.6) + (0.7 - 0.4) * np.log(0.7 / 0.4)
    assert np.isclose(stability_index(earlier, incoming), expected)


def test_a_constant_feature_is_no_drift():
    table = drift_of_features(pd.DataFrame({"a": np.ones(40)}), np.full(40, "A"), np.arange(40) >= 20)
    assert table["verdict"].tolist() == [SAME]


def test_the_page_of_a_first_run_says_that_there_is_nothing_to_compare():
    files = pd.DataFrame({"file": ["A/1.tir"], "status": ["read"], "reason": [""]})
    drift = pd.DataFrame(columns=["category", "feature", "psi", "verdict"])
    comparison = pd.DataFrame({"model": ["candidate"], "accuracy": [0.75]})
    page = build_retraining_report(
        [files],
        drift,
        comparison,
        {"event": "released", "reason": "it is the first one"},
        ModelRegistry(Release()),
    )
    assert "Nothing to compare" in page
    assert "population stability index" not in page
    some = pd.DataFrame({"category": ["A"], "feature": ["PKY1"], "psi": [0.5], "verdict": ["drift"]})
    page = build_retraining_report(
        [files], some, comparison, {"event": "released", "reason": "not worse"}, ModelRegistry(Release())
    )
    assert "1 of 1 comparisons show drift" in page


def test_columns_are_in_words_and_what_is_left_out_is_counted():
    files = pd.DataFrame(
        {
            "file": ["B/empty.tir"],
            "status": ["pending"],
            "reason": ["/data/tir/B/empty.tir: the file is empty"],
        }
    )
    names = [f"P{k}" for k in range(25)]
    drift = pd.DataFrame(
        {"category": "A", "feature": names, "earlier": 13, "incoming": 9, "psi": np.arange(25.0), "ks": 0.3}
    ).assign(p_adjusted=0.8, verdict=SAME)
    comparison = pd.DataFrame({"model": ["candidate"], "accuracy": [0.75]})
    outcome = {"event": "refused", "reason": "worse"}
    page = build_retraining_report([files], drift, comparison, outcome, ModelRegistry(Release()))
    assert not any(f">{name}<" in page.lower() for name in ("psi", "ks", "p_adjusted", "incoming"))
    assert "The 20 largest differences of 25." in page
    assert (">P24<" in page, ">P4<" in page) == (True, False)
    assert ">the file is empty<" in page
    assert "/data/tir" not in page


def test_categories_with_too_few_files_are_not_counted_as_free_of_drift():
    drift = pd.DataFrame(
        {"category": ["A", "A", "N"], "feature": ["PDY1", "PKY1", "PDY1"], "earlier": [1204, 1204, 0]}
    ).assign(incoming=3, psi=np.nan, ks=np.nan, p_adjusted=np.nan, verdict=[TOO_FEW, TOO_FEW, NEW])
    comparison = pd.DataFrame({"model": ["candidate"], "accuracy": [1.0]})
    given = (comparison, {"event": "refused", "reason": "worse"}, ModelRegistry(Release()))
    page = build_retraining_report([pd.DataFrame(columns=["file", "status", "reason"])], drift, *given)
    assert "Nothing can be said." in page
    assert "Too few files to compare, 5 on each side are needed: A (3 beside 1,204 earlier)." in page
    assert "New, with nothing to compare: N." in page
    assert "comparisons show drift" not in page
    assert ">1.000<" in page


def test_the_first_files_that_were_not_read_are_shown_and_the_others_counted(monkeypatch):
    monkeypatch.setattr(retraining_page, "REPORT_ROWS", 3)
    status = ["removed", "read", "pending", "read", "removed", "removed", "growing"]
    files = pd.DataFrame({"file": [f"A/{k}.tir" for k in range(7)], "status": status, "reason": "why"})
    drift = pd.DataFrame(columns=["category", "feature", "psi", "verdict"])
    comparison = pd.DataFrame({"model": ["candidate"], "accuracy": [0.75]})
    outcome = {"event": "released", "reason": "not worse"}
    given = (drift, comparison, outcome, ModelRegistry(Release()))
    page = build_retraining_report([files[:4], files[4:]], *given)
    assert "Files since the last run: 1 growing, 1 pending, 2 read, 3 removed." in page
    assert [f">A/{k}.tir<" in page for k in range(7)] == [True, False, True, False, True, False, False]
    assert "2 more are in tables/retraining_files.csv" in page
    monkeypatch.undo()
    assert "tables/retraining_files.csv" not in build_retraining_report([files], *given)


@pytest.mark.slow
def test_the_page_is_read_in_a_browser(tmp_path):
    needs_browser()
    files = pd.DataFrame(
        {"file": ["A/1.tir", "A/<b>2</b>.tir"], "status": ["read", "set aside"], "reason": ["", "line 3"]}
    )
    drift = pd.DataFrame({"category": ["A"], "feature": ["PKY1"], "psi": [0.5], "verdict": ["drift"]})
    comparison = pd.DataFrame({"model": ["candidate"], "accuracy": [0.75]})
    outcome = {"event": "released", "reason": "not worse"}
    page = tmp_path / "retraining.html"
    page.write_text(
        build_retraining_report([files], drift, comparison, outcome, ModelRegistry(Release())),
        encoding="utf-8",
    )
    with browser(tmp_path) as driver:
        text = read_page(driver, page)
        assert [
            word
            for word in ("The new model (candidate) was released", "PKY1", "A/<b>2</b>.tir", "0.75")
            if word not in text
        ] == []
        assert driver.find_elements("link text", "All reports")
