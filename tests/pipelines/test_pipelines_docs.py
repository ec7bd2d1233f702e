"""What README and docs tell to run exists."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").glob("*.md"))]
COMMANDS = [
    ROOT / "README.md",
    ROOT / "docs/science.md",
    ROOT / "docs/retraining.md",
    ROOT / "docs/cluster.md",
]


def found(pattern: str, pages: list[Path] = PAGES) -> list[tuple[str, str]]:
    return [(page.name, text) for page in pages for text in re.findall(pattern, page.read_text("utf-8"))]


def test_pages_of_commands_have_commands():
    assert all(
        found(r"`(?:python|pytest|kedro|make) ", [page]) for page in COMMANDS if "science" in page.name
    )
    assert len(found(r"`pytest [^`]+`")) > 10


@pytest.mark.parametrize(
    "pattern",
    [
        r"`(?:python )?((?:benchmarks|docs|src|tests|conf)/[\w/.-]+\.\w+)",
        r"pytest (?:-m long )?(tests/[\w/.]+)",
        r"\]\((?!http)([^)#]+)\)",
    ],
)
def test_paths_exist(pattern):
    absent = [
        (page, path)
        for page, path in found(pattern)
        if not ((ROOT / path).exists() or (ROOT / "docs" / path).exists())
    ]
    assert absent == []


def test_chosen_tests_exist():
    for _, (path, name) in found(r"pytest (tests/[\w/.]+) -k (\w+)"):
        assert name in (ROOT / path).read_text("utf-8")


def test_make_targets_exist():
    targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text("utf-8"), re.M))
    assert {name for _, name in found(r"(?:`|^)make ([a-z-]+)", COMMANDS)} <= targets


def test_pipelines_exist_and_the_table_of_the_readme_names_them_all():
    from kedro.framework.project import pipelines
    from kedro.framework.startup import bootstrap_project

    bootstrap_project(ROOT)
    names = set(pipelines) - {"__default__", "story"}
    assert {name for _, name in found(r"kedro run --pipeline (\w+)")} <= names
    rows = [line for line in (ROOT / "README.md").read_text("utf-8").splitlines() if line.startswith("| `")]
    assert {name for row in rows for name in re.findall(r"`(\w+)`", row.split("|")[1])} == names
