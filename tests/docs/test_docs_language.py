"""Stiff words stay out of pages, docstrings, comments and messages."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
STIFF = re.compile(
    r"\b(has a say|laid in parts|mended|nil|once more|drawn together|nats|told from chance|"
    r"left without a name|May tires that|drops doubles|looks? for doubles|finds out which)\b",
    re.IGNORECASE,
)
FOLDERS = {
    "src": ".py .html .js .css",
    "docs": ".md .py .yml",
    "conf": ".yml",
    "examples": ".py",
    "notebooks": ".ipynb",
}


def test_no_page_docstring_comment_or_message_has_them():
    files = [ROOT / "README.md", ROOT / "CONTRIBUTING.md"]
    for folder, suffixes in FOLDERS.items():
        files += [path for path in (ROOT / folder).rglob("*") if path.suffix in suffixes.split()]
    files = [path for path in files if (ROOT / "docs/history") not in path.parents]  # quotes what was said
    assert len(files) > 600
    found = {}
    for path in files:
        words = STIFF.findall(path.read_text(encoding="utf-8"))
        if words:
            found[str(path.relative_to(ROOT))] = words
    assert found == {}
