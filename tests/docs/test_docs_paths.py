"""Files of code that pages name by hand are there: a move breaks this test, not the reader."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = [
    *(ROOT / name for name in ("README.md", "CONTRIBUTING.md")),
    *(page for page in sorted((ROOT / "docs").rglob("*.md")) if "history" not in page.parts),
]
NAMED = re.compile(r"`(?:python )?([\w./-]+/[\w.-]+\.(?:py|json|csv|yml|txt))(?:::\w+)?[^`]*`")
OF_A_RUN = "data/"
"""What a run makes is not in the repository."""


@pytest.fixture(scope="module")
def files() -> list[str]:
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, check=False, capture_output=True, text=True)
    if listed.returncode:
        return [str(path.relative_to(ROOT)) for path in ROOT.rglob("*.*") if ".venv" not in path.parts]
    return listed.stdout.splitlines()


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_files_that_a_page_names_are_there(page, files):
    named = {name for name in NAMED.findall(page.read_text("utf-8")) if not name.startswith(OF_A_RUN)}
    known = {
        name for name in named if any(f"/{file}".endswith(f"/{name.removeprefix('../')}") for file in files)
    }
    assert named - known == set()
