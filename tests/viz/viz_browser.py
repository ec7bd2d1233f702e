"""A project folder of its own, kedro-viz on it, and a headless Chromium."""

from __future__ import annotations

import contextlib
import io
import os
import shutil
import socket
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import pandas as pd
import pytest
from kedro.io import Version

from tire_pipeline.datasets import ReportPartsDataset

ROOT = Path(__file__).resolve().parents[2]
CHROMIUM = next((p for p in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if p), None)
DRIVER = shutil.which("chromedriver")
REPORT = "file,category,status,reason\nA/first.tir,A,read,\nA/bad.tir,A,set aside,line 3: not a number\n"


def needs_browser() -> None:
    """Skip where there is no browser; in CI that is a failure."""
    if CHROMIUM is None or DRIVER is None:
        reason = "no Chromium: apt-get install chromium chromium-driver"
        if os.environ.get("CI"):
            pytest.fail(reason)
        pytest.skip(reason)


def small_project(folder: Path) -> Path:
    """The project with one result in its data folder, as a run leaves it."""
    shutil.copy(ROOT / "pyproject.toml", folder)
    shutil.copytree(ROOT / "conf", folder / "conf")
    (folder / "src").mkdir()  # the installed package is used
    place, day = folder / "data/02_intermediate/ingest_report.json", "2026-01-01T00.00.00.000Z"
    report = [pd.read_csv(io.StringIO(REPORT))]
    ReportPartsDataset(filepath=str(place), version=Version(None, day)).save(report)
    return folder


@contextlib.contextmanager
def served(project: Path) -> Iterator[str]:
    """kedro-viz's address while it runs."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    log = project / "viz.log"
    command = [sys.executable, "-m", "tire_pipeline.lineage.serve", "--port", str(port)]
    with log.open("w") as output:
        server = subprocess.Popen([*command, "--project", str(project)], stdout=output, stderr=output)
    address = f"http://127.0.0.1:{port}/"
    try:
        for _ in range(600):
            assert server.poll() is None, log.read_text()
            with contextlib.suppress(OSError):
                urllib.request.urlopen(address, timeout=5).read()
                break
            time.sleep(0.2)
        else:
            pytest.fail(log.read_text())
        yield address
    finally:
        server.terminate()
        server.wait()


@contextlib.contextmanager
def browser(folder: Path, width: int = 1500, height: int = 900) -> Iterator[object]:
    """A headless Chromium that keeps a log of what it asks for."""
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    options.binary_location = str(CHROMIUM)
    window = f"--window-size={width},{height}"
    profile = f"--user-data-dir={folder / 'chromium'}"
    for flag in (
        "--headless=new",
        "--no-sandbox",
        "--disable-gpu",
        "--disable-dev-shm-usage",
        window,
        profile,
    ):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(DRIVER))
    driver.set_page_load_timeout(180)
    try:
        yield driver
    finally:
        driver.quit()


def read_page(driver: object, page: Path) -> str:
    """Open a page, unfold what can be unfolded, and return its text; the browser may complain of nothing."""
    driver.get(page.as_uri())
    for control in driver.find_elements("css selector", "summary"):
        control.click()
    assert [entry for entry in driver.get_log("browser") if entry["level"] == "SEVERE"] == []
    return driver.find_element("css selector", "body").text
