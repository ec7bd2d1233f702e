"""The page of translated files in a real browser: what it says, and what its controls do."""

from __future__ import annotations

import json
import re
from itertools import pairwise
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from viz_browser import ROOT, browser, needs_browser

from tire_pipeline.reporting.translation.drawn_files import DrawnFiles
from tire_pipeline.reporting.translation.translated_files_page import translated_page
from tire_pipeline.reporting.translation.translated_rows import listed
from tire_pipeline.translation.curves.of_files import DRAWN_OUTPUTS

pytestmark = pytest.mark.slow
SCREENSHOTS = ROOT / "data" / "08_reporting" / "screenshots"
LOADS, SLIPS = np.array([2000.0, 4000.0, 6000.0, 8000.0]), np.linspace(-0.2, 0.2, 41)
HOSTILE = "E/<script>window.hacked=1<\u002fscript>\"'\u202egnp.tir"
OWN = ("new/mine.tir", HOSTILE)
WITHOUT_MOMENT, ZERO_MOMENT = "C/c_0001.tir", "C/c_0002.tir"
TIRES = {"B": "205/55 rim 203.2", "C": "225/45 rim 215.9", "Z": "195/65 rim 190.5"}


def _report() -> pd.DataFrame:
    rows = [(f"B/b_{i:04d}.tir", "B", "translated", 0.2 + i / 1000, 0.3) for i in range(250)]
    rows += [(f"C/c_{i:04d}.tir", "C", "refused", 1.5, np.nan) for i in range(30)]
    rows += [(f"Z/z_{i:04d}.tir", "Z", "already unbiased", 0.5, 0.9) for i in range(20)]
    rows += [
        ("new/mine.tir", "B", "translated", 0.9, 0.25),
        (HOSTILE, "unknown", "unknown supplier", np.nan, np.nan),
    ]
    table = pd.DataFrame(rows, columns=["file", "source", "verdict", "distance", "expected_rms_ratio"])
    return table.assign(
        supplier_known="by its folder",
        reason='because of "<b>this</b>"',
        changes="D measures 6% more grip",
        bias_band="",
        protocol="",
        notes=[
            "PKY1 has two values | <i>TYRESIDE</i> is neither" if f == OWN[0] else "" for f in table["file"]
        ],
    )


def _curves(report: pd.DataFrame) -> dict[str, object]:
    count = len(report)
    generator = np.random.default_rng(1)
    found: dict[str, object] = {"files": list(report["file"]), "normal_load": LOADS, "slip": SLIPS}
    acted = (report["verdict"] == "translated").to_numpy()
    for name in DRAWN_OUTPUTS:
        height = generator.uniform(0.8, 1.2, (count, 1, 1)) * LOADS[:, None]
        source = height * np.tanh(SLIPS * generator.uniform(10, 30, (count, 1, 1)))
        middle = 0.9 * source + 50.0
        half = 0.02 * np.abs(source) + 20.0
        keep = np.where(acted[:, None, None], 1.0, np.nan)
        found |= {f"{name}_source": source, f"{name}_middle": middle * keep}
        found |= {f"{name}_low": (middle - half) * keep, f"{name}_high": (middle + half) * keep}
    stiffness = np.tile(1e4 * np.sqrt(LOADS), (count, 1))
    keep = np.where(acted[:, None], 1.0, np.nan)
    found |= {"stiffness_source": stiffness, "stiffness_middle": 0.9 * stiffness * keep}
    found |= {"stiffness_low": 0.85 * stiffness * keep, "stiffness_high": 0.95 * stiffness * keep}
    return found


def drawn(curves: dict[str, object], moved: pd.DataFrame) -> DrawnFiles:
    files = DrawnFiles()
    files.add(curves, moved)
    return files


@pytest.fixture(scope="module")
def made():
    report = _report()
    curves = _curves(report)
    files = list(report["file"])
    for file, value in ((WITHOUT_MOMENT, np.nan), (ZERO_MOMENT, 0.0)):
        curves["mz_source"][files.index(file)] = value
    moved = pd.DataFrame(
        {
            "file": "new/mine.tir",
            "coefficient": ["PDY1", "PKY1", "PCY1"],
            "from": [1.0, -20.0, 1.3],
            "to": [0.9, -18.123456, 1.3 + 1e-8],
        }
    )
    rows = listed([report], {*report["file"]} - {*OWN}, lambda file: TIRES.get(file[0], ""))
    said = ["302 files, to be as D would have measured them."]
    return str(translated_page("Translated to D", said, rows, drawn(curves, moved))), report, curves


