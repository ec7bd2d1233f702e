"""Show texts from files on pages and in terminals: control characters become visible."""

from __future__ import annotations

import logging
import re
import unicodedata
from typing import Any

from tire_pipeline.file_names import printable

_UNSEEN = ("Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp")
_PERHAPS_UNSEEN = re.compile(r"[^\n\x20-\x7e]")


def visible(text: object) -> str:
    r"""Return a text from a file as it can be shown: control and direction characters by their code points.

    Bytes of a file's name that are not UTF-8 become ``\xNN``, as everywhere.

    Examples
    --------
    >>> visible("a\u202erit.")
    'a⟨U+202E⟩rit.'
    """
    return _PERHAPS_UNSEEN.sub(
        lambda found: f"⟨U+{ord(found[0]):04X}⟩" if unicodedata.category(found[0]) in _UNSEEN else found[0],
        printable(str(text)),
    )


def visible_texts(value: Any) -> Any:
    r"""Return what JSON can hold with all its texts, names of members too, by :func:`visible`.

    Examples
    --------
    >>> visible_texts({"a\u202e": ["\u2066b", 1.5]})
    {'a⟨U+202E⟩': ['⟨U+2066⟩b', 1.5]}
    """
    if isinstance(value, str):
        return visible(value)
    if isinstance(value, dict):
        return {visible_texts(name): visible_texts(each) for name, each in value.items()}
    return [visible_texts(each) for each in value] if isinstance(value, list) else value


class VisibleFormatter(logging.Formatter):
    r"""Lines of a log in which names and texts of files neither colour the terminal nor turn lines round.

    Parameters
    ----------
    lines : logging.Formatter
        Makes the lines.

    Examples
    --------
    >>> record = logging.makeLogRecord({"msg": "\x1b[31ma.tir"})
    >>> VisibleFormatter(logging.Formatter()).format(record)
    '⟨U+001B⟩[31ma.tir'
    """

    def __init__(self, lines: logging.Formatter) -> None:
        super().__init__()
        self._lines = lines

    def format(self, record: logging.LogRecord) -> str:
        """The line, by :func:`visible`."""
        return visible(self._lines.format(record))
