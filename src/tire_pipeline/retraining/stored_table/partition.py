"""The table of all files read so far, divided by the files' names: what is new changes few parts."""

from __future__ import annotations

import hashlib
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np
import pandas as pd

from tire_pipeline.tire_table.from_models import ALWAYS, TEXTS, as_in_whole, from_models
from tire_pipeline.tire_table.in_pieces import PIECE_ROWS, Piece, Scratch, TableInPieces


@dataclass(frozen=True)
class Partition:
    """A tire table in ``count`` parts, each with the files whose names' hash falls to it.

    Attributes
    ----------
    count : int
        A power of two.
    parts : mapping
        Number of the part -> its rows; parts without rows are absent.
    """

    count: int = 1
    parts: Mapping[int, Piece] = field(default_factory=dict)

    @classmethod
    def of(cls, frame: pd.DataFrame) -> Partition:
        """A table in memory as one part."""
        return cls(1, {0: Piece.of(frame)} if len(frame) else {})

    @property
    def table(self) -> TableInPieces:
        """The whole table."""
        return TableInPieces(tuple(self.parts[number] for number in sorted(self.parts)))

    def part_of(self, file: str) -> int:
        """The number of the part to which a file belongs."""
        return int(hashlib.sha256(file.encode()).hexdigest()[:8], 16) % self.count

    def for_rows(self, rows: int, scratch: Scratch) -> Partition:
        """The same table in so many parts that each has about ``PIECE_ROWS`` of so many rows at most.

        Parts are divided, never joined: a part of the new division lies within one of the old.
        """
        count = self.count
        while count * PIECE_ROWS < rows:
            count *= 2
        if count == self.count:
            return self
        divided = Partition(count)
        parts = {}
        for old in self.parts.values():
            for number, rows_there in divided.split(old.load()).items():
                parts[number] = scratch.put(rows_there)
        return Partition(count, parts)

    def split(self, frame: pd.DataFrame) -> dict[int, pd.DataFrame]:
        """Rows by the part to which they belong."""
        numbers = np.array([self.part_of(file) for file in frame["file"]])
        return {int(number): frame[numbers == number] for number in np.unique(numbers)}

    def with_rows(self, new: pd.DataFrame, gone: Iterable[str], scratch: Scratch) -> Partition:
        """The same with rows that are new or replace others, and without those of some files.

        Only the parts to which these files belong are read and made again.
        """
        added = self.split(new) if len(new) else {}
        removed: dict[int, list[str]] = {}
        for file in gone:
            removed.setdefault(self.part_of(file), []).append(file)
        if not added and not removed:
            return self
        parts = dict(self.parts)
        for number in {*added, *removed}:
            old = parts[number].load() if number in parts else None
            frame = _merged(old, added.get(number), removed.get(number, ()))
            parts.pop(number, None)
            if len(frame):
                parts[number] = scratch.put(frame)
        return Partition(self.count, parts)


def _merged(old: pd.DataFrame | None, new: pd.DataFrame | None, gone: Collection[str]) -> pd.DataFrame:
    """Rows of ``old`` that are neither replaced nor gone, and ``new``; columns without a value go."""
    replaced = {*gone, *(new["file"] if new is not None else ())}
    kept = old[~old["file"].isin(replaced)] if old is not None else None
    some = [part for part in (kept, new) if part is not None and len(part)]
    if not some:
        return from_models([])
    table = pd.concat(some, ignore_index=True) if len(some) > 1 else some[0]
    columns = table.columns[table.notna().any()]
    numbers = [name for name in columns if name not in (*TEXTS, "tire_id")]
    return as_in_whole(table, [*ALWAYS, *numbers]).sort_values("file", ignore_index=True)
