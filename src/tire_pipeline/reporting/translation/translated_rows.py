"""Rows of the page of translated files, and what came of each supplier's."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.translation.result import EDGE, UNBIASED, UNKNOWN

ROW_COLUMNS = (
    "file",
    "own",
    "supplier",
    "known",
    "tire",
    "verdict",
    "distance",
    "ratio",
    "reason",
    "changes",
    "bias",
    "protocol",
)
SHOWN_VERDICTS = ("translated", "already unbiased", "left alone", "refused", "unknown supplier")


def rows_of(report: pd.DataFrame, own: set[str], tires: Mapping[str, str]) -> list[list[Any]]:
    """Return the rows by ``ROW_COLUMNS``; None: not known.

    The user's own files come first, and of them those that were judged before those that need no translation;
    then by file.
    """
    texts = report.reindex(
        columns=["file", "source", "supplier_known", "verdict", "reason", "changes", "bias_band", "protocol"]
    )
    texts = texts.astype(object).where(texts.notna(), "")
    numbers = report.reindex(columns=["distance", "expected_rms_ratio"]).astype(float)
    rows = []
    for said, (distance, ratio) in zip(texts.to_dict("records"), numbers.to_numpy(), strict=True):
        file = str(said["file"])
        rows.append(
            [
                file,
                file in own,
                _supplier(file, str(said["source"]), str(said["verdict"])),
                said["supplier_known"],
                tires.get(file, ""),
                said["verdict"],
                _distance(distance),
                _rounded(ratio),
                said["reason"],
                said["changes"],
                said["bias_band"],
                said["protocol"],
            ]
        )
    return sorted(rows, key=lambda row: (not row[1], row[5] == UNBIASED, row[0]))


def by_supplier(rows: list[list[Any]]) -> list[dict[str, Any]]:
    """Count the verdicts of each supplier, with the median expected RMS error of its translated files."""
    found = []
    for name in sorted({row[2] for row in rows}):
        part = [row for row in rows if row[2] == name]
        counts = [sum(row[5] == verdict for row in part) for verdict in SHOWN_VERDICTS]
        ratios = [row[7] for row in part if row[5] == "translated" and row[7] is not None]
        middle = f"{np.median(ratios):.0%}" if ratios else "–"
        found.append({"name": name, "files": len(part), "counts": counts, "ratio": middle})
    return found


def _supplier(file: str, source: str, verdict: str) -> str:
    """The supplier; where it is no known category, the folder, by which the user knows it."""
    folder, slash, _ = file.partition("/")
    return folder if verdict == UNKNOWN and slash else source


def _distance(value: float) -> float | None:
    """A file beyond the edge of the training data is not shown as one on it."""
    rounded = _rounded(value)
    return rounded + 0.01 if rounded == EDGE < value else rounded


def _rounded(value: float) -> float | None:
    return float(f"{value:.3g}") if np.isfinite(value) else None
