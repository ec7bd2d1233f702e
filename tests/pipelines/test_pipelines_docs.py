"""What README and docs tell to run exists."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = [
    *(ROOT / name for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "data/01_raw/README.md")),
    *sorted((ROOT / "docs").rglob("*.md")),
]
REFERENCE = ROOT / "docs/reference"
GENERATED = {"api.md", "effects.md", "pipelines.md"}
"""Pages of the reference that `make docs` makes."""
COMMANDS = [
    ROOT / "README.md",
    ROOT / "docs/explanation/evidence.md",
    ROOT / "docs/how-to/retraining.md",
    ROOT / "docs/how-to/cluster.md",
]


def found(pattern: str, pages: list[Path] = PAGES) -> list[tuple[Path, str]]:
    return [(page, text) for page in pages for text in re.findall(pattern, page.read_text("utf-8"))]


def test_pages_of_commands_have_commands():
    assert len(found(r"`(?:python|pytest|kedro|make) ", [ROOT / "docs/explanation/evidence.md"])) > 10
    assert len(found(r"`pytest [^`]+`")) > 10


@pytest.mark.parametrize(
    "pattern",
    [
        r"`(?:python )?((?:benchmarks|docs|src|tests|conf|examples|notebooks)/[\w/.-]+\.\w+)",
        r"pytest (?:-m long )?(tests/[\w/.]+)",
        r"tire \w+ (?:[\w/.]+ )*(examples/[\w/.]+)",
    ],
)
def test_paths_exist(pattern):
    assert found(pattern)
    assert [(page, path) for page, path in found(pattern) if not (ROOT / path).exists()] == []


def test_links_lead_to_files_and_headings():
    """Links between pages, as mkdocs and a reader of the repository both follow them."""
    broken = []
    for page, link in found(r"\]\((?!https?:)([^)\s]+)\)"):
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        made = target.parent == REFERENCE and target.name in GENERATED
        if not made and (not target.exists() or (anchor and anchor not in anchors(target))):
            broken.append((str(page.relative_to(ROOT)), link))
    assert broken == []


def anchors(page: Path) -> set[str]:
    """The anchors of a page's headings, as mkdocs makes them."""
    titles = re.findall(r"^#+ (.+)$", page.read_text("utf-8"), re.M)
    return {re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", title).strip().lower()) for title in titles}


def test_chosen_tests_exist():
    pairs = [text for _, text in found(r"pytest (tests/[\w/.]+) -k (\w+)")]
    assert pairs
    for path, name in pairs:
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
