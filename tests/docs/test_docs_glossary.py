"""A term is defined once, in the glossary; a page that uses it links to it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

DOCS = Path(__file__).resolve().parents[2] / "docs"
GLOSSARY = DOCS / "reference/glossary.md"
EVERYDAY = frozenset(
    "alternative background band batch confidence drift driver effect guard pair protocol set".split()
)
"""Terms that are everyday words, too: on many pages they mean just that."""
FOLDERS = ("tutorials", "how-to", "explanation", "reference", "decisions")
PAGES = sorted(page for folder in FOLDERS for page in (DOCS / folder).glob("*.md") if page != GLOSSARY)


def terms() -> list[str]:
    found = re.findall(r"^## (.+)$", GLOSSARY.read_text("utf-8"), re.MULTILINE)
    return [term.strip().lower() for term in found]


def sentences(page: str) -> str:
    """What is read as sentences: no code, tables, headings, formulas, generated parts and links."""
    page = re.sub(r"<!--.*?<!-- end -->", "", page, flags=re.DOTALL)
    page = re.sub(r"```.*?```|<math.*?</math>", "", page, flags=re.DOTALL)
    lines = [line for line in page.splitlines() if not line.startswith(("#", "|", "    ", "!["))]
    return re.sub(r"\[[^\]]*\]\([^)]*\)|`[^`]*`", "", "\n".join(lines))


def test_everyday_words_are_terms():
    assert set(terms()) >= EVERYDAY


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.stem)
def test_each_term_of_a_page_leads_to_the_glossary(path):
    page = path.read_text("utf-8")
    linked = {anchor.replace("-", " ") for anchor in re.findall(r"glossary\.md#([a-z-]+)", page)}
    text = sentences(page).lower()
    used = {term for term in terms() if re.search(rf"\b{term}s?\b", text)}
    assert used - EVERYDAY - linked == set()