@pytest.fixture(scope="module")
def driver(made, tmp_path_factory):
    needs_browser()
    folder = tmp_path_factory.mktemp("translated")
    place = folder / "a page #1.html"
    place.write_text(made[0], encoding="utf-8")
    with browser(folder) as driver:
        driver.get(place.as_uri())
        wait(driver, lambda: driver.find_element("css selector", "body").get_attribute("data-ready") == "yes")
        yield driver


def wait(driver, condition):
    from selenium.webdriver.support.ui import WebDriverWait

    return WebDriverWait(driver, 60).until(lambda _: condition())


def shown(driver) -> list[str]:
    script = "return [...document.querySelectorAll('#files button.file')].map(each => each.textContent)"
    return driver.execute_script(script)


def count(driver) -> str:
    return driver.find_element("id", "count").text


def reset(driver) -> None:
    driver.find_element("css selector", "#controls button[type=reset]").click()
    wait(driver, lambda: count(driver) == "302 files: 1 to 100")  # the page clears its search a moment later


def choose(driver, name: str, value: str) -> None:
    from selenium.webdriver.support.ui import Select

    Select(driver.find_element("id", name)).select_by_value(value)


def click_file(driver, name: str):
    button = next(b for b in driver.find_elements("css selector", "#files button.file") if b.text == name)
    driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", button)
    button.click()
    return wait(driver, lambda: driver.find_elements("css selector", "tr.detail td.detail"))[0]


def test_a_click_anywhere_in_a_row_opens_and_closes_it(driver):
    reset(driver)
    cell = driver.find_element("css selector", "#files tbody tr:not(.detail) td:nth-child(3)")
    driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", cell)
    for is_open in (True, False):
        cell.click()
        wait(driver, lambda: bool(driver.find_elements("css selector", "tr.detail")) is is_open)  # noqa: B023


def test_the_users_own_files_come_first_and_every_file_can_be_reached(driver):
    files = shown(driver)
    assert files[1] == "new/mine.tir"
    assert files[0].startswith("E/<script>")
    assert "⟨U+202E⟩" in files[0]
    assert count(driver) == "302 files: 1 to 100"
    turn = {name: driver.find_element("id", name) for name in ("previous", "next")}
    assert not turn["previous"].is_enabled()
    parts = [files]
    while turn["next"].is_enabled():
        turn["next"].click()
        parts.append(shown(driver))
    assert count(driver) == "302 files: 301 to 302"
    assert [len(part) for part in parts] == [100, 100, 100, 2]
    assert len({file for part in parts for file in part}) == 302
    turn["previous"].click()
    assert shown(driver) == parts[2]
    reset(driver)
    assert shown(driver) == files


def test_suppliers_are_summed_up_and_lead_to_their_files(driver):
    rows = driver.find_elements("css selector", "#suppliers tbody tr")
    cells = {row.text.split()[0]: row.text.split() for row in rows}
    assert cells["B"][1:] == ["251", "251", "0", "0", "0", "0", "30%"]
    assert cells["C"][1:] == ["30", "0", "0", "0", "30", "0", "–"]
    assert cells["E"][-2:] == ["1", "–"]  # an unknown supplier by its folder
    next(b for b in driver.find_elements("css selector", "#suppliers button") if b.text == "C").click()
    assert count(driver) == "30 of 302 files"
    assert all(file.startswith("C/") for file in shown(driver))
    reset(driver)


def test_search_and_filters(driver):
    driver.find_element("id", "search").send_keys("b_000 B/")
    assert count(driver) == "10 of 302 files"
    reset(driver)
    choose(driver, "verdict", "already unbiased")
    assert count(driver) == "20 of 302 files"
    choose(driver, "supplier", "C")
    assert count(driver) == "0 of 302 files"
    reset(driver)
    driver.find_element("id", "tire").send_keys("225/45")
    assert count(driver) == "30 of 302 files"
    reset(driver)
    choose(driver, "whose", "own")
    assert count(driver) == "2 of 302 files"
    reset(driver)


