"""The eight pipelines on a small fleet, as a user starts them."""

from __future__ import annotations

import re
from pathlib import Path

import pandas as pd
import pytest
from conftest_kedro import kedro

from tire_pipeline.tir import read_tir

pytestmark = pytest.mark.slow


def _latest(folder: Path, layer: str, name: str) -> Path:
    return sorted((folder / "data" / layer / name).glob(f"*/{name}"))[-1]


def test_it_ends_well_and_says_where_the_results_are(small_run):
    stdout = (small_run / "stdout.txt").read_text()
    places = dict(re.findall(r"^(report|translated \.tir files): (.+)$", stdout, flags=re.M))
    assert Path(places["report"]).exists()
    assert list(Path(places["translated .tir files"]).rglob("*.tir"))


def test_translated_files_are_valid_and_name_their_source(small_run):
    folder = small_run / "data" / "07_model_output" / "tir"
    files = sorted(folder.rglob("*.tir"))
    sources = small_run / "data" / "01_raw" / "evaluation"
    judged = {p.relative_to(sources) for s in ("four", "hidden") for p in (sources / s).rglob("*.tir")}
    assert {p.relative_to(folder) for p in files} == judged
    assert len([p for p in judged if p.parts[0] == "four"]) == 4 * 4
    for file in files[:8]:
        tire = read_tir(file)
        source = read_tir(small_run / "data" / "01_raw" / "evaluation" / file.relative_to(folder))
        assert tire.coefficients["FNOMIN"] == source.coefficients["FNOMIN"]
        assert tire.metadata["INERTIA.MASS"] == source.metadata["INERTIA.MASS"]
        assert str(file.relative_to(folder)) in file.read_text(encoding="cp1252")


def test_the_reported_figures_are_those_of_the_table(small_run):
    page = (small_run / "data" / "08_reporting" / "report.html").read_text()
    scores = pd.read_csv(_latest(small_run, "07_model_output", "classifier_scores.csv"))
    forest = scores[(scores["classifier"] == "random_forest") & (scores["features"] == "as they are")]
    for accuracy in forest["accuracy"]:
        assert f"{accuracy:.1%}" in page
    summary = pd.read_csv(_latest(small_run, "07_model_output", "evaluation_summary.csv"))
    assert set(summary["translator"]) == {"agent", "no change", "oracle", "floor"}
    assert (summary.loc[summary["translator"] == "no change", "ratio"] == 1.0).all()


def test_no_physical_tire_is_on_both_sides(small_run):
    splits = pd.read_csv(_latest(small_run, "05_model_input", "splits.csv"))
    table = pd.read_parquet(_latest(small_run, "03_primary", "tire_table.parquet"))
    sides = splits.merge(table[["file", "tire_id"]]).groupby("tire_id")
    assert (sides["by_tire"].nunique() == 1).all()
    assert (sides["random"].nunique() > 1).any()


def test_shuffled_truth_leaves_every_translated_file_as_it_was(small_run, tmp_path):
    """The sealed truth never reaches what is judged."""
    data = small_run / "data"
    translated = data / "07_model_output" / "tir"
    before = {p.relative_to(translated): p.read_bytes() for p in sorted(translated.rglob("*.tir"))}
    scores = _latest(small_run, "07_model_output", "evaluation_summary.csv").read_text()
    truth = sorted((data / "01_raw" / "truth" / "first").rglob("*.tir"))
    texts = [p.read_bytes() for p in truth]
    for path, text in zip(truth, texts[1:] + texts[:1], strict=True):
        path.write_bytes(text)
    try:
        done = kedro(small_run, "--pipeline", "evaluate")
        assert done.returncode == 0, done.stdout + done.stderr
        after = {p.relative_to(translated): p.read_bytes() for p in sorted(translated.rglob("*.tir"))}
        assert after == before
        assert _latest(small_run, "07_model_output", "evaluation_summary.csv").read_text() != scores
    finally:
        for path, text in zip(truth, texts, strict=True):
            path.write_bytes(text)
