"""Read every .tir file; set aside, with its reason, what cannot be read."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import pandas as pd
from pydantic import Field

from tire_pipeline.errors import DomainError, TirePipelineError, chain
from tire_pipeline.file_names import printable
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.parameters import Parameters
from tire_pipeline.progress import track
from tire_pipeline.tire_table import from_models


class IngestParameters(Parameters):
    """Parameters of ``ingest_tir``.

    Attributes
    ----------
    most_failed_share : float
        Stop when more than this share of the files cannot be read.
    """

    most_failed_share: float = Field(0.5, ge=0.0, le=1.0)


def read_files(
    tir_files: Mapping[str, Callable[[], TireModel]], parameters: IngestParameters
) -> tuple[pd.DataFrame, pd.DataFrame, dict[str, Any]]:
    """Read all files into one table.

    Parameters
    ----------
    tir_files : mapping
        ``category/.../name.tir`` to the function that reads it.
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
    rows: list[dict[str, Any]] = []
    table = from_models(_read(tir_files, rows))
    report = pd.DataFrame(rows).sort_values("file", ignore_index=True)
    summary = _summary(report)
    if summary["set_aside"] > parameters.most_failed_share * summary["files"]:
        first = report.loc[report["status"] == "set aside"].iloc[0]
        raise DomainError(
            f"{summary['set_aside']} of {summary['files']} files cannot be read; the first: "
            f"{first['file']}: {first['reason']}",
            where="ingest_tir",
            todo="correct or remove those files, or raise ingest_tir.most_failed_share",
        )
    return table, report, summary


def _read(
    tir_files: Mapping[str, Callable[[], TireModel]], rows: list[dict[str, Any]]
) -> Iterator[tuple[str, str, TireModel]]:
    for file, load in track(tir_files.items(), "reading .tir files", total=len(tir_files)):
        category = file.split("/", 1)[0] if "/" in file else ""
        row = {"file": file, "category": category, "status": "read", "version": "", "line": None}
        row |= {"reason": "", "defaulted": "", "notes": ""}
        rows.append(row)
        try:
            tire = load()
        except Exception as error:  # a loader may wrap what went wrong
            cause = _cause(error)
            if cause is None:
                raise
            row |= {"status": "set aside", "reason": printable(str(cause))}
            row["line"] = getattr(cause, "line", None)
            continue
        notes = tire.metadata.get("warnings", ())
        row["version"] = tire.version
        row["defaulted"] = " ".join(sorted(tire.defaulted))
        row["notes"] = " | ".join(map(str, notes)) if isinstance(notes, list | tuple) else str(notes)
        yield file, category, tire


def _cause(error: BaseException) -> BaseException | None:
    """The first in the chain that is of the file, not of the program; None if there is none."""
    wanted = (each for each in chain(error) if isinstance(each, TirePipelineError | OSError))
    return next(wanted, None)


def _summary(report: pd.DataFrame) -> dict[str, Any]:
    good = report["status"] == "read"
    return {
        "files": len(report),
        "read": int(good.sum()),
        "set_aside": int((~good).sum()),
        "read_by_category": {str(k): int(v) for k, v in report[good].groupby("category").size().items()},
        "versions": {str(k): int(v) for k, v in report[good].groupby("version").size().items()},
    }
