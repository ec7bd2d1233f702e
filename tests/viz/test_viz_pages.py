"""The pages of a run in a real browser: from the front page to a recording and back; light, dark, print."""

from __future__ import annotations

import contextlib
import io
import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner
from matplotlib.image import imread
from viz_browser import ROOT, browser, needs_browser

from tire_pipeline.command.cli import tire
from tire_pipeline.concealed.scoring.words import outcome
from tire_pipeline.mismatch import Explainer, explain_recordings
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.recordings import read_recording
from tire_pipeline.reporting import front_page
from tire_pipeline.reporting.mismatch.mismatch_overview import draw_overview
from tire_pipeline.reporting.proof.proof_page import proof_page
from tire_pipeline.reporting.translation.translation_page import translation_page
from tire_pipeline.tir import read_tir

pytestmark = pytest.mark.slow
RESULTS = ROOT / "benchmarks" / "results"
TIRE, RUN = (str(ROOT / "examples" / name) for name in ("tire.tir", "rig_run.csv"))
OTHER = ROOT / "tests" / "data_of_0_1" / "07_model_output" / "translated" / "A" / "A_00001.tir"
COMMANDS = {
    "show": ([TIRE], ("Magic Formula 5.2", "cornering stiffness", "PKY1")),
    "compare": ([TIRE, str(OTHER)], ("coefficients differ", "Forces", "PDY1")),
    "check": ([RUN, "--axes", "ISO"], ("no errors and no warnings", "slip_angle", "SA from deg to rad")),
    "fit": ([RUN, "--axes", "ISO"], ("RMS of the residuals", "Not determined by the data", "PKY1")),
    "convert": ([TIRE, "--to", "6.1"], ("RMS difference of the forces", "Coefficients that differ")),
}
"""Command -> its arguments, and what its page says."""


@pytest.fixture(scope="module")
def reports(tmp_path_factory):
    """A folder of reports, made from what the project ships."""
    needs_browser()
    folder = tmp_path_factory.mktemp("pages") / "08_reporting"
    (folder / "mismatch" / "rig").mkdir(parents=True)
    run = read_recording(ROOT / "examples" / "rig_run.csv", axes="ISO").iloc[::2].drop(columns="speed")
    few = Explainer(without=set(catalogue()) - {"inflation_pressure", "friction_scale"})
    tire_model = read_tir(ROOT / "examples" / "tire.tir")
    report = explain_recordings(tire_model, {"rig/run.csv": run}, explainer=few)
    above = [("../../mismatch.html", "All recordings")]
    report.to_html(folder / "mismatch" / "rig" / "run.html", pages=above)
    row = {"recording": "rig/run.csv", "verdict": report.verdict, "summary": report.summary}
    row |= {"effects": "inflation_pressure", "alternatives": "", "held_out": "", "problem": ""}
    overview, _ = draw_overview([pd.DataFrame([row])], ["rig/run.html"], {})
    (folder / "mismatch.html").write_text(overview)
    scores, misses = (pd.read_csv(RESULTS / f"proof_{name}.csv") for name in ("scores", "misses"))
    details = {"sha256": "0", "explain_mismatch": {"n": 800}}
    real = scores.assign(source="all", n=1, low=0.0, high=1.0)  # one case tells nothing
    made = {"cases": 1, "by_source": {"dart": 1}, "seed": 1, "code": "0", "date": "today", "sha256": "0"}
    made |= {"sealed_sweeps": 1, "development_sweeps": 1}
    page = proof_page(scores, misses, details, real, misses.head(0), {"published": False, "made": made})
    (folder / "proof.html").write_text(page)
    (folder / "translation.html").write_text(translation_page(pd.read_csv(RESULTS / "translation.csv")))
    (folder / "index.html").write_text(front_page(folder))
    (folder / "command").mkdir()
    for name, (arguments, _) in COMMANDS.items():
        written = ["-o", "made.tir"] if name == "fit" else []
        page = ["--page" if name in ("fit", "convert") else "-o", str(folder / "command" / f"{name}.html")]
        _run([name, *arguments, *written, *page], tmp_path_factory.mktemp(name))
    return folder


def _run(arguments: list[str], folder: Path) -> None:
    with contextlib.chdir(folder):
        done = CliRunner().invoke(tire, arguments)
    assert done.exit_code == 0, done.output


@pytest.fixture(scope="module")
def opened(reports, tmp_path_factory):
    with browser(tmp_path_factory.mktemp("browser")) as driver:
        yield driver


@pytest.fixture
def driver(opened):
    """The browser; after a test it has asked nobody for anything, and nothing has gone wrong."""
    yield opened
    opened.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "", "features": []})
    assert [entry for entry in opened.get_log("browser") if entry["level"] == "SEVERE"] == []
    messages = [json.loads(entry["message"])["message"] for entry in opened.get_log("performance")]
    asked = [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]
    assert [address for address in asked if address.startswith(("http", "ws"))] == []


