"""CSV tables that a spreadsheet opens as text: no cell begins a formula, and every character shows."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from typing import Any

import pandas as pd

from tire_pipeline.pages.visible_text import visible

# A spreadsheet that splits at another sign sees a new cell behind it; numbers stay numbers.
_FORMULA = re.compile(r"(^|[;|\n])('*(?=[=+\-@＝＋－＠]))")
_GUARDED = re.compile(r"(^|[;|\n])'('*[=+\-@＝＋－＠])")
_HARMLESS_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?|[+-](inf|nan)", re.I)
_LOOKS_ESCAPED = re.compile(r"⟨(?=U\+[0-9A-F]{4,6}⟩)")
_ESCAPED_CHARACTER = re.compile(r"⟨U\+([0-9A-F]{4,6})⟩")


def safe_text(text: str) -> str:
    r"""Return a cell as it is written: ``'`` before what begins a formula, unseen characters by their codes.

    Examples
    --------
    >>> safe_text("=1+1"), safe_text("-0.5"), safe_text("\tx")
    ("'=1+1", '-0.5', '⟨U+0009⟩x')
    """
    if _HARMLESS_NUMBER.fullmatch(text):
        return text
    return _FORMULA.sub(r"\1'\2", visible(_LOOKS_ESCAPED.sub("⟨U+27E8⟩", text)))


def original_text(text: str) -> str:
    """Turn :func:`safe_text` back.

    Examples
    --------
    >>> original_text("'=1+1")
    '=1+1'
    """
    return _ESCAPED_CHARACTER.sub(lambda found: chr(int(found[1], 16)), _GUARDED.sub(r"\1\2", text))


def safe_table(table: pd.DataFrame) -> pd.DataFrame:
    """Return a table with :func:`safe_text` in its texts and names of columns; numbers stay as they are."""
    return _each_text(table, safe_text)


def original_table(table: pd.DataFrame) -> pd.DataFrame:
    """Turn :func:`safe_table` back."""
    return _each_text(table, original_text)


def _each_text(table: pd.DataFrame, change: Callable[[str], str]) -> pd.DataFrame:
    once = cache(change)  # most texts stand in many rows

    def changed(value: Any) -> Any:
        return once(value) if isinstance(value, str) else value

    out = table.copy(deep=False)
    for i, kind in enumerate(table.dtypes):
        if not pd.api.types.is_numeric_dtype(kind):
            out.isetitem(i, table.iloc[:, i].map(changed, na_action="ignore"))
    return out.rename(columns=changed)
