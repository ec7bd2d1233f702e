"""Hostile names, comments and columns through pipelines: no page runs them, no CSV holds a formula."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

import pandas as pd
import pytest
from hostile import IMAGE, RUNS, SAID, SCRIPT, assert_nothing_runs, hostile_cells
from viz_browser import ROOT, browser, needs_browser

from tire_pipeline.mismatch.effects import catalogue

sys.path.insert(0, str(ROOT / "tests" / "pipelines"))
from conftest_kedro import kedro_here

pytestmark = pytest.mark.slow
CATEGORY = f'=1+1{IMAGE}"'
FILE = f"-2+3\u202e'{IMAGE}$\\frac$.tir"
RECORDING = f"@SUM(A1)\u2066\"'><svg onload={RUNS}>.csv"


@pytest.fixture(scope="module")
def data(tmp_path_factory) -> Path:
    """The data folder of one run over hostile files."""
    needs_browser()
    folder = tmp_path_factory.mktemp("hostile")
    raw = folder / "data" / "01_raw"
    tire = (ROOT / "examples" / "tire.tir").read_text()
    for name in (FILE, "plain.tir"):
        place = raw / "tir" / CATEGORY / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(SAID + tire, encoding="utf-8")
    (raw / "tir" / CATEGORY / f"={IMAGE}.tir").write_text(f"[{SCRIPT}]\nX = {SCRIPT}\n")  # set aside
    rig = raw / "recordings" / CATEGORY
    rig.mkdir(parents=True)
    (rig / f"{IMAGE}model.tir").write_text(SAID + tire, encoding="utf-8")
    shown = pd.read_csv(ROOT / "examples" / "rig_run.csv").iloc[::4].drop(columns=["V", "P"])
    shown = shown.assign(**{SCRIPT: IMAGE, "=1+1": 1.0})
    shown.to_csv(rig / RECORDING, index=False)
    bad = raw / "recordings" / "bad"
    bad.mkdir()
    shutil.copy(rig / f"{IMAGE}model.tir", bad)
    (bad / f"+1{SCRIPT.split('/')[0]}.csv").write_text(f"time,{SCRIPT}\n0,{SCRIPT}\n")
    few = ";".join(sorted(set(catalogue()) - {"friction_scale", "force_offset"}))
    without = f"explain_mismatch.without={few}"
    done = kedro_here(folder, "--pipelines", "ingest_tir,explain_mismatch", "--params", without)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder / "data"


def test_no_page_runs_anything_of_a_file(data, tmp_path):
    pages = sorted((data / "08_reporting").rglob("*.html"))
    assert {page.name for page in pages} >= {"index.html", "mismatch.html"}
    assert any("mismatch" in page.parent.parts for page in pages)  # the page of the recording
    with browser(tmp_path) as driver:
        named = [IMAGE in assert_nothing_runs(driver, page) for page in pages]
    assert any(named)  # shown as text


def test_no_cell_of_a_table_begins_a_formula(data):
    tables = [path for path in data.rglob("*.csv") if path.is_file() and "01_raw" not in path.parts]
    assert {path.name for path in tables} >= {"ingest_report.csv", "mismatch_overview.csv"}
    assert hostile_cells(tables) >= 3
