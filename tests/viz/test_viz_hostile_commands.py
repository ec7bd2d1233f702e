"""Pages of the command ``tire`` and pages of published tables: nothing of a hostile file or table acts."""

from __future__ import annotations

import re
from pathlib import Path

import pandas as pd
import pytest
from click.testing import CliRunner
from hostile import IMAGE, SAID, SCRIPT, UNSEEN, assert_nothing_runs
from viz_browser import ROOT, browser, needs_browser

from tire_pipeline.command.cli import COMMANDS, tire
from tire_pipeline.reporting.proof.proof_page import proof_page
from tire_pipeline.reporting.translation.translation_page import translation_page

pytestmark = pytest.mark.slow
ESCAPE = "\u202e\x1b[31m"
FILE = f"./-2+3{ESCAPE}'{IMAGE}.tir"
OTHER = f"./=1+1{IMAGE}.tir"
RECORDING = f"./@SUM(A1){ESCAPE}\"'{IMAGE}.csv"
ARGUMENTS = {
    "show": [FILE],
    "compare": [FILE, OTHER],
    "check": [RECORDING, "--axes", "ISO"],
    "fit": [RECORDING, "--axes", "ISO", "-o", "made.tir"],
    "convert": [FILE, "--to", "6.1"],
    "explain": [FILE, RECORDING],
}
"""Each subcommand with its input; test_viz_hostile_everywhere.py has a model for ``translate``."""
ACTS_ON_TERMINAL = re.compile(f"[{UNSEEN.pattern[1:-1]}\x1b]")
RESULTS = ROOT / "benchmarks" / "results"


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    needs_browser()
    folder = tmp_path_factory.mktemp("hostile")
    text = (ROOT / "examples" / "tire.tir").read_text()
    (folder / FILE).write_text(SAID + text)
    (folder / OTHER).write_text(SAID + re.sub(r"(?m)^(PDY1\s*=)", r"\1 1.1 $ it was ", text))
    shown = pd.read_csv(ROOT / "examples" / "rig_run.csv").iloc[::4]
    shown.assign(**{SCRIPT: IMAGE, f"=1+1{ESCAPE}": 1.0}).to_csv(folder / RECORDING, index=False)
    return folder


@pytest.fixture(scope="module")
def driver(tmp_path_factory):
    with browser(tmp_path_factory.mktemp("browser")) as driver:
        yield driver


def test_every_subcommand_is_tried():
    assert {*ARGUMENTS, "translate"} == set(COMMANDS)


@pytest.mark.parametrize("name", ARGUMENTS)
def test_no_page_or_line_of_a_command_acts(folder, driver, monkeypatch, name):
    monkeypatch.chdir(folder)
    _assert_harmless(driver, folder, name, ARGUMENTS[name])


def _assert_harmless(driver, folder: Path, name: str, arguments: list[str]) -> None:
    page = folder / f"{name}.html"
    done = CliRunner().invoke(tire, [name, "--page", str(page), *arguments], catch_exceptions=False)
    assert done.exit_code == 0, done.output
    assert not ACTS_ON_TERMINAL.search(done.output), done.output
    assert IMAGE in assert_nothing_runs(driver, page)


def test_an_error_of_a_command_shows_what_it_names(folder, monkeypatch):
    monkeypatch.chdir(folder)
    for arguments in (["show", f"{FILE}.absent.tir"], ["check", RECORDING, "--axes", ESCAPE]):
        done = CliRunner().invoke(tire, arguments)
        assert done.exit_code == 2
        assert not ACTS_ON_TERMINAL.search(done.output), done.output


def _hostile_texts(table: pd.DataFrame) -> pd.DataFrame:
    """The table with one more row whose texts are hostile."""
    row = table.iloc[[0]].copy()
    for name in table.columns:
        if table[name].dtype == object or pd.api.types.is_string_dtype(table[name].dtype):
            row[name] = f"{IMAGE}{SCRIPT}"
    return pd.concat([table, row], ignore_index=True)


def test_the_page_of_the_proof_runs_nothing_of_its_tables(driver, tmp_path):
    scores, misses = (pd.read_csv(RESULTS / f"proof_{name}.csv") for name in ("scores", "misses"))
    real = scores.assign(source="all", n=1, low=0.0, high=1.0)
    made = {"cases": 1, "by_source": {IMAGE: 1}, "seed": 1, "code": SCRIPT, "date": IMAGE, "sha256": IMAGE}
    made |= {"sealed_sweeps": 1, "development_sweeps": 1}
    details = {"sha256": SCRIPT, "explain_mismatch": {"n": 800}}
    page = tmp_path / "proof.html"
    hostile = _hostile_texts(misses)
    page.write_text(proof_page(scores, hostile, details, real, hostile, {"published": False, "made": made}))
    assert IMAGE in assert_nothing_runs(driver, page)


def test_the_page_of_the_translators_runs_nothing_of_its_tables(driver, tmp_path):
    page = tmp_path / "translation.html"
    table = pd.read_csv(RESULTS / "translation.csv")
    own = table[table["kind"] == table["kind"].iloc[0]].assign(kind=f"{IMAGE}{SCRIPT}")
    page.write_text(translation_page(pd.concat([table, own], ignore_index=True)))
    assert IMAGE in assert_nothing_runs(driver, page)
