"""kedro-viz in a real browser: the first screen tells the story, and a preview opens."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import time
from pathlib import Path

import pytest
from viz_browser import ROOT, browser, needs_browser, served, small_project

from tire_pipeline.lineage.descriptions import descriptions

pytestmark = pytest.mark.slow
FILES_TO_EVALUATION = ["files", "features", "classifier", "translators", "evaluation"]
FILES_TO_TRANSLATION = ["files", "translators", "translation"]
RECORDINGS_TO_PROOF = ["recordings", "mismatch", "proof"]
STORIES = (FILES_TO_EVALUATION, FILES_TO_TRANSLATION, RECORDINGS_TO_PROOF)
_RUN_A_SCRIPT = """const made = document.createElement('script');
    made.textContent = 'window.ran = 1'; document.body.append(made); return window.ran === undefined"""
SCREENSHOTS = ROOT / "data" / "08_reporting" / "screenshots"


@pytest.fixture(scope="module")
def project(tmp_path_factory):
    needs_browser()
    return small_project(tmp_path_factory.mktemp("viz"))


def _wait(driver, condition, seconds: float = 60):
    from selenium.common.exceptions import ElementClickInterceptedException, StaleElementReferenceException
    from selenium.webdriver.support.ui import WebDriverWait

    waiting = WebDriverWait(
        driver, seconds, ignored_exceptions=[StaleElementReferenceException, ElementClickInterceptedException]
    )
    return waiting.until(lambda _: condition())


def _boxes(driver) -> dict[str, float]:
    """Names of the boxes on the chart, and where they lie from left to right."""
    script = """return [...document.querySelectorAll('.pipeline-node')]
        .map(node => [node.textContent.trim(), node.getBoundingClientRect().x])"""
    return {name: place for name, place in driver.execute_script(script) if name}


def _box(driver, name: str):
    return next(box for box in driver.find_elements("css selector", ".pipeline-node") if box.text == name)


def _keep(driver, name: str) -> None:
    SCREENSHOTS.mkdir(parents=True, exist_ok=True)
    driver.save_screenshot(str(SCREENSHOTS / name))


def _asked_elsewhere(driver) -> list[str]:
    messages = [json.loads(entry["message"])["message"] for entry in driver.get_log("performance")]
    asked = [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]
    network = [address for address in asked if address.startswith(("http", "ws"))]
    return [address for address in network if not address.startswith("http://127.0.0.1:")]


def _refused(driver) -> list[str]:
    """What the content security policy has stopped."""
    return [e["message"] for e in driver.get_log("browser") if "Content Security Policy" in e["message"]]


def _assert_story(driver) -> None:
    _wait(driver, lambda: set(_boxes(driver)) == set().union(*STORIES))
    boxes = _settled(driver)
    for story in STORIES:
        places = [boxes[name] for name in story]
        assert places == sorted(places), story


def _open_preview(driver) -> None:
    """Search the ingest report, choose it, and read its first rows in the panel."""
    driver.find_element("css selector", "input[placeholder='Search']").send_keys("ingest_report")

    def row():
        found = driver.find_elements("css selector", ".row-text__label--kind-element")
        return next((one for one in found if one.text == "ingest_report"), None)

    _wait(driver, row)
    _settled(driver)
    _click(driver, row)

    def panel() -> str:
        return " ".join(one.text for one in driver.find_elements("css selector", ".pipeline-metadata"))

    _wait(driver, lambda: "A/bad.tir" in panel())
    assert "read or set aside with line and reason" in panel()  # the catalog's description


def _click(driver, find) -> None:
    """Click, and find again where the page was drawn again meanwhile."""

    def clicked() -> bool:
        find().click()
        return True

    _wait(driver, clicked)


def _settled(driver) -> dict[str, float]:
    """Boxes once they have stopped moving."""
    seen: list[dict[str, float]] = []

    def stands() -> bool:
        time.sleep(0.3)
        seen.append(_boxes(driver))
        return len(seen) > 1 and seen[-1] == seen[-2]

    _wait(driver, stands)
    return seen[-1]


def test_first_screen_then_a_pipeline_then_a_preview(project, tmp_path):
    with served(project) as address, browser(tmp_path) as driver:
        assert "Warning" not in (project / "viz.log").read_text()
        driver.get(address)
        _assert_story(driver)
        _keep(driver, "viz_first_screen.png")

        _click(driver, lambda: _box(driver, "files"))
        _wait(driver, lambda: {"read_files", "keep_usable", "to_one_nominal_load"} <= set(_boxes(driver)))
        _wait(driver, lambda: "files" not in _boxes(driver))

        _click(driver, lambda: driver.find_element("xpath", "//*[normalize-space(text())='Datasets']"))
        _wait(driver, lambda: "ingest_report" in _boxes(driver))
        _open_preview(driver)
        _keep(driver, "viz_preview.png")
        assert _asked_elsewhere(driver) == []
        assert _refused(driver) == []
        assert driver.execute_script(_RUN_A_SCRIPT)


def test_the_build_opens_without_a_server(project, tmp_path):
    built = subprocess.run(
        [sys.executable, "-m", "kedro", "viz", "build", "--include-previews"],
        cwd=project,
        capture_output=True,
        text=True,
        check=False,
    )
    assert built.returncode == 0, built.stdout + built.stderr
    assert "circular" not in built.stdout
    page = project / "a page #1.html"
    command = [sys.executable, "-m", "tire_pipeline.lineage.one_page", str(project / "build"), str(page)]
    front = project / "index.html"
    front.write_text("made before the lineage")
    subprocess.run(command, check=True)
    assert "Tire pipeline: all reports" in front.read_text()
    moved = Path(tmp_path / "elsewhere.html")
    moved.write_bytes(page.read_bytes())
    with browser(tmp_path) as driver:
        driver.get(moved.as_uri())
        _assert_story(driver)
        _click(driver, lambda: driver.find_element("xpath", "//*[normalize-space(text())='Datasets']"))
        _open_preview(driver)
        _keep(driver, "viz_one_page.png")
        assert _asked_elsewhere(driver) == []
        assert _refused(driver) == []
        assert driver.execute_script(_RUN_A_SCRIPT)


def test_every_dataset_and_node_of_the_story_has_a_description():
    from kedro.framework.project import pipelines

    known = descriptions(ROOT)
    story = pipelines["story"]
    names = {node.name for node in story.nodes} | {d for d in story.datasets() if not d.startswith("param")}
    assert {name for name in names if not known["exact"].get(name)} == set()
    patterns = {re.sub(r"\\(.)", r"\1", pattern): text for pattern, text in known["patterns"]}
    assert "fitted once per seed" in patterns["^representations.[^.]+$"]
    assert all(re.compile(pattern) for pattern, _ in known["patterns"])


def test_a_description_cannot_end_the_script(tmp_path, monkeypatch):
    from tire_pipeline.lineage import descriptions as module

    monkeypatch.setattr(module, "descriptions", lambda *_: {"exact": {"a": "</script><b>"}, "patterns": []})
    page = module.described("<head></head>", tmp_path)
    assert page.count("</script>") == 1
    assert "<b>" not in page


def test_a_folder_that_is_no_build(tmp_path):
    from tire_pipeline.errors import DomainError
    from tire_pipeline.lineage.one_page import one_page

    with pytest.raises(DomainError, match="kedro viz build"):
        one_page(tmp_path)
