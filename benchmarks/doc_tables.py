"""Tables that benchmarks write into pages of docs/, between two marks."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

END = "<!-- end -->"


def markdown(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """One table; a row a line."""
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join([*lines, *("| " + " | ".join(row) + " |" for row in rows)])


def write_between(page: Path, begin: str, text: str) -> None:
    """Put a text between ``begin`` and the next ``<!-- end -->`` of a page."""
    before, rest = page.read_text().split(begin)
    page.write_text(f"{before}{begin}\n\n{text}\n\n{END}{rest.split(END, 1)[1]}")
