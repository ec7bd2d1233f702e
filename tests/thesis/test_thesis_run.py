"""`kedro run --pipeline reproduce_thesis` on a small fleet: resumes after a kill, and what the page says."""

from __future__ import annotations

import html
import re
import sys
from pathlib import Path

import pandas as pd
import pytest
from thesis_stored import stored_results

sys.path.insert(0, str(Path(__file__).parents[1] / "viz"))

from viz_browser import browser, needs_browser, read_page

from tire_pipeline.thesis.pages.words import plus_minus

pytestmark = pytest.mark.slow


def test_a_killed_run_goes_on_where_it_stopped(interrupted_run):
    assert interrupted_run.done.returncode == 0, interrupted_run.done.stdout + interrupted_run.done.stderr
    left, now = interrupted_run.left, stored_results(interrupted_run.folder)
    trained = [name for name in left if name.startswith("06_models")]
    assert trained
    assert {name: now[name] for name in left} == left
    assert len([name for name in now if name.startswith("06_models")]) == 2 * 2  # cells x seeds


@pytest.mark.long
def test_another_run_computes_nothing_and_more_seeds_only_those(interrupted_run):
    before = stored_results(interrupted_run.folder)
    conf = interrupted_run.folder / "conf" / "small" / "parameters.yml"
    text = conf.read_text()
    assert "seeds: [1, 2]," in text
    conf.write_text(text.replace("seeds: [1, 2],", "seeds: [1, 2, 3],"))
    more = interrupted_run.kedro(
        interrupted_run.folder,
        *("--pipeline", "reproduce_thesis", "--namespaces", "representations,agents,floor"),
    )
    conf.write_text(text)
    assert more.returncode == 0, more.stdout + more.stderr
    after = stored_results(interrupted_run.folder)
    assert {name: after[name] for name in before} == before
    new = {name.split("/")[-1] for name in set(after) - set(before)}
    assert new == {"seed_3.npz"}


def test_the_page_holds_every_table_and_figure_and_opens_without_a_network(interrupted_run):
    folder = interrupted_run.folder / "data" / "08_reporting"
    page = (folder / "thesis.html").read_text(encoding="utf-8")
    for number in range(1, 22):
        assert f"Table 5.{number}:" in page
    for number in ["4.1", "4.2", *(f"5.{n}" for n in range(1, 17))]:
        assert f"Figure {number}:" in page
    for number in range(1, 5):
        assert f"RQ{number}:" in page
    assert "Table 6.1:" in page
    assert "proprietary" in page
    assert not re.findall(r"<script|<link|<img|@import|src=|href=\"https?:", page)


def test_the_figures_on_the_page_are_those_of_the_tables(interrupted_run):
    folder = interrupted_run.folder / "data" / "08_reporting"
    page = (folder / "thesis.html").read_text(encoding="utf-8")
    scores = pd.read_csv(folder / "thesis" / "scores.csv")
    forest = scores[(scores["classifier"] == "random_forest") & scores["smote"]]
    assert set(forest["split"]) == {"random", "by_tire"}
    for accuracy in forest.groupby("split")["accuracy"].mean():
        assert f"{accuracy:.1%}" in page
    beside = pd.read_csv(folder / "thesis" / "tables_5_10_to_5_21.csv")
    ran = beside.dropna(subset=["curves"])
    assert set(ran["table"].astype(str)) == {"5.11", "5.17"}
    agents = pd.read_csv(folder / "thesis" / "agents.csv")
    for row in ran[ran["quantity"] == "ratio"].itertuples():
        own = agents[
            (agents["set"] == "four")
            & (agents["decoding"] == "tire")
            & (agents["representation"] == row.representation)
            & (agents["metric"] == row.metric)
        ]["ratio"]
        assert row.tire == pytest.approx(own.mean())
        assert row.tire_std == pytest.approx(own.std())
        assert row.tire_std > 0.0
        assert html.escape(plus_minus(row.tire, row.tire_std)) in page


def test_every_curve_is_there_as_data_and_as_figure(interrupted_run):
    folder = interrupted_run.folder / "data" / "08_reporting" / "thesis"
    for name in ("figure_5_1", "figure_5_2", "figure_5_5", "figure_5_9", "figure_5_10", "reliability"):
        assert (folder / f"{name}.svg").stat().st_size > 1000
    for name in ("forest_trees", "forest_depth", "bins", "latent", "learning", "force_curves"):
        assert len(pd.read_csv(folder / f"{name}.csv")) > 0


def test_the_page_is_read_in_a_browser_and_leads_to_the_front_page(interrupted_run, tmp_path):
    needs_browser()
    with browser(tmp_path) as driver:
        text = read_page(driver, interrupted_run.folder / "data" / "08_reporting" / "thesis.html")
        assert [name for name in ("Table 5.21:", "Figure 5.16:", "RQ4:") if name not in text] == []
        assert driver.find_elements("css selector", "figure svg")
        driver.find_element("link text", "All reports").click()
        assert driver.title == "Tire pipeline: all reports"
