"""Numbers as they stand in a ``.tir`` file."""

from __future__ import annotations

import math
import re

_TIR_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?", re.ASCII).fullmatch
_LONGEST_NUMBER = 100


def parse_number(text: str) -> float | None:
    """Return the number that a value's text stands for, or None if it is not one.

    Decimal point only; exponents with ``E`` or Fortran's ``D``. ``nan``, ``inf``, ``1_000`` and texts of more
    than 100 characters are not numbers; a number too large for a double comes back as infinity.

    Examples
    --------
    >>> parse_number("1.5D-03")
    0.0015
    >>> parse_number("1,5") is None
    True
    """
    if len(text) > _LONGEST_NUMBER or _TIR_NUMBER(text) is None:
        return None
    try:
        return float(text)
    except ValueError:
        return float(text.replace("D", "e").replace("d", "e"))


COMPUTED_DIGITS = 9
"""Significant digits of coefficients that were computed: far more than any measurement resolves."""


def format_number(value: float, digits: int | None = None) -> str:
    """Return the shortest text that reads back as exactly the same double, or as it rounded.

    Parameters
    ----------
    value : float
    digits : int, optional
        Significant digits to round to.

    Examples
    --------
    >>> format_number(2.0), format_number(1e-5), format_number(0.1), format_number(1.6966362490789926, 9)
    ('2', '1e-05', '0.1', '1.69663625')
    """
    text = repr(float(value if digits is None else f"{value:.{digits}g}"))
    return text[:-2] if text.endswith(".0") else text


def format_scaled(value: float, factor: float, digits: int | None = None) -> str:
    """Return the text of ``value / factor``, chosen so that text times factor gives ``value`` again if any
    does.

    Parameters
    ----------
    value : float
        In SI.
    factor : float
        SI units in one unit of the file.
    digits : int, optional
        Significant digits to round to.
    """
    if factor == 1.0 or digits is not None:
        return format_number(value / factor, digits)
    near = value / factor
    candidates = (near, math.nextafter(near, math.inf), math.nextafter(near, -math.inf))
    exact = (each for each in candidates if each * factor == value)
    return format_number(next(exact, near))
