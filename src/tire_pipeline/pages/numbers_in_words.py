"""Numbers as they stand in a sentence or a table."""

from __future__ import annotations

import math
from collections.abc import Sequence

_NO_FIGURE = 1e12
"""No quantity of a tire is so large: only there a power of ten is read more easily than digits."""


def in_digits(value: float, most: int = 3) -> str:
    """Return a number with the digits that matter: no power of ten for a large one, a dash for none.

    Parameters
    ----------
    value : float
    most : int
        Significant digits. Digits before the decimal point are left out from 1e12 on only.

    Returns
    -------
    str

    Examples
    --------
    >>> in_digits(0.92731), in_digits(57.93), in_digits(999.7), in_digits(128062.4), in_digits(float("nan"))
    ('0.927', '57.9', '1,000', '128,062', '–')
    >>> in_digits(1234.56, 4), in_digits(0.00001234), in_digits(1e30)
    ('1,235', '1.23e-05', '1e+30')
    """
    if math.isnan(value):
        return "–"
    if math.isinf(value):
        return "∞" if value > 0 else "-∞"
    if abs(value) >= _NO_FIGURE:
        return f"{value:.{most}g}"
    text = f"{value:,.0f}" if abs(value) >= 10**most - 0.5 else f"{value:,.{most}g}"
    return "0" if text == "-0" else text


def first_of(names: Sequence[str], most: int) -> str:
    """Return names as a list; of many the first, and how many more there are.

    Parameters
    ----------
    names : sequence of str
    most : int
        So many are named.

    Returns
    -------
    str

    Examples
    --------
    >>> first_of(["SA", "FY"], 2), first_of(["SA", "FY", "FZ", "IA"], 2)
    ('SA, FY', 'SA, FY and 2 more')
    """
    more = len(names) - most
    return ", ".join(names[:most]) + (f" and {more:,} more" if more > 0 else "")


def how_many(count: int, one: str, several: str = "") -> str:
    """Return a count with its noun: ``1 sample``, ``3,648 samples``.

    Parameters
    ----------
    count : int
    one : str
        The noun if there is one of it.
    several : str
        The noun otherwise; by default with an s.

    Returns
    -------
    str

    Examples
    --------
    >>> how_many(1, "sample"), how_many(3648, "file"), how_many(0, "category", "categories")
    ('1 sample', '3,648 files', '0 categories')
    """
    return f"{count:,} {one if count == 1 else several or one + 's'}"
