"""Files that are read together, as the bytes of one stored part of the table."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import pandas as pd

from tire_pipeline.code_hash import code_hash
from tire_pipeline.errors import cause_in_entry, may_pass
from tire_pipeline.file_names import printable
from tire_pipeline.files.objects import UnreachableError
from tire_pipeline.files.packed import as_parquet, from_parquet, member, pack, shape_of_parquet
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.tir.reading.read import NEXT_WARNING, file_warnings
from tire_pipeline.tire_table.from_models import from_models, join_tables

LoadTire = Callable[[], TireModel]
"""Reads one file."""
TireFiles = Mapping[str, LoadTire]
"""Name of a file -> what reads it."""
FILES = 250
"""So many files are read together, about a second's work."""
_TABLE_PART, _REPORT_PART = "table.parquet", "rows.json"


class TablePart(bytes):
    """A part of the table and its rows of the report, packed; ``failures`` are told as they come."""

    @property
    def failures(self) -> dict[str, str]:
        """File -> why it was set aside."""
        return {row["file"]: row["reason"] for row in rows_of(self) if row["status"] == "set aside"}


class PassingPart(TablePart):
    """A part with a file that may be read next time, though it has not changed: then it is tried again."""

    passing = True


@dataclass(frozen=True)
class ReadBlock:
    """Reads some files.

    Attributes
    ----------
    files : mapping
        ``category/.../name.tir`` to the function that reads it.
    """

    files: TireFiles
    label = ""

    def __call__(self) -> TablePart:
        """Read them; one that cannot be read has its reason in the report."""
        rows: list[dict[str, Any]] = []
        models: list[tuple[str, str, TireModel]] = []
        kept = TablePart
        for file, load in self.files.items():
            row = _row(file)
            rows.append(row)
            try:
                tire = load()
            except Exception as error:
                cause = cause_in_entry(error)
                if isinstance(cause, UnreachableError):
                    raise
                _set_aside(row, str(cause), getattr(cause, "line", None))
                if may_pass(error):
                    kept = PassingPart
                continue
            _describe(row, tire)
            models.append((file, row["category"], tire))
        return _packed(from_models(models), rows, kept)

    def split(self) -> dict[str, ReadBlock]:
        """One file each: to find the one that ends its process."""
        return {file: ReadBlock({file: load}) for file, load in self.files.items()}

    def join(self, parts: list[bytes]) -> TablePart:
        """What the blocks of :meth:`split` gave, as if this one had been done."""
        kept = PassingPart if any(isinstance(part, PassingPart) for part in parts) else TablePart
        return _packed(
            join_tables(map(table_of, parts)), [row for part in parts for row in rows_of(part)], kept
        )

    def lost(self, reason: str) -> TablePart:
        """What a block of one file gives that ends its process; the next run may have more memory."""
        rows = [_row(file) for file in self.files]
        for row in rows:
            _set_aside(row, reason, None)
        return _packed(from_models([]), rows, PassingPart)


def blocks_of(files: TireFiles) -> dict[str, ReadBlock]:
    """Divide files into blocks by their names: a file that is new changes one block only.

    Returns
    -------
    dict
        A name that says all that the block's part depends on -> the block. Files that cannot say whether
        they have changed (:meth:`.TirLoader.fingerprint`) are read every time.
    """
    code = code_hash("tir", "magic_formula", "tire_table")
    return {
        f"{code}/{number:06d}-{digest_of(block)}.zip": ReadBlock(block)
        for number, block in divided(files).items()
    }


def divided(files: TireFiles, most: int = FILES) -> dict[int, dict[str, LoadTire]]:
    """Number -> files of a block, about ``most``, sorted: by the hashes of their names."""
    count = 1
    while count * most < len(files):
        count *= 2
    members: list[dict[str, LoadTire]] = [{} for _ in range(count)]
    for file in sorted(files):
        members[int(hashlib.sha256(file.encode()).hexdigest()[:8], 16) % count][file] = files[file]
    return {number: block for number, block in enumerate(members) if block}


def table_of(part: bytes) -> pd.DataFrame:
    """The table of a part."""
    return from_parquet(member(part, _TABLE_PART))


def shape_of(part: bytes) -> tuple[int, list[str]]:
    """How many rows the table of a part has, and its columns, without reading them."""
    return shape_of_parquet(member(part, _TABLE_PART))


def rows_of(part: bytes) -> list[dict[str, Any]]:
    """The rows of the report, one a file."""
    found: list[dict[str, Any]] = json.loads(member(part, _REPORT_PART))
    return found


def _packed(table: pd.DataFrame, rows: list[dict[str, Any]], kept: type[TablePart]) -> TablePart:
    content = {_TABLE_PART: as_parquet(table), _REPORT_PART: json.dumps(rows).encode()}
    return kept(pack(content))


def digest_of(block: TireFiles) -> str:
    """A hash of what files depend on; another one each time where a reader cannot tell."""
    total = hashlib.sha256()
    for file, load in block.items():
        total.update(f"{file}\0{_fingerprint(load)}\0".encode())
    return total.hexdigest()[:16]


def _fingerprint(load: LoadTire) -> str:
    own = getattr(load, "fingerprint", None)
    if own is not None:
        return str(own())
    import uuid

    return uuid.uuid4().hex


def _row(file: str) -> dict[str, Any]:
    category = file.split("/", 1)[0] if "/" in file else ""
    row = {"file": file, "category": category, "status": "read", "version": "", "line": None}
    return row | {"reason": "", "defaulted": "", "notes": ""}


def _set_aside(row: dict[str, Any], reason: str, line: int | None) -> None:
    row |= {"status": "set aside", "reason": printable(reason), "line": line}


def _describe(row: dict[str, Any], tire: TireModel) -> None:
    row["version"] = tire.version
    row["defaulted"] = " ".join(sorted(tire.defaulted))
    row["notes"] = NEXT_WARNING.join(file_warnings(tire))
