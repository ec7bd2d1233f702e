"""The page of all recordings: those of the last run, and every report that earlier runs have left."""

from __future__ import annotations

import pandas as pd

from tire_pipeline.datasets import TextFolderDataset
from tire_pipeline.reporting.mismatch_overview import draw_overview, rows_to_keep


def found(recording: str, verdict: str, summary: str) -> pd.DataFrame:
    row = {"recording": recording, "verdict": verdict, "summary": summary, "effects": "camber"}
    return pd.DataFrame([{**row, "alternatives": "", "held_out": "", "problem": ""}])


def test_a_report_of_an_earlier_run_is_listed_with_what_it_says():
    before, now = found("a/one.csv", "explained", "Camber is missing."), found("two.csv", "agrees", "Same.")
    rows = {**rows_to_keep(before), **rows_to_keep(now)}
    page, outcome = draw_overview(now, ["a/one.html", "two.html"], rows)
    assert "Reports of earlier runs" in page
    assert "Camber is missing." in page
    assert 'href="mismatch/a/one.html"' in page
    assert 'href="mismatch/two.html"' in page
    assert outcome == ["1 recording: 1 agrees.", "two.csv: Same."]


def test_a_report_that_the_user_deleted_is_listed_no_longer():
    before, now = found("a/one.csv", "explained", "Camber is missing."), found("two.csv", "agrees", "Same.")
    page, _ = draw_overview(now, ["two.html"], {**rows_to_keep(before), **rows_to_keep(now)})
    assert "one.csv" not in page


def test_a_report_of_a_run_that_noted_nothing_is_linked():
    page, _ = draw_overview(found("two.csv", "agrees", "Same."), ["old.html", "two.html"], {})
    assert 'href="mismatch/old.html"' in page
    assert "Open it to see what was found." in page


def test_a_recording_made_again_is_listed_once():
    rows = rows_to_keep(found("two.csv", "explained", "Camber is missing."))
    page, _ = draw_overview(found("two.csv", "agrees", "Same."), ["two.html"], rows)
    assert "Camber is missing." not in page
    assert page.count('href="mismatch/two.html"') == 1


def test_corrected_files_of_earlier_runs_stay_and_outdated_ones_go(tmp_path):
    corrected = TextFolderDataset(path=str(tmp_path / "corrected"), keep=True)
    corrected.save({"one_corrected.tir": "1", "two_corrected.tir": "2"})
    corrected.save({"two_corrected.tir": None, "three_corrected.tir": "3", "never_corrected.tir": None})
    assert corrected.load() == {"one_corrected.tir": b"1", "three_corrected.tir": b"3"}
