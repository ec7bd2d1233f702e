"""Every page and table of the project, made of files whose names, comments and columns are hostile."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest
import yaml
from click.testing import CliRunner
from hostile import IMAGE, SAID, SCRIPT, UNSEEN, assert_nothing_runs, hostile_cells
from viz_browser import ROOT, browser, needs_browser

from tire_pipeline.command.cli import tire

sys.path.insert(0, str(ROOT / "tests" / "pipelines"))
from conftest_kedro import SHORT_TRAINING, fleet_folder, kedro, small_conf

pytestmark = pytest.mark.long
PIPELINES = (
    "__default__",
    "translate",
    "retrain",
    "explain_mismatch",
    "reproduce_thesis",
    "compare_translators",
)
NOT_OF_FILES = {"proof.html"}
"""Made of no file of the user; test_viz_hostile_commands.py draws it from hostile tables."""
TRANSLATED = "translated_files.html"
LINEAGE = "lineage.html"


def _category(letter: str) -> str:
    return f"={letter}\"'{IMAGE}\u202e"


def _make_hostile(raw: Path) -> None:
    """Rename every category and file, and put comments into each."""
    for path in sorted(raw.rglob("*.tir"), reverse=True):
        path.write_text(SAID + path.read_text(encoding="cp1252"), encoding="cp1252")
        path.rename(path.with_name(f"-2+3{IMAGE}{path.name}"))
    folders = [path for path in raw.rglob("*") if path.is_dir() and len(path.name) == 1]
    for path in sorted(folders, key=lambda each: -len(each.parts)):
        path.rename(path.with_name(_category(path.name)))


def _put_recording(raw: Path) -> None:
    rig = raw / "recordings" / _category("R")
    rig.mkdir(parents=True)
    (rig / f"{IMAGE}model.tir").write_text(SAID + (ROOT / "examples" / "tire.tir").read_text())
    shown = pd.read_csv(ROOT / "examples" / "rig_run.csv").iloc[::4].assign(**{SCRIPT: IMAGE, "=1+1": 1.0})
    shown.to_csv(rig / f"@SUM(A1)\u2066{IMAGE}.csv", index=False)


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """A project folder in which every pipeline that reads the user's files has run."""
    needs_browser()
    folder = tmp_path_factory.mktemp("hostile")
    shutil.copytree(fleet_folder(tmp_path_factory) / "data", folder / "data")
    _make_hostile(folder / "data" / "01_raw")
    _put_recording(folder / "data" / "01_raw")
    parameters = small_conf(folder) / "small" / "parameters.yml"
    own = yaml.safe_dump({"target_category": _category("D")}, allow_unicode=True)
    parameters.write_text(parameters.read_text() + own)
    for name in PIPELINES:
        few = f"{SHORT_TRAINING},translate.trials=40"
        done = kedro(folder, "--pipeline", name, "--params", few)
        assert done.returncode == 0, done.stdout + done.stderr
    _draw_lineage(folder)
    return folder


def _draw_lineage(folder: Path) -> None:
    command = [sys.executable, "-m", "kedro", "viz", "build", "--include-previews"]
    (folder / "src").mkdir()
    shutil.copy(ROOT / "pyproject.toml", folder)
    base = folder / "conf" / "base" / "globals.yml"
    base.write_text((folder / "conf" / "small" / "globals.yml").read_text())
    built = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert built.returncode == 0, built.stdout + built.stderr
    page = folder / "data" / "08_reporting" / LINEAGE
    one_page = ["-m", "tire_pipeline.lineage.one_page", str(folder / "build"), str(page)]
    subprocess.run([sys.executable, *one_page], check=True, cwd=folder)


def _pages_of_catalog() -> set[str]:
    """Paths below the folder of reports of all pages, and of all folders of pages, that the catalog has."""
    found = set()
    for path in (ROOT / "conf" / "base" / "catalog").glob("*.yml"):
        for entry in yaml.safe_load(path.read_text()).values():
            place = str(entry.get("filepath") or entry.get("path"))
            if entry["type"].endswith("HtmlPageDataset") or entry.get("suffix") == ".html":
                found.add(place.rpartition("08_reporting/")[2])
    return found


def test_no_page_of_any_pipeline_runs_anything_of_a_file(folder, tmp_path):
    reports = folder / "data" / "08_reporting"
    pages = sorted(reports.rglob("*.html"))
    made = {str(page.relative_to(reports)) for page in pages}
    of_catalog = _pages_of_catalog() - NOT_OF_FILES
    assert made >= {each for each in of_catalog if each.endswith(".html")} | {"index.html", LINEAGE}
    assert any(page.startswith("mismatch/") for page in made)
    named = set()
    with browser(tmp_path) as driver:
        for page in pages:
            scripts = {TRANSLATED: 2, LINEAGE: None}.get(page.name, 0)
            if IMAGE in assert_nothing_runs(driver, page, scripts=scripts):
                named.add(page.name)
            if page.name == TRANSLATED:
                _open_a_file(driver)
    assert named >= {"report.html", "thesis.html", "retraining.html", "mismatch.html", TRANSLATED}


def test_the_previews_of_the_lineage_show_every_character(folder):
    page = (folder / "data/08_reporting" / LINEAGE).read_text(encoding="utf-8")
    data = json.loads(re.search(r'<script[^>]*id="api"[^>]*>(.*?)</script>', page, re.S)[1])
    shown = json.dumps(data, ensure_ascii=False)
    assert "window.hacked" in shown
    assert not UNSEEN.search(shown)
    assert not re.search(r"\\u(202[a-e]|206[6-9]|200[b-f])", shown)  # a JSON preview is decoded again


def _open_a_file(driver) -> None:
    driver.find_element("css selector", "#files button.file").click()
    assert driver.execute_script("return window.hacked") is None
    assert IMAGE in driver.find_element("css selector", "body").text


def test_the_page_of_tire_translate_runs_nothing_of_its_file(folder, tmp_path):
    source = min((folder / "data/01_raw/tir" / _category("A")).iterdir())
    page, model = tmp_path / "translate.html", folder / "data/06_models/translator.npz"
    command = ["translate", str(source), "--model", str(model), "--page", str(page)]
    done = CliRunner().invoke(tire, [*command, "-o", str(tmp_path / "made.tir")], catch_exceptions=False)
    assert done.exit_code == 0, done.output
    assert not UNSEEN.search(done.output)
    with browser(tmp_path) as driver:
        assert IMAGE in assert_nothing_runs(driver, page)


def test_no_figure_runs_anything_of_a_file(folder, tmp_path):
    figures = sorted((folder / "data").rglob("*.svg"))
    assert figures
    with browser(tmp_path) as driver:
        for figure in figures:
            driver.get(figure.as_uri())
            assert driver.execute_script("return window.hacked") is None, figure


def test_no_table_of_any_pipeline_holds_a_formula(folder):
    tables = [p for p in (folder / "data").rglob("*.csv") if p.is_file() and "01_raw" not in p.parts]
    names = {path.name for path in tables}
    assert names >= {"evaluation_table.csv", "translation_report.csv", "retraining_files.csv", "splits.csv"}
    assert hostile_cells(tables) >= 1000
