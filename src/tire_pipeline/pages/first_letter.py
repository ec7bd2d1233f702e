"""The first letter of a text, as it stands at the begin of a sentence or within one."""

from __future__ import annotations


def first_large(text: str) -> str:
    """Return a text that begins a sentence.

    Examples
    --------
    >>> first_large("load and Fy agree"), first_large("")
    ('Load and Fy agree', '')
    """
    return f"{text[:1].upper()}{text[1:]}"


def first_small(text: str) -> str:
    """Return a text that goes on with a sentence.

    Examples
    --------
    >>> first_small("Record Fy again.")
    'record Fy again.'
    """
    return f"{text[:1].lower()}{text[1:]}"
