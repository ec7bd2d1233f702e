"""Make text from elsewhere (comments, names) safe to write into a ``.tir`` file."""

from __future__ import annotations

import textwrap
import unicodedata
from collections.abc import Iterable

_LONGEST_LINE = 150
_MOST_LINES = 200
_REPLACED = str.maketrans({"[": "(", "]": ")", "{": "(", "}": ")", "$": "_"})


def comment_lines(texts: Iterable[str]) -> list[str]:
    """Return comment texts as lines that no reader can mistake for anything else.

    Line breaks make several lines; other control and format characters become spaces; brackets become
    parentheses and ``$`` an underscore; lines are wrapped at 150 characters (readers with a fixed buffer cut
    at 200), and more than 200 lines are cut.

    Examples
    --------
    >>> comment_lines(["a\\n[UNITS]\\nLENGTH = 'mm' $x"])
    ['a', '(UNITS)', "LENGTH = 'mm' _x"]
    """
    lines = []
    for text in texts:
        for line in str(text).splitlines():
            lines += textwrap.wrap(_plain(line), _LONGEST_LINE) or [""]
    return lines[:_MOST_LINES]


def quoted(text: str) -> str:
    """Return a text as a quoted value on one line, at most 100 characters of it.

    Examples
    --------
    >>> quoted("it's\\n[X]")
    "'it`s (X)'"
    """
    plain = _plain(text).replace("'", "`").replace('"', "`").replace("!", "_")
    return f"'{plain[:100].strip()}'"


def _plain(text: str) -> str:
    kept = "".join(" " if unicodedata.category(each)[0] in "CZ" else each for each in text)
    return kept.translate(_REPLACED).strip()
