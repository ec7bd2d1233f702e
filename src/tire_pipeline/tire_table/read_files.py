"""Read every .tir file; set aside, with its reason, what cannot be read."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from typing import Any

import pandas as pd
from pydantic import Field

from tire_pipeline.errors import DomainError
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.parameters import Parameters
from tire_pipeline.tire_table.from_models import join_tables
from tire_pipeline.tire_table.read_blocks import ReadBlock, blocks_of, unpacked

_LOG = logging.getLogger(__name__)
_SAID = 20


class IngestParameters(Parameters):
    """Parameters of ``ingest_tir``.

    Attributes
    ----------
    most_failed_share : float
        Stop when more than this share of the files cannot be read.
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
) -> tuple[pd.DataFrame, pd.DataFrame, dict[str, Any]]:
    """Put what was read into one table.

    Parameters
    ----------
    blocks : mapping
        What :func:`read_files` gave, done.
    parameters : IngestParameters

    Returns
    -------
    table : DataFrame
        The tire table (docs/reference/architecture.md).
    report : DataFrame
        One row a file: ``file, category, status, version, line, reason, defaulted, notes``.
    summary : dict
        How many of how many were read, by category.

    Raises
    ------
    DomainError
        If more than ``most_failed_share`` of the files cannot be read.
    """
    parts = [unpacked(read()) for read in blocks.values()]
    report = pd.DataFrame([row for _, rows in parts for row in rows])
    report = report.sort_values("file", ignore_index=True)
    summary = _summary(report)
    aside = report[report["status"] == "set aside"]
    for file, reason in aside[["file", "reason"]].head(_SAID).itertuples(index=False):
        _LOG.warning("%s is set aside: %s", file, reason)
    if summary["set_aside"] > parameters.most_failed_share * summary["files"]:
        raise DomainError(
            f"{summary['set_aside']} of {summary['files']} files cannot be read; the first: "
            f"{aside.iloc[0]['file']}: {aside.iloc[0]['reason']}",
            where="ingest_tir",
            todo="correct or remove those files, or raise ingest_tir.most_failed_share",
        )
    return join_tables(table for table, _ in parts), report, summary


def _summary(report: pd.DataFrame) -> dict[str, Any]:
    good = report["status"] == "read"
    return {
        "files": len(report),
        "read": int(good.sum()),
        "set_aside": int((~good).sum()),
        "read_by_category": {str(k): int(v) for k, v in report[good].groupby("category").size().items()},
        "versions": {str(k): int(v) for k, v in report[good].groupby("version").size().items()},
    }
