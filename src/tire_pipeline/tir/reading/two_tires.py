"""Files that hold more than one tire: joined, or with a whole set of sections twice."""

from __future__ import annotations

from tire_pipeline.errors import TirSyntaxError
from tire_pipeline.tir.format.keys import FORCE_SECTIONS, names_coefficient, names_force_coefficient
from tire_pipeline.tir.format.values import parse_number
from tire_pipeline.tir.text.document import Entry, Scan, TirFile, TirSection

_HEADERS = frozenset(["MDI_HEADER", "MODEL"])
_OF_ONE_TIRE = FORCE_SECTIONS | _HEADERS | {"DIMENSION", "VERTICAL"}
_FEWEST_SECTIONS = 2
_FEWEST_VALUES = 5
"""A few values that stand twice are one tire's that someone edited."""


def refuse_two_tires(scan: Scan, file: TirFile) -> None:
    """Refuse a file that states most of a tire twice, with other values: the last ones would be a mixture.

    Two sections or more have to be there again, and five coefficients or more with another value.

    Parameters
    ----------
    scan : Scan
    file : TirFile

    Raises
    ------
    TirSyntaxError
        With the line of the first section that starts the second tire.
    """
    again = _sections_again(scan)
    if len({each.name for each in again}) < _FEWEST_SECTIONS:
        return
    other = _other_values(scan, min(each.line for each in again))
    if len(other) < _FEWEST_VALUES:
        return
    second = min(again, key=lambda each: each.line)
    old, new = other[0]
    sections = {each.name for each in again}
    raise TirSyntaxError(
        f"there are two tires in it: from this line on {len(sections)} sections are there a second time, "
        f"[{second.name}] first, and {len(other)} coefficients have another value ({new.key} is "
        f"{old.value[:20]} in line {old.line} and {new.value[:20]} in line {new.line})",
        path=file.path,
        line=second.line,
        todo="make one file of each tire: the second starts here",
    )


def _sections_again(scan: Scan) -> list[TirSection]:
    """Sections of a tire that were there before."""
    seen: set[str] = set()
    again = []
    for section in scan.sections:
        if section.name in seen and section.name in _OF_ONE_TIRE:
            again.append(section)
        seen.add(section.name)
    return again


def _other_values(scan: Scan, line: int) -> list[tuple[Entry, Entry]]:
    """Coefficients of forces that have a value before a line and another one after it."""
    before: dict[str, Entry] = {}
    other: dict[str, tuple[Entry, Entry]] = {}
    for entry in scan.entries:
        key = entry.key
        if not entry.value or not names_force_coefficient(key) or not names_coefficient(entry.section, key):
            continue
        if entry.line < line:
            before[key] = entry
        elif key in before and _number(entry) != _number(before[key]):
            other[key] = (before[key], entry)
    return list(other.values())


def _number(entry: Entry) -> float | str:
    number = parse_number(entry.value)
    return entry.value if number is None else number
