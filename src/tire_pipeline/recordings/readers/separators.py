"""Decimal signs and thousands separators of numbers in text."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

_OTHER = {".": ",", ",": "."}
_EXPONENT = r"(?:[eEdD][+-]?\d+)?"
_UNGROUPED = re.compile(rf"[+-]?\d+{_EXPONENT}")
_FORTRAN = re.compile(r"([\d.])[dD]([+-]?\d+)$")
_OTHER_GROUPS = re.compile("['\u2019 \u00a0\u202f]")
"""What separates thousands and is no decimal sign anywhere."""
_GROUPED_OTHERWISE = re.compile(rf"[+-]?\d{{1,3}}(?:{_OTHER_GROUPS.pattern}\d{{3}})+(?:[.,]\d*)?{_EXPONENT}")
_FEW_CELLS = 0.01
"""Share of a column's numbers that may be unlike the others: damaged cells."""
_NEAR_A_THOUSAND = 100.0
"""Numbers of a channel that is grouped above a thousand come that near to it from below."""


class _Form(NamedTuple):
    """How a number is written: what its text shows of the decimal sign.

    Parameters
    ----------
    decimal : str
        The decimal sign; of an ambiguous number ("2,750") the sign that it would be.
    grouped : bool
        Whether the other sign separates thousands.
    ambiguous : bool
        Whether the sign may as well separate thousands.
    """

    decimal: str
    grouped: bool = False
    ambiguous: bool = False


_INTEGER = _Form("")
_CELL_FORMS = [
    (re.compile(pattern.format(d=re.escape(d), t=re.escape(t), e=_EXPONENT)), form)
    for d, t in _OTHER.items()
    for pattern, form in (
        (r"[+-]?[1-9]\d{{0,2}}{d}\d{{3}}", _Form(d, ambiguous=True)),
        (r"[+-]?[1-9]\d{{0,2}}(?:{t}\d{{3}})+{d}\d*{e}", _Form(d, grouped=True)),
        (r"[+-]?[1-9]\d{{0,2}}(?:{t}\d{{3}}){{2,}}", _Form(d, grouped=True)),
        (r"[+-]?(?:\d+{d}\d*|{d}\d+){e}", _Form(d)),
    )
]


def plain(texts: pd.Series) -> pd.Series:
    r"""Texts whose numbers have the signs of a computer: minus, ``e`` for ``D``, no space or apostrophe.

    Examples
    --------
    >>> plain(pd.Series(["\u22121.5D+03", "2\u2019750.3", "1 234,5", "D-3", "a 1"])).tolist()
    ['-1.5e+03', '2750.3', '1234,5', 'D-3', 'a 1']
    """
    return texts.astype("string").map(_plain, na_action="ignore")


def _plain(text: str) -> str:
    text = _FORTRAN.sub(r"\1e\2", text.replace("\u2212", "-"))
    return _OTHER_GROUPS.sub("", text) if _GROUPED_OTHERWISE.fullmatch(text) else text


def _form(text: str) -> _Form | None:
    """Return how a number is written that is :func:`plain`; None if a text is no number."""
    if _UNGROUPED.fullmatch(text):
        return _INTEGER
    return next((form for pattern, form in _CELL_FORMS if pattern.fullmatch(text)), None)


def is_number(text: str, decimal: str) -> bool | None:
    """Whether a text is a number with a decimal sign; None if it is only where thousands are separated.

    Examples
    --------
    >>> is_number("2,750.3", "."), is_number("2,75", "."), is_number("2,750", ".")
    (True, False, None)
    """
    form = _form(_plain(text))
    if form is None:
        return False
    if form.decimal in ("", decimal):
        return True
    return None if form.ambiguous else False


def decimal_shown(texts: Iterable[str]) -> str:
    """Return the decimal sign that numbers show; empty if they show none, or both.

    Examples
    --------
    >>> decimal_shown(["2,750", "1"]), decimal_shown(["2,750", "0,5"]), decimal_shown(["2,750.3"])
    ('', ',', '.')
    """
    shown = {f.decimal for f in map(_form, map(_plain, texts)) if f and f.decimal and not f.ambiguous}
    return shown.pop() if len(shown) == 1 else ""


class Separators(NamedTuple):
    """Signs of the numbers of a column.

    Parameters
    ----------
    decimal : str
    thousands : str
        Empty if thousands are not separated.
    unclear : str
        A number that may be read in two ways, where the column does not tell; else empty.
    """

    decimal: str
    thousands: str = ""
    unclear: str = ""


def separators(texts: Sequence[str], decimal: str) -> Separators:
    """Find the decimal sign and the thousands separator of a column.

    Parameters
    ----------
    texts : sequence of str
        Its cells, which are :func:`plain`.
    decimal : str
        Decimal sign of the table, for a column that does not show its own.

    Returns
    -------
    Separators

    Examples
    --------
    >>> separators(["2,750.3", "999.5", "2,750"], ".")
    Separators(decimal='.', thousands=',', unclear='')
    >>> separators(["2,750", "3,125"], ".").unclear
    '2,750'
    """
    forms = [_form(text) for text in texts]
    count = Counter(forms)
    few = _FEW_CELLS * sum(n for form, n in count.items() if form)
    shown = {d: count[_Form(d)] + count[_Form(d, grouped=True)] for d in _OTHER}
    own = [d for d, n in shown.items() if n > few]
    if len(own) == 1:
        decimal = own[0]
    thousands = _OTHER[decimal]
    either = _Form(thousands, ambiguous=True)
    if len(own) > 1:
        grouped = [t for t, f in zip(texts, forms, strict=True) if f and f.grouped]
        return Separators(decimal, unclear=grouped[0] if grouped else "")
    if own and count[_Form(decimal, grouped=True)]:
        return Separators(decimal, thousands)
    if count[either] <= few:
        return Separators(decimal)
    others = [text for text, form in zip(texts, forms, strict=True) if form and form != either]
    if own and _up_to_a_thousand(others, decimal):
        return Separators(decimal, thousands)
    return Separators(decimal, unclear=texts[forms.index(either)])


def _up_to_a_thousand(texts: list[str], decimal: str) -> bool:
    """Whether numbers without a thousands separator come near to a thousand, and none is beyond it."""
    largest = float(np.max(np.abs(numbers(pd.Series(texts), Separators(decimal))), initial=0.0))
    return _NEAR_A_THOUSAND <= largest < 1000.0


def numbers(texts: pd.Series, signs: Separators) -> NDArray[np.float64]:
    """Return the numbers of a column of text, NaN where a cell is none.

    Parameters
    ----------
    texts : Series of str
    signs : Separators
    """
    if signs.thousands:
        t, d = re.escape(signs.thousands), re.escape(signs.decimal)
        whole = texts.str.fullmatch(rf"[+-]?[1-9]\d{{0,2}}(?:{t}\d{{3}})+(?:{d}\d*)?{_EXPONENT}")
        texts = texts.mask(whole.fillna(False), texts.str.replace(signs.thousands, "", regex=False))
    if signs.decimal != ".":
        if signs.thousands:
            texts = texts.mask(texts.str.contains(".", regex=False).fillna(False))
        texts = texts.str.replace(signs.decimal, ".", regex=False)
    return np.asarray(pd.to_numeric(texts, errors="coerce").to_numpy(dtype=float, na_value=np.nan))
