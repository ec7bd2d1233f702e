"""TYDEX 1.3 (Unrau and Zamow: TYDEX-Format, Description and Reference Manual, 1997)."""

from __future__ import annotations

import math
import re
from array import array
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings.conventions.canonical import RawChannel, RawRecording
from tire_pipeline.recordings.conventions.units import find_unit, number_of

# Columns of the parameter sections: key 1-10, comment 11-40, unit 41-50, values of ten each.
_KEY_END, _COMMENT_END, _UNIT_END = 10, 40, 50


@dataclass(frozen=True)
class _Scale:
    name: str
    unit: str
    factor: float
    before: float
    after: float


def read_tydex(path: Path) -> RawRecording:
    """Read a TYDEX file: header, comments, constants, channels and data.

    Physical value = factor (measured + offset1) + offset2, as in the standard. Lines that begin
    with `!` are comments. Data rows may be wrapped over several lines.

    Parameters
    ----------
    path : Path

    Returns
    -------
    RawRecording

    Raises
    ------
    RecordingError
        A section is missing, or a line cannot be read; with its number.
    """
    sections, comments, rows = _sections(path)
    if "MEASURCHANNELS" not in sections or rows is None:
        raise RecordingError(
            "no **MEASURCHANNELS and **MEASURDATA: a TYDEX file without measurements",
            where=str(path),
            todo="check that it is a measurement file, not one of model parameters",
        )
    notes: list[str] = []
    scales = [_scale(path, n, s, notes) for n, s in sections["MEASURCHANNELS"]]
    if not scales:
        raise RecordingError("**MEASURCHANNELS is empty", where=str(path))
    data = rows.table(len(scales))
    channels = []
    for index, scale in enumerate(scales):
        values = data[:, index]
        if (scale.factor, scale.before, scale.after) != (1.0, 0.0, 0.0):
            with np.errstate(over="ignore", invalid="ignore"):
                values = scale.factor * (values + scale.before) + scale.after
        channels.append(RawChannel(scale.name, scale.unit or None, values))
    constants: dict[str, dict[str, object]] = {}
    for name in ("HEADER", "CONSTANTS", "MODELPARAMETERS"):
        for _, line in sections.get(name, []):
            key, entry = _constant(line)
            if key:
                constants.setdefault(key, entry)
    _from_constants(channels, constants, len(data), notes)
    return RawRecording("TYDEX", channels, constants, notes, comments)


