"""Size of the page of translated files, seconds until it can be used, and from a click to the drawing.

In a headless Chromium, from a file. Wall time; a click ends with the second frame after the curves are there.
Half of the clicks are on the first part of the list, half on its last full part.

Run: python benchmarks/bench_translated_page.py                          # 4,000 made-up files
     python benchmarks/bench_translated_page.py data/08_reporting/translated_files.html
"""

from __future__ import annotations

import argparse
import os
import shutil
import tempfile
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.reporting.translation.drawn_files import DrawnFiles
from tire_pipeline.reporting.translation.translated_files_page import translated_page
from tire_pipeline.reporting.translation.translated_rows import listed
from tire_pipeline.translation.curves.of_files import DRAWN_OUTPUTS

CLICKS = 20
LOADS, SLIPS = np.array([2000.0, 4000.0, 6000.0, 8000.0]), np.linspace(-0.2, 0.2, 41)
OPENED = """const done = arguments[0];
const look = () => document.body.dataset.ready ? done(performance.now()) : requestAnimationFrame(look);
look();"""
ROWS = "return document.querySelectorAll('#files button.file').length"
LIST_PART = (
    ROWS,
    f"""const [previous, next] = ["previous", "next"].map(name => document.getElementById(name));
while (!next.disabled) next.click();
previous.click();
{ROWS}""",
)
"""Scripts that turn the list to its first part, and to its last full one. They return the number of rows."""

CLICKED = """const [number, done] = arguments;
const button = document.querySelectorAll("#files button.file")[number];
button.scrollIntoView({block: "center"});
requestAnimationFrame(() => requestAnimationFrame(() => {
  const begin = performance.now();
  const look = () => {
    const there = document.querySelector("tr.detail path.middle, tr.detail path.source");
    if (!there) return requestAnimationFrame(look);
    requestAnimationFrame(() => {
      const taken = performance.now() - begin;
      button.click();
      done(taken);
    });
  };
  button.click();
  look();
}));"""


def made_up(count: int) -> str:
    """A page of translated files of made-up curves; none compresses like another."""
    report, curves, moved = made_up_results(count)
    tires = {file: f"{195 + 10 * (i % 9)}/55 rim 203.2" for i, file in enumerate(report["file"])}
    drawn = DrawnFiles()
    drawn.add(curves, moved, tires)
    rows = listed([report], set(tires), drawn.tire)
    return str(translated_page("Translated to D", ["Made up."], rows, drawn))


def made_up_results(count: int) -> tuple[pd.DataFrame, dict[str, Any], pd.DataFrame]:
    """Report, curves and moved coefficients of made-up files."""
    generator = np.random.default_rng(1)
    files = [f"{'ABCEF'[i % 5]}/tire_{i:04d}.tir" for i in range(count)]
    report = pd.DataFrame(
        {
            "file": files,
            "source": [file[0] for file in files],
            "verdict": "translated",
            "distance": generator.uniform(0.2, 1.0, count),
            "expected_rms_ratio": generator.uniform(0.1, 0.6, count),
            "supplier_known": "by its folder",
            "reason": "",
            "changes": "PDY1 +3%, PKY1 -5%",
            "bias_band": "",
            "protocol": "",
        }
    )
    curves: dict[str, Any] = {"files": files, "normal_load": LOADS, "slip": SLIPS}
    for name in DRAWN_OUTPUTS:
        stiffness, bend = generator.uniform(10, 30, (2, count, len(LOADS), 1))
        source = LOADS[:, None] * np.sin(1.4 * np.arctan(stiffness * SLIPS)) * (1 + 0.01 * bend * SLIPS)
        middle = source * generator.uniform(0.8, 1.2, (count, len(LOADS), 1))
        half = 0.02 * np.abs(middle) + generator.uniform(10, 60, (count, len(LOADS), 1))
        found = {"source": source, "middle": middle, "low": middle - half, "high": middle + half}
        curves |= {f"{name}_{part}": values for part, values in found.items()}
    own = generator.uniform(5e4, 2e5, (count, len(LOADS)))
    for part, share in {"source": 1.0, "middle": 0.9, "low": 0.85, "high": 0.95}.items():
        curves[f"stiffness_{part}"] = share * own
    names = [f"P{letter}Y{number}" for letter in "CDEKHV" for number in range(1, 4)]
    moved = pd.DataFrame([(file, name) for file in files for name in names], columns=["file", "coefficient"])
    moved = moved.assign(**{side: generator.normal(size=len(moved)) for side in ("from", "to")})
    return report, curves, moved


def measure(page: Path, profile: Path) -> tuple[float, list[float]]:
    """Milliseconds until the page can be used, and of each click."""
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    options.binary_location = str(shutil.which("chromium") or shutil.which("google-chrome"))
    for flag in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"):
        options.add_argument(flag)
    options.add_argument(f"--user-data-dir={profile}")
    driver = webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))
    driver.set_script_timeout(120)
    try:
        driver.get(page.resolve().as_uri())
        opened = driver.execute_async_script(OPENED)
        clicks = []
        for part in range(2):
            rows = driver.execute_script(LIST_PART[part])
            places = np.linspace(0, rows - 1, min(CLICKS // 2, rows)).astype(int)
            clicks += [driver.execute_async_script(CLICKED, int(place)) for place in places]
        return opened, clicks
    finally:
        driver.quit()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("page", type=Path, nargs="?")
    parser.add_argument("--files", type=int, default=4000)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        page = asked.page
        if page is None:
            page = Path(folder) / "page.html"
            page.write_text(made_up(asked.files), encoding="utf-8")
        size = page.stat().st_size / 1e6
        opened, clicks = measure(page, Path(folder) / "chromium")
    print(f"{page.name}: {size:.1f} MB; load of the machine {os.getloadavg()[0]:.1f}")
    print(f"can be used after {opened / 1e3:.2f} s")
    print(f"{len(clicks)} clicks: median {median(clicks) / 1e3:.3f} s, longest {max(clicks) / 1e3:.3f} s")


if __name__ == "__main__":
    main()
