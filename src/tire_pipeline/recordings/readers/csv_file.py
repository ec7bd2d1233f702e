"""CSV and other delimited text: delimiter, decimal sign, header and unit row are found."""

from __future__ import annotations

import codecs
import csv
import re
import warnings
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings.conventions.canonical import RawChannel, RawRecording
from tire_pipeline.recordings.conventions.channel_names import find_channel
from tire_pipeline.recordings.conventions.units import find_unit
from tire_pipeline.recordings.conventions.units_in_names import split_unit
from tire_pipeline.recordings.readers.no_text import no_text
from tire_pipeline.recordings.readers.separators import (
    Separators,
    decimal_shown,
    is_number,
    numbers,
    plain,
    separators,
)
from tire_pipeline.recordings.readers.time_stamps import seconds_of
from tire_pipeline.recordings.whole_rows import said_of_unread

_HEAD_BYTES = (1 << 16, 1 << 20, 1 << 24)  # the next where no row of numbers is whole in the one before
_MOST_PREAMBLE = 200
_MOST_CELLS = 20_000
"""Of the first rows, in which the decimal sign is looked for."""
_EMPTY = {"", "nan", "na", "n/a", "null", "none", "-nan", "inf", "-inf", "+inf"}
_TEMPERATURE = re.compile(r"\bdeg ([CFcf])\b")
_MOST_HEADER_ROWS = 4
_COMMENTS = ("#", "%", "//", "!")
_SIGNS = ((",", "."), (",", ","), (";", "."), (";", ","), ("\t", "."), ("\t", ","), (" ", "."))
"""Delimiters, and decimal signs of their tables."""


@dataclass(frozen=True)
class _TableLayout:
    delimiter: str
    decimal: str
    header: list[str]
    units: list[str] | None
    data_line: int  # counted from 0
    encoding: str
    comments: list[str]
    nameless: bool


def read_csv(path: Path) -> RawRecording:
    """Read delimited text.

    Parameters
    ----------
    path : Path

    Returns
    -------
    RawRecording

    Raises
    ------
    RecordingError
        No header, no numbers, rows of different length, or no text at all.
    """
    layout = _find_layout(path)
    table = _table(path, layout)
    if table.empty:
        raise RecordingError("no data rows", where=str(path))
    notes = ["columns without a name are left out"] if layout.nameless else []
    channels = []
    for index, name in enumerate(layout.header):
        column = table[index]
        if _other_sign(column, layout.decimal):  # as they stand: some may have been read as numbers
            column = _table(path, layout, usecols=[index], dtype=str)[index]
        unit = layout.units[index] if layout.units else None
        channel = _channel(column, name, unit, layout.decimal, notes, path)
        if channel is not None:
            channels.append(channel)
    if not channels:
        raise RecordingError("no column holds numbers", where=str(path))
    return RawRecording("CSV", channels, notes=notes, comments=layout.comments)


