"""Read every .tir file; list those that cannot be read, with the reason."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Mapping
from functools import partial
from operator import itemgetter
from typing import Any

import pandas as pd
from pydantic import Field

from tire_pipeline.errors import DomainError
from tire_pipeline.file_names import NAMED_ONCE
from tire_pipeline.files.rows_on_disk import FramesOfRows, RowsOnDisk
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.parameters import Parameters
from tire_pipeline.progress import track
from tire_pipeline.tire_table.in_pieces import Piece, TableInPieces, numbers_of
from tire_pipeline.tire_table.read_blocks import ReadBlock, blocks_of, rows_of, shape_of, table_of

_LOG = logging.getLogger(__name__)
NAMED_IN_LOG = 20
"""So many of the files that are set aside are named in the log; the report has them all."""
REPORT_COLUMNS = {
    "file": "str",
    "category": "str",
    "status": "str",
    "version": "str",
    "line": "Int64",
    "reason": "str",
    "defaulted": "str",
    "notes": "str",
}
"""Columns of the report of all files, and their types."""
_GOOD = "status = 'read'"
_SELECT_ASIDE = "select file, reason from rows where status = 'set aside'"
_CALLED_TIR = "file like '%.tir'"


class IngestParameters(Parameters):
    """Parameters of ``ingest_tir``.

    Attributes
    ----------
    most_failed_share : float
        Stop when more than this share of the files cannot be read. Folders and links do not count as files.
    """

    most_failed_share: float = Field(0.5, ge=0.0, le=1.0)


def read_files(tir_files: Mapping[str, Callable[[], TireModel]]) -> dict[str, ReadBlock]:
    """Read all files, some at a time; what is stored and has not changed is not read again.

    Parameters
    ----------
    tir_files : mapping
        ``category/.../name.tir`` to the function that reads it.
    """
    return blocks_of(tir_files)


def join_files(
    blocks: Mapping[str, Callable[[], bytes]], parameters: IngestParameters
) -> tuple[TableInPieces, FramesOfRows, dict[str, Any]]:
    """Join the blocks of files that were read: one table, one report.

    Parameters
    ----------
    blocks : mapping
        What :func:`read_files` gave, done.
    parameters : IngestParameters

    Returns
    -------
    table : TableInPieces
        The tire table (docs/reference/architecture.md), a piece a block.
    report : iterable of DataFrame
        One row a file, sorted: ``file, category, status, version, line, reason, defaulted, notes``; read from
        the disk some thousand rows at a time.
    summary : dict
        How many of how many were read, by category.

    Raises
    ------
    DomainError
        If more than ``most_failed_share`` of the files called ``.tir`` cannot be read.
    """
    pieces, rows = list[Piece](), RowsOnDisk(REPORT_COLUMNS)
    for read in track(blocks.values(), "joining what was read", total=len(blocks)):
        part = read()
        count, columns = shape_of(part)
        rows.add(map(itemgetter(*REPORT_COLUMNS), rows_of(part)))
        pieces.append(Piece(count, numbers_of(columns), partial(_table_of, read)))
    aside = rows.do(f"{_SELECT_ASIDE} order by file limit {NAMED_IN_LOG + 1}").fetchall()
    name_unread(aside[:NAMED_IN_LOG], "is set aside")
    if len(aside) > NAMED_IN_LOG:
        _LOG.warning("more files are set aside: the ingest report has them all")
    _refuse_mostly_unread(rows, parameters)
    report = FramesOfRows(rows, "select * from rows order by file", REPORT_COLUMNS)
    return TableInPieces(tuple(pieces)), report, _summary(rows)


def name_unread(files: Iterable[tuple[str, str]], what: str) -> None:
    """Name files that cannot be read in the log, with what became of each and the reason.

    A record says which file it is about: a run names a file once, whichever of its pipelines reads it first.
    """
    for file, reason in files:
        _LOG.warning("%s %s: %s", file, what, reason, extra={NAMED_ONCE: file})


def _table_of(read: Callable[[], bytes]) -> pd.DataFrame:
    return table_of(read())


def _refuse_mostly_unread(rows: RowsOnDisk, parameters: IngestParameters) -> None:
    """Raise where more of the files called ``.tir`` cannot be read than the parameters allow.

    Folders and links that lead nowhere do not count, however many one link brings in.
    """
    (named,) = rows.do(f"select count(*) from rows where {_CALLED_TIR}").fetchone()
    counted = _CALLED_TIR if named else "true"
    (files,) = rows.do(f"select count(*) from rows where {counted}").fetchone()
    (failed,) = rows.do(f"select count(*) from ({_SELECT_ASIDE} and {counted})").fetchone()
    if failed > parameters.most_failed_share * files:
        file, reason = rows.do(f"{_SELECT_ASIDE} and {counted} order by file limit 1").fetchone()
        raise DomainError(
            f"{failed} of {files} files cannot be read; the first: {file}: {reason}",
            where="ingest_tir",
            todo="correct or remove those files, or raise ingest_tir.most_failed_share",
        )


def _summary(rows: RowsOnDisk) -> dict[str, Any]:
    (files,) = rows.do("select count(*) from rows").fetchone()
    (good,) = rows.do(f"select count(*) from rows where {_GOOD}").fetchone()
    return {
        "files": files,
        "read": good,
        "set_aside": files - good,
        "read_by_category": _good_by(rows, "category"),
        "versions": _good_by(rows, "version"),
    }


def _good_by(rows: RowsOnDisk, column: str) -> dict[str, int]:
    """How many files were read of each category or version."""
    query = f"select {column}, count(*) from rows where {_GOOD} group by {column} order by {column}"
    return dict(rows.do(query).fetchall())