def _text(driver) -> str:
    return driver.find_element("css selector", "body").text


def _click(driver, words: str) -> None:
    driver.find_element("link text", words).click()


def test_from_the_front_page_to_a_recording_and_back(reports, driver):
    driver.get((reports / "index.html").as_uri())
    assert "1 recording: 1 explained." in _text(driver)
    _click(driver, "Your recordings")
    assert "Explained: the difference comes from inflation pressure" in _text(driver)
    _click(driver, "rig/run.csv")
    head = driver.find_element("css selector", ".main").text
    assert head.startswith("Explained: the difference comes from inflation pressure")
    assert "Next, test the corrected model" in head
    assert "ISO axes, as stated; slip_angle: SA converted from deg to rad" in _text(driver)
    for column in ("RMS before", "RMS after", "Held-out condition", "Ruled out above", "Log evidence"):
        assert column in _text(driver)
    assert len(driver.find_elements("css selector", "svg.figure")) == 2
    _click(driver, "All recordings")
    _click(driver, "All reports")
    assert driver.title == "Tire pipeline: all reports"


def test_the_proof_says_too_few_cases_and_the_translators_page_begins_with_a_sentence(reports, driver):
    driver.get((reports / "proof.html").as_uri())
    text = _text(driver)
    scores = pd.read_csv(RESULTS / "proof_scores.csv")
    told = [outcome(row) for row in scores[scores["method"] == "explain_mismatch"].to_dict("records")]
    met, few = told.count("met"), told.count("too few cases")
    said = f"{met} of {met + told.count('missed') + few} goals are met; {few} {'has' if few == 1 else 'have'}"
    assert f"{said} too few cases" in text
    assert f"{sum(map(bool, told))} have too few cases to tell" in text  # one real case tells nothing
    assert "IoU" not in text
    assert driver.find_element("css selector", "svg").location["y"] < 400  # the picture comes first
    _click(driver, "All reports")
    _click(driver, "How well every translator does")
    assert "leaves" in driver.find_element("css selector", ".main p").text


@pytest.mark.parametrize(("name", "words"), [(name, words) for name, (_, words) in COMMANDS.items()])
def test_pages_of_the_command(reports, driver, name, words):
    driver.get((reports / "command" / f"{name}.html").as_uri())
    text = _text(driver)
    assert [word for word in words if word not in text] == []
    assert driver.find_elements("css selector", "figure svg, figure img")


@pytest.mark.parametrize(
    "name",
    [
        *("index.html", "mismatch.html", "mismatch/rig/run.html", "proof.html", "translation.html"),
        *(f"command/{name}.html" for name in COMMANDS),
    ],
)
def test_every_page_is_dark_where_that_is_asked_for_and_white_on_paper(reports, driver, name):
    def paper(media: str, scheme: str) -> str:
        features = [{"name": "prefers-color-scheme", "value": scheme}]
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": media, "features": features})
        return driver.execute_script("return getComputedStyle(document.body).backgroundColor")

    driver.get((reports / name).as_uri())
    assert paper("screen", "light") == "rgb(255, 255, 255)"
    assert paper("screen", "dark") == "rgb(22, 24, 26)"
    assert paper("print", "dark") == "rgb(255, 255, 255)"
    wide = driver.execute_script("return document.documentElement.scrollWidth <= window.innerWidth")
    assert wide


@pytest.mark.parametrize(("media", "scheme", "white"), [("screen", "dark", False), ("print", "dark", True)])
def test_figures_are_as_dark_as_their_page(reports, driver, media, scheme, white):
    driver.get((reports / "mismatch/rig/run.html").as_uri())
    features = [{"name": "prefers-color-scheme", "value": scheme}]
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": media, "features": features})
    picture = driver.find_element("css selector", "svg.figure").screenshot_as_png
    edge = np.median(imread(io.BytesIO(picture))[:, 0, :3])
    assert edge == pytest.approx(1.0 if white else 24 / 255, abs=0.02)


@pytest.mark.parametrize("zoom", [1.0, 1.25])
def test_a_table_that_is_seen_whole_has_no_shadow_at_its_edges(reports, driver, zoom):
    """At other zooms than 100% a line of the shadow stood beside each table, seen on dark pages."""
    dark = {"features": [{"name": "prefers-color-scheme", "value": "dark"}]}
    size = {"width": 1200, "height": 900, "deviceScaleFactor": zoom, "mobile": False}
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", dark)
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    try:
        driver.get((reports / "command/show.html").as_uri())
        frame = driver.find_element("css selector", ".wide")
        assert driver.execute_script("return arguments[0].scrollWidth <= arguments[0].clientWidth", frame)
        edge = imread(io.BytesIO(frame.screenshot_as_png))[:, -3:, :3] * 255.0
    finally:
        driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    assert np.abs(edge - (22, 24, 26)).max() <= 2.0
