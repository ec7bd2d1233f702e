"""Rows in which all that an explanation needs has a number."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping

import numpy as np

from tire_pipeline.channels import FORCE_OF_SLIP, INPUT_CHANNELS, SLIP_AND_LOAD, TANGENTIAL_FORCES
from tire_pipeline.pages.numbers_in_words import how_many
from tire_pipeline.recordings.issue import Issue
from tire_pipeline.recordings.spikes import LONGEST_SPIKE
from tire_pipeline.recordings.stretches import stretches

LEAST_SAMPLES = 30
LEAST_POINTS = 12
"""Minimum rows of a recording in time, and of steady points: fewer cannot separate an effect from noise."""
LEAST_WHOLE = 0.1
"""Part of the rows that must have a number in all channels, and a load that the tire model is for."""
LONGEST_HOLE = LONGEST_SPIKE
"""Samples: holes of up to so many are interpolated linearly in time."""
USED = {*INPUT_CHANNELS, *TANGENTIAL_FORCES, "time"}
"""Channels that a row must have to be used."""


UNREAD = "no number, and counted as missing"
_HOW_TO_WRITE = (
    (re.compile(r"\(.*\d.*\)|\d[\d.,]*-"), "write a negative value with a minus sign in front of it"),
    (
        re.compile(r"[<>]"),
        "write the limit as a plain number, or leave the cell empty",
    ),
    (re.compile(r"#"), "correct the formula in the spreadsheet, then export it again"),
    (re.compile(r"[+-]?\d[\d.,]*\s*[^\W\d_]+|.*%"), "write units in the head of the column only"),
    (re.compile(r"[+-]?\d[\d.,' ]*"), "write all numbers of the column with the same decimal sign"),
)
_AS_A_NUMBER = "if it is a value, write it as a plain number such as -191.0; otherwise leave the cell empty"


def said_of_unread(column: str, unread: np.ndarray, first: str) -> str:
    """Say which cells of a column hold something that is no number.

    Examples
    --------
    >>> said_of_unread("FY", np.array([False, True]), "(191.0)")
    "FY: 1 cell is no number, and counted as missing; the first in data row 2: '(191.0)'"
    """
    count = int(unread.sum())
    cells = f"{how_many(count, 'cell')} {'is' if count == 1 else 'are'}"
    return f"{column}: {cells} {UNREAD}; the first in data row {int(unread.argmax()) + 1}: {first!r}"


def unread_cells(notes: Iterable[str], columns: Collection[str]) -> list[Issue]:
    """Report each of these columns that has such cells, with what to do."""
    return [
        Issue("cells_not_read", "warning", note, _how_to_write(note.partition(f"{UNREAD}; ")[2]))
        for note in notes
        if UNREAD in note and any(note.startswith(f"{column}: ") for column in columns)
    ]


def _how_to_write(where: str) -> str:
    text = where.partition(": ")[2].strip("'\"")
    return next((todo for form, todo in _HOW_TO_WRITE if form.match(text)), _AS_A_NUMBER)


def apart(columns: Mapping[str, np.ndarray], force: str) -> str:
    """Say that hardly any row has slip, load and a force; "" if enough have.

    A line over holes in all of them measures nothing.

    Parameters
    ----------
    columns : mapping of ndarray, shape (n,)
        Channels, NaN where there is no number.
    force : str
        ``fx`` or ``fy``.
    """
    names = [*(n for n in SLIP_AND_LOAD if n in columns), force]
    whole = int(np.all([np.isfinite(columns[n]) for n in names], axis=0).sum())
    if whole >= LEAST_POINTS:
        return ""
    return f"only {whole} of {columns[force].size} rows have numbers in all of {', '.join(names)}"


def short_holes(missing: np.ndarray) -> np.ndarray:
    """Return which samples lie in a hole that a straight line bridges, bool, shape (n,).

    Parameters
    ----------
    missing : ndarray of bool, shape (n,)
    """
    found = np.zeros(missing.size, bool)
    for first, after in stretches(missing):
        if after - first <= LONGEST_HOLE and first > 0 and after < missing.size:
            found[first:after] = True
    return found


def few_whole_rows(columns: Mapping[str, np.ndarray], timed: bool) -> list[Issue]:
    """Report an error if too few rows have a number in every channel that is used.

    Parameters
    ----------
    columns : mapping of ndarray, shape (n,)
        Channels that hold numbers.
    timed : bool
        Whether there is a time line, so that short holes are bridged.
    """
    used = {n: x for n, x in columns.items() if n in USED}
    if not used:
        return []
    size = next(iter(used.values())).size
    lost = np.any([_lost(n, x, timed) for n, x in used.items()], axis=0)
    whole = int((~lost).sum())
    if whole < max(LEAST_POINTS, LEAST_WHOLE * size):
        where = f"{whole} of {size} rows have a number in each of {', '.join(used)}"
        return [Issue("few_whole_rows", "error", where, _what_to_do(used, timed))]
    return [
        Issue("never_together", "error", said, "bring the channels to common moments first")
        for said in (apart(used, force) for force in _forces(used))
        if said
    ]


def _what_to_do(used: Mapping[str, np.ndarray], timed: bool) -> str:
    """Say which column to drop, or that the emptiest one is needed."""
    filled = {n: int(np.isfinite(x).sum()) for n, x in used.items()}
    needed = _needed(used)
    size = next(iter(used.values())).size
    kept = int((~np.any([_lost(n, used[n], timed) for n in needed], axis=0)).sum()) if needed else size
    others = [n for n in used if n not in needed]
    if others and kept >= max(LEAST_POINTS, LEAST_WHOLE * size):
        emptiest = min(others, key=lambda n: filled[n])
        return f"drop {emptiest}, the emptiest column that can be left out ({filled[emptiest]} numbers)"
    emptiest = min(needed or used, key=lambda n: filled[n])
    return (
        f"{emptiest} is the emptiest column ({filled[emptiest]} numbers) and cannot be left out: look at how "
        "it was read, and bring channels of different rates to common moments"
    )


def _needed(columns: Collection[str]) -> list[str]:
    """Return the columns without which nothing can be explained: time, load, and the only slip and force."""
    slips = [n for n in FORCE_OF_SLIP if n in columns]
    forces = _forces(columns)
    only = [*(slips if len(slips) == 1 else []), *(forces if len(forces) == 1 else [])]
    return [n for n in columns if n in {"time", "normal_load", *only}]


def _forces(columns: Collection[str]) -> list[str]:
    return [n for n in TANGENTIAL_FORCES if n in columns]


def _lost(name: str, values: np.ndarray, timed: bool) -> np.ndarray:
    """Return the rows without a number that no line bridges, bool."""
    bad = ~np.isfinite(values)
    return bad & ~short_holes(bad) if timed and name != "time" else bad
