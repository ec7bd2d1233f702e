"""A tire table of any number of files, with a few thousand of them in memory at a time."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import dataclass, field
from functools import partial
from typing import IO

import pandas as pd

from tire_pipeline.files.packed import as_parquet, from_parquet
from tire_pipeline.tire_table.from_models import ALWAYS, TEXTS, as_in_whole, from_models, join_tables

PIECE_ROWS = 5_000
"""Most rows of a piece: about 20 MB in memory."""


@dataclass(frozen=True)
class Piece:
    """Some rows of a tire table, read when they are needed.

    Attributes
    ----------
    rows : int
    numbers : tuple of str
        Its number columns; a column that has no value in these rows may be absent.
    load : callable
        Reads it: a tire table.
    stored : tuple of (str, str), optional
        Name and SHA-256 of the file that holds it, where it is stored already.
    """

    rows: int
    numbers: tuple[str, ...]
    load: Callable[[], pd.DataFrame] = field(compare=False)
    stored: tuple[str, str] | None = None

    @classmethod
    def of(cls, frame: pd.DataFrame) -> Piece:
        """A table in memory as a piece."""
        return cls(len(frame), numbers_of(frame.columns), lambda: frame)


def numbers_of(columns: Iterable[str]) -> tuple[str, ...]:
    """The number columns of a tire table."""
    return tuple(name for name in columns if name not in (*TEXTS, "tire_id"))


@dataclass(frozen=True)
class TableInPieces:
    """A tire table that need not fit into memory.

    Attributes
    ----------
    pieces : tuple of Piece
        No file is in two of them.
    """

    pieces: tuple[Piece, ...] = ()

    def __len__(self) -> int:
        return sum(piece.rows for piece in self.pieces)

    @property
    def numbers(self) -> tuple[str, ...]:
        """Number columns of the whole table, in no order."""
        return tuple(dict.fromkeys([*ALWAYS, *(name for piece in self.pieces for name in piece.numbers)]))

    def __iter__(self) -> Iterator[pd.DataFrame]:
        """Each piece with the columns and ``tire_id`` that its rows have in the whole table."""
        numbers = self.numbers
        for piece in self.pieces:
            if piece.rows:
                yield as_in_whole(piece.load(), numbers)

    def rows_of(self, files: Collection[str]) -> pd.DataFrame:
        """The rows of some files as one table, sorted by ``file``, with the columns of the whole."""
        chosen = [frame[frame["file"].isin(files)] for frame in self]
        some = [frame for frame in chosen if len(frame)]
        if not some:
            return as_in_whole(from_models([]), self.numbers)
        return pd.concat(some, ignore_index=True).sort_values("file", ignore_index=True)

    def frame(self) -> pd.DataFrame:
        """The whole as one table: for what is known to be small.

        Raises
        ------
        DomainError
            A file is in two pieces.
        """
        return join_tables(piece.load() for piece in self.pieces)

    def gathered(self, rows: int = PIECE_ROWS) -> Iterator[pd.DataFrame]:
        """The same table in pieces of about this many rows, for storing many small ones."""
        numbers, some = self.numbers, list[pd.DataFrame]()
        for piece in self.pieces:
            if piece.rows:
                some.append(piece.load())
            if sum(map(len, some)) >= rows:
                yield as_in_whole(pd.concat(some, ignore_index=True), numbers)
                some = []
        if some:
            yield as_in_whole(pd.concat(some, ignore_index=True), numbers)


class Scratch:
    """An unnamed file that holds pieces until they are stored; it is deleted when its process ends."""

    def __init__(self) -> None:
        self._file: IO[bytes] = tempfile.TemporaryFile()  # noqa: SIM115
        self._end = 0

    def put(self, frame: pd.DataFrame) -> Piece:
        """Keep a table there instead of in memory."""
        content = as_parquet(frame)
        self._file.write(content)
        self._file.flush()
        start, self._end = self._end, self._end + len(content)
        return Piece(len(frame), numbers_of(frame.columns), partial(self._get, start, len(content)))

    def _get(self, start: int, length: int) -> pd.DataFrame:
        return from_parquet(os.pread(self._file.fileno(), length, start))
