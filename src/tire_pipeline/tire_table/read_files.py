"""Read every .tir file; list those that cannot be read, with the reason."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import pandas as pd
from pydantic import Field

from tire_pipeline.errors import DomainError
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.parameters import Parameters
from tire_pipeline.progress import track
from tire_pipeline.tire_table.in_pieces import Piece, TableInPieces, numbers_of
from tire_pipeline.tire_table.read_blocks import ReadBlock, blocks_of, rows_of, shape_of, table_of

_LOG = logging.getLogger(__name__)
NAMED_IN_LOG = 20
"""So many of the files that are set aside are named in the log; the report has them all."""


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
) -> tuple[TableInPieces, pd.DataFrame, dict[str, Any]]:
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
    report : DataFrame
        One row a file: ``file, category, status, version, line, reason, defaulted, notes``.
    summary : dict
        How many of how many were read, by category.

    Raises
    ------
    DomainError
        If more than ``most_failed_share`` of the files called ``.tir`` cannot be read.
    """
    pieces: list[Piece] = []
    rows: list[dict[str, Any]] = []
    for read in track(blocks.values(), "joining what was read", total=len(blocks)):
        part = read()
        count, columns = shape_of(part)
        rows += rows_of(part)
        pieces.append(Piece(count, numbers_of(columns), partial(_table_of, read)))
    report = pd.DataFrame(rows).sort_values("file", ignore_index=True)
    summary = _summary(report)
    aside = report[report["status"] == "set aside"]
    for file, reason in aside[["file", "reason"]].head(NAMED_IN_LOG).itertuples(index=False):
        _LOG.warning("%s is set aside: %s", file, reason)
    _refuse_mostly_unread(report, parameters)
    return TableInPieces(tuple(pieces)), report, summary


def _table_of(read: Callable[[], bytes]) -> pd.DataFrame:
    return table_of(read())


def _refuse_mostly_unread(report: pd.DataFrame, parameters: IngestParameters) -> None:
    """Raise where more of the files called ``.tir`` cannot be read than the parameters allow."""
    files = _called_tir(report)
    failed = files[files["status"] == "set aside"]
    if len(failed) > parameters.most_failed_share * len(files):
        raise DomainError(
            f"{len(failed)} of {len(files)} files cannot be read; the first: "
            f"{failed.iloc[0]['file']}: {failed.iloc[0]['reason']}",
            where="ingest_tir",
            todo="correct or remove those files, or raise ingest_tir.most_failed_share",
        )


def _called_tir(report: pd.DataFrame) -> pd.DataFrame:
    """What counts as a file: folders and links that lead nowhere do not, however many one link brings in."""
    named = report[report["file"].str.lower().str.endswith(".tir")]
    return report if named.empty else named


def _summary(report: pd.DataFrame) -> dict[str, Any]:
    good = report["status"] == "read"
    return {
        "files": len(report),
        "read": int(good.sum()),
        "set_aside": int((~good).sum()),
        "read_by_category": {str(k): int(v) for k, v in report[good].groupby("category").size().items()},
        "versions": {str(k): int(v) for k, v in report[good].groupby("version").size().items()},
    }
