"""The documentation builds strictly and works from a file: nothing is fetched, search finds."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "viz"))
from viz_browser import browser, needs_browser  # noqa: E402

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def site(tmp_path_factory) -> Path:
    """The site, built from this working copy, or what `make docs` has built before: TIRE_PIPELINE_SITE."""
    if "TIRE_PIPELINE_SITE" in os.environ:
        return ROOT / os.environ["TIRE_PIPELINE_SITE"]
    pytest.importorskip("material", reason="pip install -e .[docs]")
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", str(folder)]
    environment = os.environ | {"NO_MKDOCS_2_WARNING": "1"}
    built = subprocess.run(command, cwd=ROOT, env=environment, check=False, capture_output=True, text=True)
    assert built.returncode == 0, built.stdout + built.stderr
    return folder


def pages(site: Path) -> list[Path]:
    return sorted(site.rglob("*.html"))


def test_every_page_of_the_site_is_there(site):
    made = {str(page.relative_to(site)) for page in pages(site)}
    written = {
        str(page.relative_to(ROOT / "docs").with_suffix(".html")).replace("README", "index")
        for page in (ROOT / "docs").rglob("*.md")
    }
    assert written <= made
    assert {"reference/effects.html", "reference/pipelines.html", "reference/api.html"} <= made


def test_names_in_docstrings_are_links(site):
    api = (site / "reference" / "api.html").read_text("utf-8")
    assert '<a href="#tire_pipeline.tir.write_tir"><code>write_tir</code></a>' in api
    linked = re.findall(r'<a href="#([^"]+)"><code>', api)
    assert len(linked) > 10
    assert all(f'id="{anchor}"' in api for anchor in linked)
    assert re.findall(r":(?:func|class|meth|mod):", api) == []


def test_public_names_on_pages_lead_to_the_reference(site):
    api = (site / "reference" / "api.html").read_text("utf-8")
    page = (site / "explanation" / "mismatch.html").read_text("utf-8")
    anchors = re.findall(r'href="../reference/api.html#([^"]+)"[^>]*><code>', page)
    assert "tire_pipeline.mismatch.explain_mismatch" in anchors
    assert all(f'id="{anchor}"' in api for anchor in anchors)


def test_every_script_of_the_gallery_has_its_picture(site):
    scripts = sorted((ROOT / "docs/gallery").glob("*.py"))
    assert len(scripts) >= 12
    for script in scripts:
        assert (site / "gallery" / f"{script.stem}.png").read_bytes().startswith(b"\x89PNG")
        assert f'src="{script.stem}.png"' in (site / "gallery" / f"{script.stem}.html").read_text("utf-8")


def test_the_catalogue_and_the_registry_are_whole(site):
    from kedro.framework.project import pipelines
    from kedro.framework.startup import bootstrap_project

    from tire_pipeline.mismatch.effects import catalogue

    text = (site / "reference/effects.html").read_text("utf-8")
    assert all(f'id="{name}"' in text for name in catalogue())
    bootstrap_project(ROOT)
    text = (site / "reference/pipelines.html").read_text("utf-8")
    assert all(f'id="{name}"' in text for name in set(pipelines) - {"__default__", "story"})


def test_pages_open_without_a_network(site, tmp_path):
    """Each page is loaded from its file; every request to anywhere else would fail, and is a failure here."""
    needs_browser()
    with browser(tmp_path) as driver:
        driver.execute_cdp_cmd("Network.enable", {})
        driver.execute_cdp_cmd(
            "Network.setBlockedURLs", {"urls": ["http://*", "https://*", "ws://*", "wss://*"]}
        )
        asked, faults, broken = set(), [], []
        for page in pages(site):
            driver.get(page.as_uri())
            assert driver.title, page
            for entry in driver.get_log("performance"):
                message = json.loads(entry["message"])["message"]
                if message["method"] == "Network.requestWillBeSent":
                    asked.add(message["params"]["request"]["url"])
            faults += [(page.name, e["message"]) for e in driver.get_log("browser") if e["level"] == "SEVERE"]
            images = driver.execute_script(
                "return [...document.images].filter(i => i.complete && !i.naturalWidth).map(i => i.src)"
            )
            broken += [(page.name, src) for src in images]
    assert faults == []
    assert broken == []
    # The last two are the browser's own first page, which it opens before ours.
    own = ("file:", "data:", "blob:", "about:", "chrome:", "chrome-untrusted:")
    assert any("/bundle." in url for url in asked)
    assert {url for url in asked if not url.startswith(own)} == set()


def test_search_works_from_a_file(site, tmp_path):
    needs_browser()
    with browser(tmp_path) as driver:
        driver.get((site / "index.html").as_uri())
        box = driver.find_element("css selector", "input.md-search__input")
        driver.execute_script("arguments[0].focus()", box)
        box.send_keys("relaxation length")
        end = time.monotonic() + 60
        links: list[str] = []
        while not links and time.monotonic() < end:
            time.sleep(0.2)
            found = driver.find_elements("css selector", ".md-search-result__link")
            links = [link.get_attribute("href") for link in found]
    assert any("effects.html" in link for link in links), links


def test_every_page_has_a_policy_that_lets_no_other_script_run(site, tmp_path):
    needs_browser()
    for page in pages(site):
        head = page.read_text("utf-8").partition("<script")[0]
        assert "default-src 'none'" in head, page  # before anything that it is about
        assert "unsafe-inline'; img" in head  # attributes only
        assert "unsafe-eval" not in head
    with browser(tmp_path) as driver:
        driver.get((site / "index.html").as_uri())
        driver.execute_script(
            "const one = document.createElement('script'); one.textContent = 'window.hacked = 1';"
            "document.body.append(one);"
            "document.body.insertAdjacentHTML('beforeend', '<img src=x onerror=window.hacked=1>');"
        )
        time.sleep(0.5)
        assert driver.execute_script("return window.hacked") is None
        refused = [
            e["message"] for e in driver.get_log("browser") if "Content Security Policy" in e["message"]
        ]
    assert len(refused) == 2, refused


def test_light_and_dark_are_chosen_and_kept(site, tmp_path):
    needs_browser()
    colour = "return getComputedStyle(document.body).backgroundColor"
    with browser(tmp_path) as driver:
        media = [{"name": "prefers-color-scheme", "value": "light"}]
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "", "features": media})
        driver.get((site / "index.html").as_uri())
        light = driver.execute_script(colour)
        for _ in range(2):  # as the system, light, dark
            driver.find_element(
                "css selector", "label.md-header__button:not([hidden])[for^='__palette']"
            ).click()
        assert driver.execute_script(colour) != light
        dark = driver.execute_script(colour)
        driver.get((site / "reference" / "glossary.html").as_uri())
        assert driver.execute_script(colour) == dark
