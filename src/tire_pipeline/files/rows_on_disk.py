"""Rows of any number on the disk, read back in an order, some thousand at a time."""

from __future__ import annotations

import contextlib
import errno
import os
import sqlite3
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import pandas as pd

REPORT_ROWS = 5_000
"""Most rows of a report that are in memory at a time: a megabyte or two."""


class RowsOnDisk:
    """A table ``rows`` of a database that has no name: its file goes with the process.

    SQLite sorts and counts on the disk, with a few megabytes of memory.

    Parameters
    ----------
    columns : iterable of str

    Raises
    ------
    OSError
        The disk of temporary files is full, or none of their folders may be written.
    """

    def __init__(self, columns: Iterable[str]) -> None:
        names = [quoted(name) for name in columns]
        self._database = sqlite3.connect("", check_same_thread=False)
        for setting in ("journal_mode = off", "synchronous = off", "temp_store = 1"):
            self.do(f"pragma {setting}")
        self.do(f"create table rows ({', '.join(names)})")
        self._insert = f"insert into rows values ({', '.join('?' * len(names))})"

    def add(self, rows: Iterable[Sequence[Any]]) -> None:
        """Append rows, their values in the order of the columns."""
        with _as_error_of_the_disk():
            self._database.executemany(self._insert, rows)

    def do(self, statement: str, values: Sequence[Any] = ()) -> sqlite3.Cursor:
        """Do a statement of SQL; its result is read as it is found."""
        with _as_error_of_the_disk():
            return self._database.execute(statement, values)


@contextlib.contextmanager
def _as_error_of_the_disk() -> Iterator[None]:
    """What SQLite says of the disk, as the system would say it."""
    try:
        yield
    except sqlite3.OperationalError as error:
        codes = {"SQLITE_FULL": errno.ENOSPC, "SQLITE_CANTOPEN": errno.EACCES}
        number = codes.get(error.sqlite_errorname)
        if number is None:
            raise
        where = os.environ.get("SQLITE_TMPDIR") or os.environ.get("TMPDIR") or "/var/tmp"
        raise OSError(number, os.strerror(number), f"{where} (temporary files, TMPDIR)") from error


@dataclass(frozen=True)
class FramesOfRows:
    """What a query selects, as tables of at most ``REPORT_ROWS`` rows; at least one, which may be empty.

    Attributes
    ----------
    rows : RowsOnDisk
    query : str
    columns : mapping of str to str
        Name and pandas' type of each column.
    """

    rows: RowsOnDisk
    query: str
    columns: Mapping[str, str]

    def __iter__(self) -> Iterator[pd.DataFrame]:
        """Each table, as often as they are asked for."""
        found = self.rows.do(self.query)
        some = found.fetchmany(REPORT_ROWS)
        while True:
            yield pd.DataFrame(some, columns=list(self.columns)).astype(dict(self.columns))
            some = found.fetchmany(REPORT_ROWS)
            if not some:
                return

    def __deepcopy__(self, memo: dict[int, Any]) -> FramesOfRows:
        """Itself: nothing changes it."""
        return self


def joined(frames: Iterable[pd.DataFrame]) -> pd.DataFrame:
    """All of it as one table: for what is known to be small."""
    return pd.concat(frames, ignore_index=True)


def plain_rows(table: pd.DataFrame) -> Iterator[tuple[Any, ...]]:
    """The rows of a table as :meth:`RowsOnDisk.add` takes them; what is missing is None."""
    values = table.astype(object)
    return values.where(table.notna(), None).itertuples(index=False, name=None)


def quoted(name: str) -> str:
    """A column's name in SQL."""
    return '"' + name.replace('"', '""') + '"'
