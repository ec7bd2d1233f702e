"""The eight pipelines on a small fleet, as a user starts them."""

from __future__ import annotations

import html
import json
import re
import shutil
import sys
from pathlib import Path

import pandas as pd
import pytest
from conftest_kedro import kedro_here

from tire_pipeline.tir import read_tir

sys.path.insert(0, str(Path(__file__).parents[1] / "viz"))
from viz_browser import browser, needs_browser

pytestmark = pytest.mark.slow
TRANSLATORS = ("thesis' agent", "our agent", "mixed model")


def _latest(folder: Path, layer: str, name: str) -> Path:
    return sorted((folder / "data" / layer / name).glob(f"*/{name}"))[-1]


def test_it_ends_well_and_says_where_the_results_are(small_run):
    stdout = (small_run / "stdout.txt").read_text()
    places = dict(
        re.findall(r"^(report|translated evaluation files|ingest report): (.+)$", stdout, flags=re.M)
    )
    assert Path(places["ingest report"]).is_file()
    assert Path(places["report"]).exists()
    assert list(Path(places["translated evaluation files"]).rglob("*.tir"))


def test_translated_files_are_valid_and_name_their_source(small_run):
    folder = small_run / "data" / "07_model_output" / "tir"
    files = sorted(folder.rglob("*.tir"))
    sources = small_run / "data" / "01_raw" / "evaluation"
    judged = {p.relative_to(sources) for s in ("four", "hidden") for p in (sources / s).rglob("*.tir")}
    table = pd.read_parquet(_latest(small_run, "07_model_output", "translated_table.parquet"))
    best = json.loads(_latest(small_run, "07_model_output", "best_translator.json").read_text())["name"]
    own = table[table["translator"] == best].set_index("file")["verdict"]
    assert {str(p) for p in judged} == set(own.index)
    assert {str(p.relative_to(folder)) for p in files} == set(own.index[own == "translated"])
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
    assert set(summary["translator"]) == {*TRANSLATORS, "no change", "oracle", "floor"}
    assert (summary.loc[summary["translator"] == "no change", "ratio"] == 1.0).all()


def test_the_page_begins_and_the_run_ends_with_what_the_files_became(small_run):
    summary = pd.read_csv(_latest(small_run, "07_model_output", "evaluation_summary.csv"))
    best = json.loads(_latest(small_run, "07_model_output", "best_translator.json").read_text())
    lines = json.loads(_latest(small_run, "07_model_output", "evaluation_outcome.json").read_text())
    assert best["name"] == min(best["rms_ratio"], key=best["rms_ratio"].get)
    assert set(best["rms_ratio"]) == set(TRANSLATORS)
    rms = summary[(summary["set"] == "hidden") & (summary["metric"] == "forces")].set_index("translator")[
        "rms"
    ]
    assert f"from {rms['no change']:,.0f} N to {rms[best['name']]:,.0f} N" in lines[0]
    assert f"The floor is {rms['floor']:,.0f} N" in lines[0]
    assert f"files are those of {'' if best['name'] == 'our agent' else 'the '}{best['name']}" in lines[-1]
    errors = pd.read_csv(_latest(small_run, "07_model_output", "evaluation_table.csv"))
    own = errors[(errors["set"] == "hidden") & (errors["translator"] == best["name"])]
    assert own["forces"].mean() ** 0.5 == pytest.approx(rms[best["name"]])
    page = (small_run / "data" / "08_reporting" / "report.html").read_text()
    assert html.unescape(re.search(r"<p>(.*?)</p>", page)[1]) == lines[0]
    stdout = (small_run / "stdout.txt").read_text()
    places = [stdout.index(line) for line in lines]
    assert places == sorted(places)
    assert stdout.index("done in ") < places[0]
    assert stdout.rindex(" done: ") < places[0]


def test_the_newest_tables_lie_as_plain_files_and_the_page_links_them(small_run):
    reports = small_run / "data" / "08_reporting"
    for layer, name in (
        ("05_model_input", "splits.csv"),
        ("07_model_output", "evaluation_table.csv"),
    ):
        assert (reports / "tables" / name).read_bytes() == _latest(small_run, layer, name).read_bytes()
    linked = re.findall(r'<a href="([^"#]+)"', (reports / "report.html").read_text())
    assert "tables/ingest_report.csv" in linked
    assert [link for link in linked if not (reports / link).is_file()] == []


def test_a_run_says_nothing_twice_and_nothing_of_its_tools(small_run):
    lines = (small_run / "stdout.txt").read_text().splitlines()
    said = [re.sub(r"^\d\d:\d\d:\d\d \w+ ", "", line) for line in lines]
    assert len(said) == len(set(said))
    assert not re.search("Warning|async|pydantic|No nodes ran", "\n".join(lines))


def test_no_physical_tire_is_on_both_sides(small_run):
    splits = pd.read_csv(_latest(small_run, "05_model_input", "splits.csv"))
    table = pd.read_parquet(_latest(small_run, "03_primary", "tire_table.parquet"))
    sides = splits.merge(table[["file", "tire_id"]]).groupby("tire_id")
    assert (sides["by_tire"].nunique() == 1).all()
    assert (sides["random"].nunique() > 1).any()


def test_shuffled_truth_leaves_every_translated_file_as_it_was(small_run, tmp_path):
    """The sealed truth never reaches what is judged."""
    data = shutil.copytree(small_run / "data", tmp_path / "data")
    translated = data / "07_model_output" / "tir"
    before = {p.relative_to(translated): p.read_bytes() for p in sorted(translated.rglob("*.tir"))}
    scores = _latest(tmp_path, "07_model_output", "evaluation_summary.csv").read_text()
    sets = data / "01_raw" / "truth" / "first"
    truth = sorted(p for name in ("four", "hidden") for p in (sets / name).rglob("*.tir"))
    texts = [p.read_bytes() for p in truth]
    for path, text in zip(truth, texts[1:] + texts[:1], strict=True):
        path.write_bytes(text)
    last = "evaluation.write_best,evaluation.judge"
    done = kedro_here(tmp_path, "--pipeline", "evaluate", "--to-nodes", last)
    assert done.returncode == 0, done.stdout + done.stderr
    after = {p.relative_to(translated): p.read_bytes() for p in sorted(translated.rglob("*.tir"))}
    assert after == before
    assert _latest(tmp_path, "07_model_output", "evaluation_summary.csv").read_text() != scores


def test_its_report_and_the_front_page_lead_to_each_other_in_a_browser(small_run, tmp_path):
    needs_browser()
    said = (small_run / "stdout.txt").read_text().splitlines()
    outcome = [line for line in said if "floor" in line and " INFO " not in line]
    with browser(tmp_path) as driver:
        driver.get((small_run / "data" / "08_reporting" / "index.html").as_uri())
        assert outcome[0] in driver.find_element("css selector", "body").text
        driver.find_element("link text", "How well the translation works").click()
        head = driver.find_element("css selector", ".main").text
        assert [line for line in outcome if line not in head] == []
        assert driver.find_elements("css selector", "figure svg, figure img")
        driver.find_element("link text", "ingest_report.csv")
        driver.find_element("link text", "All reports").click()
        assert driver.title == "Tire pipeline: all reports"
        assert [entry for entry in driver.get_log("browser") if entry["level"] == "SEVERE"] == []
