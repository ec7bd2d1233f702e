"""Percentages among the texts of a table."""

from __future__ import annotations

import re


def is_percentage(value: object) -> bool:
    """Whether a text is a number and a percent sign, so that it stands on the right like a number.

    Examples
    --------
    >>> is_percentage("+12.5%"), is_percentage("5% of it"), is_percentage(5)
    (True, False, False)
    """
    return isinstance(value, str) and re.fullmatch(r"[+-]?[\d,.]+%", value) is not None
