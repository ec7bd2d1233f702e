"""How results look in a notebook."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape


def card(title: str, text: str = "", header: Sequence[str] = (), rows: Iterable[Sequence[str]] = ()) -> str:
    """Return a title, a paragraph and a small table as HTML; all text is escaped.

    Parameters
    ----------
    title, text : str
    header : sequence of str
    rows : iterable of sequence of str
        Cells; numbers already with the digits that matter.

    Examples
    --------
    >>> card("<tire>")
    '<div><b>&lt;tire&gt;</b></div>'
    """
    parts = [f"<b>{escape(title)}</b>"]
    if text:
        parts.append(f"<p>{escape(text)}</p>")
    cells = ["".join(f"<td>{escape(cell)}</td>" for cell in row) for row in rows]
    if cells:
        head = "".join(f"<th>{escape(name)}</th>" for name in header)
        parts.append(f"<table><tr>{head}</tr>{''.join(f'<tr>{cell}</tr>' for cell in cells)}</table>")
    return f"<div>{''.join(parts)}</div>"
