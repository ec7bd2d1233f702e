"""Hostile names, comments and columns through pipelines: no page runs them, no CSV holds a formula."""

from __future__ import annotations

import csv
import re
import shutil
import sys
from pathlib import Path

import pandas as pd
import pytest
from viz_browser import ROOT, browser, needs_browser

sys.path.insert(0, str(ROOT / "tests" / "pipelines"))
from conftest_kedro import kedro_here

pytestmark = pytest.mark.slow
RUNS = "window.hacked=1"
IMAGE = f"<img src=x onerror={RUNS}>"
CATEGORY = f'=1+1{IMAGE}"'
FILE = f"-2+3\u202e'{IMAGE}$\\frac$.tir"
RECORDING = f"@SUM(A1)\u2066\"'><svg onload={RUNS}>.csv"
COLUMN = f"</style></script><script>{RUNS}</script>"
FORMULA = re.compile(r"[=+\-@\t\r]")
NUMBER = re.compile(r"[+-]?[\d.]+(e[+-]?\d+)?", re.I)
UNSEEN = re.compile("[\u202a-\u202e\u2066-\u2069\u200b-\u200f]")


@pytest.fixture(scope="module")
def data(tmp_path_factory) -> Path:
    """The data folder of one run over hostile files."""
    needs_browser()
    folder = tmp_path_factory.mktemp("hostile")
    raw = folder / "data" / "01_raw"
    tire = (ROOT / "examples" / "tire.tir").read_text()
    said = f"! {COLUMN}{IMAGE}\n$ {COLUMN}\n"
    for name in (FILE, "plain.tir"):
        place = raw / "tir" / CATEGORY / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(said + tire, encoding="utf-8")
    (raw / "tir" / CATEGORY / f"={IMAGE}.tir").write_text(f"[{COLUMN}]\nX = {COLUMN}\n")  # set aside
    rig = raw / "recordings" / CATEGORY
    rig.mkdir(parents=True)
    (rig / f"{IMAGE}model.tir").write_text(said + tire, encoding="utf-8")
    shown = pd.read_csv(ROOT / "examples" / "rig_run.csv").iloc[::4].drop(columns=["V", "P"])
    shown = shown.assign(**{COLUMN: IMAGE, "=1+1": 1.0})
    shown.to_csv(rig / RECORDING, index=False)
    bad = raw / "recordings" / "bad"
    bad.mkdir()
    shutil.copy(rig / f"{IMAGE}model.tir", bad)
    (bad / f"+1{COLUMN.split('/')[0]}.csv").write_text(f"time,{COLUMN}\n0,{COLUMN}\n")
    done = kedro_here(folder, "--pipelines", "ingest_tir,explain_mismatch")
    assert done.returncode == 0, done.stdout + done.stderr
    return folder / "data"


def test_no_page_runs_anything_of_a_file(data, tmp_path):
    pages = sorted((data / "08_reporting").rglob("*.html"))
    assert {page.name for page in pages} >= {"index.html", "mismatch.html"}
    assert any("mismatch" in page.parent.parts for page in pages)  # the page of the recording
    named = 0
    with browser(tmp_path) as driver:
        for page in pages:
            text = page.read_text(encoding="utf-8")
            assert re.search(r'<head>\s*<meta charset="utf-8">.{0,200}Content-Security-Policy', text, re.S)
            assert not UNSEEN.search(text), page
            driver.get(page.as_uri())
            assert driver.execute_script("return window.hacked") is None, page
            found = driver.execute_script(
                "return document.querySelectorAll('script, img, iframe, object, [onload], [onerror]').length"
            )
            assert found == 0, page
            refused = [e["message"] for e in driver.get_log("browser") if "favicon" not in e["message"]]
            assert refused == [], page
            named += IMAGE in driver.find_element("tag name", "body").text
            script = "const s = document.createElement('script'); s.textContent = 'window.hacked = 1';"
            assert driver.execute_script(f"{script} document.body.append(s); return window.hacked") is None
            driver.get_log("browser")
    assert named >= 1  # shown as text


def test_no_cell_of_a_table_begins_a_formula(data):
    tables = [path for path in data.rglob("*.csv") if path.is_file() and "01_raw" not in path.parts]
    assert {path.name for path in tables} >= {"ingest_report.csv", "mismatch_overview.csv"}
    hostile = 0
    for path in tables:
        text = path.read_text(encoding="utf-8")
        assert not UNSEEN.search(text), path
        for cell in (cell for row in csv.reader(text.splitlines()) for cell in row):
            if FORMULA.match(cell):
                assert NUMBER.fullmatch(cell), (path, cell)
            hostile += cell.startswith(("'=1+1", "'-2+3", "'@SUM", "'+1"))
    assert hostile >= 3
