"""The day of the measurement, from the lines at the top of a ``.tir`` file.

The format has no key for it; laboratories write it into the header's comments, each in its own way. A day
that could be read in two ways does not count.
"""

from __future__ import annotations

import datetime as dt
import re

_HEADER_SECTION = re.compile(r"^[ \t]*\[([^\[\]\r\n]*)\]", re.MULTILINE)
_MOST_CHARACTERS = 20_000

_OTHER_EVENT = re.compile(
    r"(?<![a-zäöü])(?:creat|generat|modif|chang|revis|version|updat|saved|export|written|print|copyright|translat"
    r"|convert|valid|expir|licen[cs]e|source|fit|erstellt|geändert|gültig|gedruckt)|\(c\)|©|stamp|\$(?:Id|Date)\b",
    re.IGNORECASE,
)
_MEASUREMENT = re.compile(r"measur|\btest|record|\bmess|gemessen|prüf|versuch", re.IGNORECASE)
_DATE_WORD = re.compile(r"\bdate|datum", re.IGNORECASE)

_MONTHS = {
    name: number
    for number, names in enumerate(
        (
            "jan january januar",
            "feb february februar",
            "mar march mär märz mrz",
            "apr april",
            "may mai",
            "jun june juni",
            "jul july juli",
            "aug august",
            "sep sept september",
            "oct october okt oktober",
            "nov november",
            "dec december dez dezember",
        ),
        1,
    )
    for name in names.split()
}
_MONTH_NAME = "|".join(sorted(_MONTHS, key=len, reverse=True))
_END = r"(?![\w-]|[./]\d)"
_START = r"(?<![\w./\\-])"
_YEAR_FIRST = re.compile(rf"{_START}(\d{{4}})([-/.])(\d{{1,2}})\2(\d{{1,2}})(?:T\d\d[:\d.]*Z?)?{_END}")
_YEAR_LAST = re.compile(rf"{_START}(\d{{1,2}})([-/.]) ?(\d{{1,2}})\2 ?(\d{{4}}|\d{{2}}){_END}")
_NAMED_MONTH = re.compile(
    rf"{_START}(\d{{1,2}})(?:st|nd|rd|th)?[ .-]{{1,2}}({_MONTH_NAME})[ .,-]{{1,2}}(\d{{4}}){_END}",
    re.IGNORECASE,
)
_MONTH_FIRST = re.compile(
    rf"\b({_MONTH_NAME})[ .-]{{1,2}}(\d{{1,2}})(?:st|nd|rd|th)?,?(?: \d\d?:\d\d(?::\d\d)?)? (\d{{4}}){_END}",
    re.IGNORECASE,
)
_COMPACT = re.compile(rf"{_START}(\d{{4}})(\d\d)(\d\d){_END}")


def measurement_date(text: str) -> dt.date | None:
    """Read the day of the measurement from a file's header.

    The header is everything before the second section (the first one is usually ``[MDI_HEADER]``). Lines that
    name another event (created, modified, version, fitted, a stamp, ...) are passed over. Of the rest, those
    that name a measurement or a test count, or, where there is none, all.

    Read are ``2011-01-31``, ``2011/1/31``, ``2011.01.31``, ``31.01.2011`` (day first, as everywhere with
    points), ``31 Jan 2011``, ``31-Jan-2011``, ``31. Januar 2011``, ``January 31, 2011``, ``Mon Jan 31
    12:30:00 2011``, ``31/01/2011`` and ``01/31/2011`` (one number cannot be a month), and ``20110131`` in a
    line with the word date.

    Parameters
    ----------
    text : str
        Of the whole file or its beginning.

    Returns
    -------
    date or None
        None where there is no date, where the lines hold two different ones, or where one can be read in two
        ways: ``02/03/2011``, or a year of two digits.
    """
    first: set[dt.date | None] = set()
    rest: set[dt.date | None] = set()
    for line in _header(text).splitlines():
        if _OTHER_EVENT.search(line):
            continue
        (first if _MEASUREMENT.search(line) else rest).update(_dates(line))
    found = first or rest
    return found.pop() if len(found) == 1 else None


def _header(text: str) -> str:
    start = text[:_MOST_CHARACTERS]
    sections = [match for _, match in zip(range(2), _HEADER_SECTION.finditer(start), strict=False)]
    if sections and "HEADER" not in sections[0][1].upper():
        return start[: sections[0].start()]
    return start[: sections[1].start()] if len(sections) == 2 else start


def _dates(line: str) -> set[dt.date | None]:
    """All days in a line; None among them stands for one that can be read in two ways."""
    said = bool(_DATE_WORD.search(line) or _MEASUREMENT.search(line))
    found = {_day(m[1], m[3], m[4]) for m in _YEAR_FIRST.finditer(line)}
    found |= {_day(m[3], _MONTHS[m[2].lower()], m[1]) for m in _NAMED_MONTH.finditer(line)}
    found |= {_day(m[3], _MONTHS[m[1].lower()], m[2]) for m in _MONTH_FIRST.finditer(line)}
    if said:
        found |= {_day(m[1], m[2], m[3]) for m in _COMPACT.finditer(line)}
    found.discard(None)  # no day at all: a version, a size
    for one in _YEAR_LAST.finditer(line):
        days = _year_last(one)
        if len(days) == 1 and len(one[4]) == 4:
            found |= days
        elif days and (said or len(one[4]) == 4):
            found.add(None)
    return found


def _year_last(one: re.Match[str]) -> set[dt.date | None]:
    """Possible days for ``a.b.year``."""
    year = one[4] if len(one[4]) == 4 else f"20{one[4]}"
    days = {_day(year, one[3], one[1])}
    if one[2] != ".":
        days.add(_day(year, one[1], one[3]))
    return days - {None}


def _day(year: str | int, month: str | int, day: str | int) -> dt.date | None:
    if not 1950 <= int(year) < 2100:
        return None
    try:
        return dt.date(int(year), int(month), int(day))
    except ValueError:
        return None