def test_what_is_unusual_in_a_file_is_counted_filtered_and_shown_on_a_click(driver):
    choose(driver, "noted", "some")
    assert shown(driver) == ["new/mine.tir"]
    (cell,) = driver.find_elements("css selector", "#files tbody tr:not(.detail) td:nth-child(7)")
    assert cell.text == "2"
    detail = click_file(driver, "new/mine.tir")
    assert (
        "Note on the file: PKY1 has two values\nNote on the file: <i>TYRESIDE</i> is neither" in detail.text
    )
    driver.find_element("css selector", "#files tr.open button.file").click()
    choose(driver, "noted", "none")
    assert count(driver) == "301 of 302 files: 1 to 100"
    reset(driver)
    driver.find_element("css selector", "[data-sort=noted]").click()
    driver.find_element("css selector", "[data-sort=noted]").click()
    assert shown(driver)[0] == "new/mine.tir"
    reset(driver)


def test_sorting(driver):
    choose(driver, "supplier", "B")
    for falling in (False, True):
        driver.find_element("css selector", "[data-sort=distance]").click()
        script = (
            "return [...document.querySelectorAll('#files tbody tr')].map(each => each.cells[4].textContent)"
        )
        values = [float(text) for text in driver.execute_script(script)]
        assert all((a >= b) if falling else (a <= b) for a, b in pairwise(values))
        assert values[0] == (0.9 if falling else 0.2)
    reset(driver)
    assert shown(driver)[1] == "new/mine.tir"


def _pixels(driver, panel: str, kind: str, load: int) -> np.ndarray:
    paths = driver.find_elements("css selector", f"figure[data-panel={panel}] path.{kind}.l{load}")
    assert len(paths) == 1, (panel, kind, load)
    return np.array(re.findall(r"[ML](\S+) (\S+?)(?=[LZ]|$)", paths[0].get_attribute("d")), dtype=float)


def _straight(pixels: np.ndarray, values: np.ndarray) -> None:
    """The pixels are a straight line of the values, downwards."""
    slope, start = np.polyfit(values, pixels, 1)
    assert slope < 0
    np.testing.assert_allclose(pixels, start + slope * values, atol=0.6)


def test_a_click_draws_source_translation_band_stiffness_and_coefficients(driver, made):
    _, report, curves = made
    i = list(report["file"]).index("new/mine.tir")
    detail = click_file(driver, "new/mine.tir")
    names = [f.get_attribute("data-panel") for f in detail.find_elements("css selector", "figure")]
    assert names == ["fy", "fx", "mz", "stiffness"]
    for name in DRAWN_OUTPUTS:
        for load in range(LOADS.size):
            source, middle, low, high = (
                curves[f"{name}_{part}"][i][load] for part in ("source", "middle", "low", "high")
            )
            pixels = np.concatenate(
                [_pixels(driver, name, kind, load)[:, 1] for kind in ("source", "middle", "band")]
            )
            _straight(pixels, np.concatenate([source, middle, high, low[::-1]]))
    stiffness = [curves[f"stiffness_{part}"][i] for part in ("source", "middle", "high", "low")]
    pixels = np.concatenate(
        [_pixels(driver, "stiffness", kind, 0)[:, 1] for kind in ("source", "middle", "band")]
    )
    _straight(pixels, np.concatenate([*stiffness[:3], stiffness[3][::-1]]))
    for text in (
        "slip angle (deg)",
        "Fy (kN)",
        "Mz (N m)",
        "stiffness (N/deg)",
        "normal load 6 kN",
        "90% band",
        "As estimated from the training files: D measures 6% more grip. The less certain",
        "The translation changes it by -10.0% on average.",
    ):
        assert text in detail.text
    assert "2 coefficients moved" in detail.text  # the third one by less than is shown of it
    assert "PKY1: -20 → -18.123" in detail.text
    SCREENSHOTS.mkdir(parents=True, exist_ok=True)
    for theme in ("light", "dark"):
        feature = {"name": "prefers-color-scheme", "value": theme}
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [feature]})
        driver.save_screenshot(str(SCREENSHOTS / f"translated_{theme}.png"))
    script = "return getComputedStyle(document.body).backgroundColor"
    assert driver.execute_script(script) == "rgb(22, 24, 26)"
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
    click = next(
        b for b in driver.find_elements("css selector", "#files button.file") if b.text == "new/mine.tir"
    )
    click.click()
    assert not driver.find_elements("css selector", "tr.detail")


