"""Names, comments and columns that would run in a page or a spreadsheet, and how to see that they do not."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable
from pathlib import Path

RUNS = "window.hacked=1"
IMAGE = f"<img src=x onerror={RUNS}>"
SCRIPT = f"</style></script><script>{RUNS}</script>"
SAID = f"! {SCRIPT}{IMAGE}\n$ {SCRIPT}\n"
"""Comments of a .tir file."""
FORMULA = re.compile(r"[=+\-@\t\r＝＋－＠]")
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.I)
UNSEEN = re.compile("[\u202a-\u202e\u2066-\u2069\u200b-\u200f]")
_OF_A_FILE = "img[src='x'], img[onerror], svg[onload], [onload], [onerror], iframe, object, embed"
_ONE_MORE = "const s = document.createElement('script'); s.textContent = 'window.hacked = 1';"


def assert_nothing_runs(driver: object, page: Path, *, scripts: int | None = 0) -> str:
    """Open a page; nothing of a file runs, is fetched or is refused, and its policy refuses one more script.

    Parameters
    ----------
    driver : selenium.webdriver.Chrome
    page : Path
    scripts : int or None
        How many the project itself has put there; None for kedro-viz, whose own have unseen characters.

    Returns
    -------
    str
        What the page shows.
    """
    text = page.read_text(encoding="utf-8")
    assert re.search(r"<head>.{0,200}Content-Security-Policy", text, re.S), page
    assert scripts is None or not UNSEEN.search(text), page
    driver.get_log("browser")  # of the page before
    driver.get(page.as_uri())
    for control in driver.find_elements("css selector", "summary"):
        control.click()
    shown = driver.find_element("css selector", "body").text
    assert not UNSEEN.search(shown), page
    assert driver.execute_script("return window.hacked") is None, page
    count = f'return document.querySelectorAll("{_OF_A_FILE}").length'
    assert driver.execute_script(count) == 0, page
    if scripts is not None:
        assert driver.execute_script("return document.scripts.length") == scripts, page
    said = [e["message"] for e in driver.get_log("browser") if e["level"] != "INFO"]
    refused = [message for message in said if "favicon" not in message]
    assert refused == [], page
    again = driver.execute_script(f"{_ONE_MORE} document.body.append(s); return window.hacked")
    assert again is None, page
    return shown


def hostile_cells(tables: Iterable[Path]) -> int:
    """How many cells would be formulas if they were not guarded; none of them is one."""
    guarded = 0
    for path in tables:
        text = path.read_text(encoding="utf-8")
        assert not UNSEEN.search(text), path
        for cell in (cell for row in csv.reader(text.splitlines()) for cell in row):
            assert not FORMULA.match(cell) or NUMBER.fullmatch(cell), (path, cell)
            guarded += bool(re.match("'[=+\\-@]", cell))
    return guarded