def _table(path: Path, layout: _TableLayout, **more: Any) -> pd.DataFrame:
    """Read the rows of numbers, columns by their number; those to the right of the last name are left out."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", pd.errors.ParserWarning)
            return pd.read_csv(
                path,
                sep=r"\s+" if layout.delimiter == " " else layout.delimiter,
                decimal=layout.decimal,
                skiprows=layout.data_line,
                header=None,
                names=range(len(layout.header)),
                index_col=False,
                encoding=layout.encoding,
                encoding_errors="replace",
                na_values=sorted(_EMPTY - {"inf", "-inf", "+inf"}),
                skipinitialspace=True,
                quotechar='"',
                low_memory=True,
                **more,
            )
    except (ValueError, OverflowError, UnicodeError, IndexError) as error:
        said = " ".join(str(error).removeprefix("Error tokenizing data. C error: ").split())
        raise RecordingError(
            f"rows cannot be read ({said})",
            where=str(path),
            todo="every row must have as many fields as the header",
        ) from error


def _find_layout(path: Path) -> _TableLayout:
    for size in _HEAD_BYTES:
        with path.open("rb") as file:
            head = file.read(size)
        whole = len(head) < size
        layout = _layout_of(head, whole, path)
        if layout is not None:
            return layout
        if whole:
            break
    lines = min(len(head.splitlines()), _MOST_PREAMBLE + 20)
    raise RecordingError(
        f"no row of numbers in the first {lines} lines"
        if lines > 1
        else "there is one line, and no row of numbers",
        where=str(path),
        todo="give a text table with the channels' names first and rows of numbers below them",
    )


def _layout_of(head: bytes, whole: bool, path: Path) -> _TableLayout | None:
    """Where the table begins; None if no row of numbers is whole in this much of the file."""
    encoding = "utf-8-sig"
    if head[:2] in (b"\xff\xfe", b"\xfe\xff"):
        encoding = "utf-16"
    elif b"\x00" in head:
        raise no_text(head, str(path))
    try:
        text = codecs.getincrementaldecoder(encoding)().decode(head, final=whole)
    except UnicodeDecodeError:
        encoding = "latin-1" if encoding != "utf-16" else encoding
        text = head.decode(encoding, errors="replace")
    # Only what pandas takes for line ends too.
    lines = re.split(r"\r\n|\n|\r", text)
    lines = lines[: len(lines) if whole else -1][: _MOST_PREAMBLE + 20]
    found = {signs: first for signs in _SIGNS if (first := _first_numbers(lines, *signs))}
    if not found:
        return None
    delimiter, decimal = max(found, key=lambda signs: (found[signs].fields, found[signs].numbers))
    rows = [_fields(s, delimiter) for s in lines[found[delimiter, decimal].line :]]
    shown = decimal_shown(islice((cell for row in rows for cell in row), _MOST_CELLS))
    decimal = shown if (delimiter, shown) in found else decimal
    fields, _, line = found[delimiter, decimal]
    header, units = _header_above(lines, line, fields, delimiter)
    if header is None:
        todo = "put a row with the channels' names first, with as many fields as the rows below it"
        cells = _fields(lines[line], delimiter)
        if not is_number(cells[0], decimal) and all(is_number(cell, decimal) for cell in cells[1:]):
            todo += (
                f"; if {', '.join(cells[1:4])} are loads, put one row for each point, with slip_angle, "
                "normal_load and fy"
            )
        raise RecordingError(
            f"no header with {fields} names above the first row of numbers",
            where=f"{path}:{line + 1}",
            todo=todo,
        )
    comments = [s.strip() for s in lines[:line] if s.strip().startswith(_COMMENTS)]
    nameless = any(len(row) > len(header) for row in rows)
    return _TableLayout(delimiter, decimal, header, units, line, encoding, comments, nameless)


def _fields(line: str, delimiter: str) -> list[str]:
    """The cells of a line up to the last one that is not empty."""
    parts = _cells(line, delimiter)
    while len(parts) > 1 and parts[-1] == "":
        parts.pop()
    return parts


def _cells(line: str, delimiter: str) -> list[str]:
    if delimiter == " ":
        return line.split()
    parts = line.split(delimiter)
    if '"' in line and len(parts) > 1 and len(line) < csv.field_size_limit():
        parts = next(csv.reader([line], delimiter=delimiter, skipinitialspace=True), [])
    return [p.strip().strip('"').strip() for p in parts]


class _First(NamedTuple):
    """The first row that is made of numbers (and gaps)."""

    fields: int
    numbers: int
    line: int


def _first_numbers(lines: list[str], delimiter: str, decimal: str) -> _First | None:
    for index, line in enumerate(lines):
        if not line.strip() or line.lstrip().startswith(_COMMENTS):
            continue
        parts = _fields(line, delimiter)
        found = [is_number(p, decimal) for p in parts if p.lower() not in _EMPTY]
        numbers, others = found.count(True), found.count(False)
        if numbers and numbers >= 2 * others:
            return _First(len(parts), numbers, index)
    return None


def _header_above(
    lines: list[str], data: int, fields: int, delimiter: str
) -> tuple[list[str] | None, list[str] | None]:
    """The row of names above the data and, where there is one, the row of units.

    Beside them there may be rows of descriptions or sources: the names are the row with most known channels,
    the nearest to the data of several; the nearest that holds no units where none is known.
    """
    rows = _rows_above(lines, data, fields, delimiter)
    if not rows:
        return None, None
    of_units = [_are_units(row) for row in rows]
    named = [i for i in range(len(rows)) if not of_units[i]] or [0]
    at = max(named, key=lambda i: sum(map(_is_channel, rows[i])))  # the nearest of several
    header = rows[at]
    units = next((row for i, row in enumerate(rows) if i != at and of_units[i]), None)
    if units is None:
        return header, None
    units = [cell.strip("[]() ") for cell in units]
    return header, [*units, *[""] * (len(header) - len(units))][: len(header)]


def _rows_above(lines: list[str], data: int, fields: int, delimiter: str) -> list[list[str]]:
    """Rows of as many cells as the data, the nearest first, up to the first of another length."""
    rows: list[list[str]] = []
    for line in reversed(lines[:data]):
        text = line.strip()
        if not text:
            continue
        for mark in _COMMENTS:
            if text.strip('"').startswith(mark):
                text = text.strip('"')[len(mark) :].strip()
                break
        parts = _fields(_TEMPERATURE.sub(r"deg\1", text) if delimiter == " " else text, delimiter)
        if 1 < len(parts) < fields <= len(_cells(text, delimiter)) and _are_units(parts):
            parts = _cells(text, delimiter)  # the last columns have no unit
        if len(parts) >= fields or (rows and len(parts) == len(rows[0])):
            rows.append(parts)
        if len(rows) == _MOST_HEADER_ROWS:
            break
    return rows


def _is_channel(cell: str) -> bool:
    return find_channel(split_unit(cell)[0]) is not None


def _are_units(row: list[str]) -> bool:
    """Whether a row is one of units: more of them are units than are names of channels."""
    known = sum(find_unit(cell) is not None for cell in row if cell)
    named = sum(_is_channel(cell) for cell in row if cell)
    return known > named and known >= sum(bool(cell) for cell in row) / 2


def _other_sign(column: pd.Series, decimal: str) -> bool:
    """Whether cells of text hold the sign that is not the decimal sign, as numbers do."""
    if pd.api.types.is_numeric_dtype(column) or pd.api.types.is_bool_dtype(column):
        return False
    return _shows_other_sign(plain(column).str.strip(), decimal)


def _shows_other_sign(text: pd.Series, decimal: str) -> bool:
    """The same of text that is :func:`plain`."""
    like_numbers = text.str.fullmatch(r"[+-]?[\d.,]+(?:[eEdD][+-]?\d+)?")
    return bool((like_numbers & text.str.contains("," if decimal == "." else ".", regex=False)).any())


def _channel(
    column: pd.Series, name: str, unit: str | None, decimal: str, notes: list[str], path: Path
) -> RawChannel | None:
    """A column's numbers; other cells become NaN with a note, a column of text is dropped."""
    if pd.api.types.is_numeric_dtype(column) or pd.api.types.is_bool_dtype(column):
        return RawChannel(name, unit, column.to_numpy(dtype=float))
    text = plain(column).str.strip()
    signs = Separators(decimal)
    if _shows_other_sign(text, decimal):
        signs = separators(text.dropna().tolist(), decimal)
        notes += _said_of(signs, name, decimal)
    if signs.unclear and _is_channel(name):
        raise RecordingError(
            f"{name}: {signs.unclear!r} may have a decimal sign or a thousands separator, the column does "
            "not tell",
            where=str(path),
            todo="export it without thousands separators",
        )
    if signs.unclear:
        return None
    values = numbers(text, signs)
    lost = (np.isnan(values) & text.notna()).to_numpy(dtype=bool)
    if np.isnan(values).all():
        seconds = _seconds(column, decimal, name, notes)
        if seconds is not None:
            return RawChannel(name, "s", seconds)
        if text.notna().any():
            notes.append(f"{name}: text, left out")
            return None
    if lost.any():
        notes.append(said_of_unread(name, lost, str(column.iloc[int(lost.argmax())]).strip()))
    return RawChannel(name, unit, values)


def _said_of(signs: Separators, name: str, decimal: str) -> list[str]:
    """Say how the numbers of a column were read, if not as those of the table."""
    if signs.unclear:
        return [f"{name}: left out, {signs.unclear!r} may have a decimal sign or a thousands separator"]
    if signs.thousands:
        return [f"{name}: {signs.thousands!r} separates thousands, {signs.decimal!r} is the decimal sign"]
    return [f"{name}: {signs.decimal!r} is the decimal sign"] if signs.decimal != decimal else []


def _seconds(column: pd.Series, decimal: str, name: str, notes: list[str]) -> NDArray[np.float64] | None:
    """Dates or hours of a time column in seconds from the first; None if it holds none."""
    hit = find_channel(split_unit(name)[0])
    if not hit or hit[0].name != "time" or not column.notna().any():
        return None
    found = seconds_of(column.astype("string").str.strip(), decimal)
    if found is None:
        return None
    notes.append(f"{name}: {found.kind}, counted in seconds from the first")
    return found.seconds