def test_what_a_click_opens_fits_a_narrow_screen(driver):
    size = {"width": 400, "height": 900, "deviceScaleFactor": 1, "mobile": True}
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    reset(driver)
    choose(driver, "verdict", "refused")
    click_file(driver, "C/c_0007.tir")
    parts = driver.find_elements("css selector", "td.detail > *, td.detail figure > svg")
    assert parts
    assert max(part.rect["x"] + part.rect["width"] for part in parts) <= 400
    driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    next(b for b in driver.find_elements("css selector", "tr.open button.file")).click()
    wait(driver, lambda: not driver.find_elements("css selector", "tr.detail"))


def test_a_file_that_was_not_translated_shows_its_own_curves(driver):
    choose(driver, "verdict", "refused")
    detail = click_file(driver, "C/c_0007.tir")
    assert 'because of "<b>this</b>"' in detail.text
    assert len(detail.find_elements("css selector", "figure path.source")) == 3 * LOADS.size + 1
    assert not detail.find_elements("css selector", "path.band, path.middle")
    assert "90% band" not in detail.text
    assert "is applied" not in detail.text
    assert "The translation changes" not in detail.text
    driver.find_element("css selector", "#files tr.open button.file").click()
    reset(driver)


@pytest.mark.parametrize(
    ("file", "why"), [(WITHOUT_MOMENT, "does not state all"), (ZERO_MOMENT, "zero at every slip")]
)
def test_where_there_is_no_curve_the_page_says_why(driver, file, why):
    choose(driver, "verdict", "refused")
    detail = click_file(driver, file)
    names = [f.get_attribute("data-panel") for f in detail.find_elements("css selector", "figure")]
    assert names == ["fy", "fx", "stiffness"]
    assert re.search(rf"Aligning moment: not drawn, because .*{why}", detail.text)
    driver.find_element("css selector", "#files tr.open button.file").click()
    reset(driver)


def test_nothing_to_click_is_printed(driver):
    def seen(media: str) -> int:
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": media})
        parts = driver.find_elements("css selector", "#controls, #turns, .screen")
        return sum(part.is_displayed() for part in parts)

    assert seen("screen") == 5
    assert seen("print") == 0
    assert seen("") == 5


def test_nothing_of_a_file_name_runs_and_nothing_is_asked_for_elsewhere(driver, made):
    page = made[0]
    assert page.count("<script") == 2  # the data and the one that is allowed
    assert not re.search(
        r"\son\w+\s*=|\sstyle\s*=|javascript:", re.sub(r"<script>.*?</script>", "", page, flags=re.S)
    )
    script = """const made = document.createElement('script');
        made.textContent = 'window.hacked = 1'; document.body.append(made);
        return window.hacked === undefined"""
    assert driver.execute_script(script)
    assert driver.execute_script("return window.hacked") is None
    messages = [json.loads(entry["message"])["message"] for entry in driver.get_log("performance")]
    asked = [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]
    assert [address for address in asked if address.startswith(("http", "ws"))] == []
    errors = [entry["message"] for entry in driver.get_log("browser") if "favicon" not in entry["message"]]
    assert all("Content Security Policy" in each for each in errors), errors  # the script tried just now


def test_a_hostile_supplier_and_title_stay_text(tmp_path):
    needs_browser()
    report = _report().head(3).assign(source="</script><img src=x onerror=window.hacked=1>")
    drawn_files = drawn(_curves(report), pd.DataFrame())
    page = str(translated_page("<b>T", ["<i>line"], listed([report], set(report["file"])), drawn_files))
    assert "<img" not in page
    place = Path(tmp_path / "page.html")
    place.write_text(page, encoding="utf-8")
    with browser(tmp_path) as driver:
        driver.get(place.as_uri())
        wait(driver, lambda: count(driver) == "3 files")
        assert driver.title == "<b>T"
        assert driver.execute_script("return window.hacked") is None
        assert driver.find_element("css selector", "#suppliers tbody").text.startswith("</script><img")
