"""Which recordings of a folder belong together, by their paths."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from fnmatch import fnmatch
from pathlib import PurePosixPath

from tire_pipeline.errors import RecordingError

TOGETHER = "together"


def by_folder(names: Iterable[str]) -> dict[str, list[str]]:
    """Group recordings that lie in one folder.

    Parameters
    ----------
    names : iterable of str
        Paths with ``/``.

    Returns
    -------
    dict of str to list of str
        Label -> its recordings, sorted, with numbers in names by size: ``folder/together`` for several, the
        path itself for a single one.

    Examples
    --------
    >>> by_folder(["a/2.csv", "a/1.csv", "b/1.csv"])
    {'a/together': ['a/1.csv', 'a/2.csv'], 'b/1.csv': ['b/1.csv']}
    """
    folders: dict[PurePosixPath, list[str]] = {}
    for name in sorted(names, key=_by_number):
        folders.setdefault(PurePosixPath(name).parent, []).append(name)
    return {
        (str(folder / TOGETHER) if len(inside) > 1 else inside[0]): inside
        for folder, inside in folders.items()
    }


def _by_number(name: str) -> tuple[list[tuple[int, str]], str]:
    """Sort key by which run 2 comes before run 10: heat and wear go on in this order."""
    pieces = re.findall(r"[0-9]+|[^0-9]+", name)
    return [(int(p), "") if p.isascii() and p.isdigit() else (-1, p) for p in pieces], name


def matching(names: Sequence[str], pattern: str) -> str | None:
    """Return the one recording whose path or file name matches a pattern such as ``*_check.csv``.

    Parameters
    ----------
    names : sequence of str
    pattern : str
        As for shells; empty matches none.

    Returns
    -------
    str or None
        None if none matches.

    Raises
    ------
    RecordingError
        Several match.
    """
    found = [n for n in names if fnmatch(n, pattern) or fnmatch(PurePosixPath(n).name, pattern)]
    if len(found) > 1:
        raise RecordingError(
            f"{pattern!r} matches {', '.join(found)}: only one can be held out",
            todo="choose a pattern that matches one recording of each folder",
        )
    return found[0] if found else None