class _MeasuredRows:
    """The numbers of the data section, gathered line by line in little memory."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._values = array("d")
        self._widths: dict[int, int] = {}  # width of a line -> the first line of that width

    def add(self, number: int, line: str) -> None:
        words = line.split(";") if ";" in line else line.replace(",", " ").split()
        try:
            values = [float(w.replace("D", "E").replace("d", "e")) for w in words]
        except ValueError as error:
            raise RecordingError(
                f"a data row holds something other than numbers ({error})",
                where=f"{self._path}:{number}",
                todo="comment lines begin with `!`",
            ) from error
        self._values.extend(values)
        self._widths.setdefault(len(values), number)

    def table(self, columns: int) -> NDArray[np.float64]:
        """One row a measurement; rows may have been wrapped over shorter lines."""
        flat = np.frombuffer(self._values, dtype=np.float64) if self._values else np.empty(0)
        if flat.size == 0:
            raise RecordingError("**MEASURDATA is empty", where=str(self._path))
        wrapped = max(self._widths) < columns and flat.size % columns == 0
        if set(self._widths) == {columns} or wrapped:
            return flat.reshape(-1, columns)
        first = min(line for width, line in self._widths.items() if width != columns)
        raise RecordingError(
            f"a data row does not hold {columns} numbers, one for each channel",
            where=f"{self._path}:{first}",
            todo="check that **MEASURCHANNELS lists every column",
        )


def _sections(path: Path) -> tuple[dict[str, list[tuple[int, str]]], list[str], _MeasuredRows | None]:
    """Lines by section, with their numbers; the free text of **COMMENTS; the data."""
    found: dict[str, list[tuple[int, str]]] = {}
    comments: list[str] = []
    current: str | None = None
    rows: _MeasuredRows | None = None
    with path.open(encoding="latin-1", newline=None) as file:
        for number, line in enumerate(file, 1):
            line = line.rstrip()
            if line.startswith("**"):
                current = line[2:].strip().upper()
                if current == "END":
                    break
                if current == "MEASURDATA":
                    if rows is not None:
                        raise RecordingError(
                            "a second **MEASURDATA",
                            where=f"{path}:{number}",
                            todo="split the file: one measurement each",
                        )
                    rows = _MeasuredRows(path)
                found.setdefault(current, [])
            elif current == "COMMENTS":
                comments.append(line.lstrip("! "))
            elif not line.strip() or line.lstrip().startswith("!") or current is None:
                continue
            elif current == "MEASURDATA" and rows is not None:
                rows.add(number, line)
            else:
                found[current].append((number, line))
    return found, [c for c in comments if c], rows


def _parts(line: str) -> tuple[str, str, str, list[str]]:
    """Key, comment, unit and values by columns; by wide blanks where columns are not kept."""
    line = line.expandtabs(8)
    key, comment = line[:_KEY_END].strip(), line[_KEY_END:_COMMENT_END].strip()
    unit, rest = line[_COMMENT_END:_UNIT_END].strip(), line[_UNIT_END:]
    kept = " " not in key and (not line[_KEY_END:].strip() or len(line) > _COMMENT_END)
    # Where a word runs over a column border the columns were not kept.
    for border in (_COMMENT_END, _UNIT_END):
        if len(line) > border and line[border - 1] != " " and line[border] != " ":
            kept = kept and border == _COMMENT_END and find_unit(unit) is not None
    if kept:
        return key, comment, unit, rest.split()
    pieces = re.split(r"\s{2,}", line.strip())
    values: list[str] = []
    while len(pieces) > 1 and number_of(pieces[-1]) is not None:
        values.insert(0, pieces.pop())
    unit = pieces.pop() if len(pieces) > 1 and find_unit(pieces[-1]) else ""
    return pieces[0].split()[0], " ".join(pieces[1:]), unit, values


def _scale(path: Path, number: int, line: str, notes: list[str]) -> _Scale:
    key, _, unit, values = _parts(line)
    if not key:
        raise RecordingError("a channel without a key", where=f"{path}:{number}")
    numbers = [number_of(v) for v in values[:3]]
    if any(n is None or not math.isfinite(n) for n in numbers):
        raise RecordingError(
            f"channel {key}: factor and offsets are {' '.join(values[:3])!r}",
            where=f"{path}:{number}",
            todo="three numbers are wanted: factor, offset1, offset2",
        )
    if len(numbers) < 3:
        notes.append(f"{key}: factor or offsets not given; 1 and 0 assumed")
    filled = [float(n) for n in numbers if n is not None]
    filled += [1.0, 0.0, 0.0][len(filled) :]
    if filled[0] == 0.0:
        notes.append(f"{key}: factor 0, so the channel is constant")
    return _Scale(key, unit, *filled)


def _constant(line: str) -> tuple[str, dict[str, object]]:
    key, comment, unit, values = _parts(line)
    text = " ".join(values)
    number = number_of(text) if text else None
    keep = number if number is not None and math.isfinite(number) else text
    return key.upper(), {"value": keep, "unit": unit or None, "comment": comment}


def _from_constants(
    channels: list[RawChannel],
    constants: dict[str, dict[str, object]],
    rows: int,
    notes: list[str],
) -> None:
    """A condition that the file states once becomes a constant channel."""
    there = {c.name.upper() for c in channels}
    for key in ("INFLPRES", "LONGVEL", "TRAJVELW", "TRAJVELH", "INCLANGL", "SLIPANGL", "LONGSLIP"):
        entry = constants.get(key)
        value = entry.get("value") if entry else None
        if key in there or entry is None or not isinstance(value, float):
            continue
        channels.append(RawChannel(key, str(entry["unit"] or "") or None, np.full(rows, value)))
        notes.append(f"{key}: from **CONSTANTS, the same for all rows")
