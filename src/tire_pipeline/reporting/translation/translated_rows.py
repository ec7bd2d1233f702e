"""Rows of the page of translated files, and what came of each supplier's."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.classifiers.suppliers import UNKNOWN_SUPPLIER
from tire_pipeline.files.rows_on_disk import RowsOnDisk
from tire_pipeline.tir.reading.read import NEXT_WARNING
from tire_pipeline.translation.result import EDGE, TRANSLATED, UNBIASED

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
    "noted",
    "notes",
)
_COUNTED_TOO = ("source", "expected_rms_ratio", "taught")
"""What is counted, too: as it stands in the report."""
_TEXT_COLUMNS = (
    "file",
    "source",
    "supplier_known",
    "verdict",
    "reason",
    "changes",
    "bias_band",
    "protocol",
    "notes",
)
SHOWN_VERDICTS = ("translated", "already unbiased", "left alone", "refused", "unknown supplier")


def listed(
    report: Iterable[pd.DataFrame], made: Collection[str], tire: Callable[[str], str] = lambda file: ""
) -> RowsOnDisk:
    """Put the rows of the page on the disk: ``ROW_COLUMNS``, and what else is counted.

    Parameters
    ----------
    report : iterable of DataFrame
        ``TranslationResult.report`` with ``supplier_known``, how the supplier of each file is known.
    made : collection of str
        Files that are not the user's own.
    tire : callable
        The physical tire of a file.
    """
    rows = RowsOnDisk([*ROW_COLUMNS, *_COUNTED_TOO])
    for frame in report:
        rows.add(_rows_of(frame, made, tire))
    return rows


def _rows_of(
    report: pd.DataFrame, made: Collection[str], tire: Callable[[str], str]
) -> Iterator[tuple[Any, ...]]:
    texts = report.reindex(columns=list(_TEXT_COLUMNS))
    texts = texts.astype(object).where(texts.notna(), "")
    numbers = report.reindex(columns=["distance", "expected_rms_ratio", "taught"]).astype(float)
    for said, (distance, ratio, taught) in zip(texts.to_dict("records"), numbers.to_numpy(), strict=True):
        file, source = str(said["file"]), str(said["source"])
        notes = str(said["notes"])
        yield (
            file,
            file not in made,
            _supplier(file, source),
            said["supplier_known"],
            tire(file),
            said["verdict"],
            _distance(distance),
            _rounded(ratio),
            said["reason"],
            said["changes"],
            said["bias_band"],
            said["protocol"],
            notes.count(NEXT_WARNING) + 1 if notes else 0,
            notes,
            source,
            ratio,
            taught,
        )


def in_order(rows: RowsOnDisk) -> Iterator[list[Any]]:
    """Yield the rows by ``ROW_COLUMNS``; None: not known.

    The user's own files come first, and of them those that were judged before those that need no translation;
    then by file.
    """
    order = f"order by not own, verdict = '{UNBIASED}', file"
    for file, own, *rest in rows.do(f"select {', '.join(ROW_COLUMNS)} from rows {order}"):
        yield [file, bool(own), *rest]


def by_supplier(rows: RowsOnDisk) -> list[dict[str, Any]]:
    """Count the verdicts of each supplier, with the median expected RMS error of its translated files."""
    counted = ", ".join(f"sum(verdict = '{verdict}')" for verdict in SHOWN_VERDICTS)
    medians = dict(rows.do(_MEDIAN_OF_EACH).fetchall())
    found = []
    for name, files, *counts in rows.do(
        f"select supplier, count(*), {counted} from rows group by supplier order by supplier"
    ):
        middle = f"{medians[name]:.0%}" if name in medians else "–"
        found.append({"name": name, "files": files, "counts": counts, "ratio": middle})
    return found


def median_expected(rows: RowsOnDisk) -> float | None:
    """The median expected RMS error of the translated files; None where no translator states one."""
    found = rows.do(_median_of("expected_rms_ratio", "1")).fetchone()
    return found[1] if found else None


def _median_of(value: str, group: str) -> str:
    """A query for the median of what is known of the translated files, by group."""
    window = f"over (partition by {group}"
    placed = (
        f"select {group} as part, {value} as value, row_number() {window} order by {value}) as place, "
        f"count(*) {window}) as total from rows where verdict = '{TRANSLATED}' and {value} is not null"
    )
    middle = f"from ({placed}) where place in ((total + 1) / 2, (total + 2) / 2)"
    return f"select part, avg(value) {middle} group by part"


_MEDIAN_OF_EACH = _median_of("ratio", "supplier")


def _supplier(file: str, source: str) -> str:
    """The supplier; where it is no known category, the folder, by which the user knows it."""
    folder, slash, _ = file.partition("/")
    return folder if source == UNKNOWN_SUPPLIER and slash else source


def _distance(value: float) -> float | None:
    """A file beyond the edge of the training data is not shown as one on it."""
    rounded = _rounded(value)
    return rounded + 0.01 if rounded == EDGE < value else rounded


def _rounded(value: float) -> float | None:
    return float(f"{value:.3g}") if np.isfinite(value) else None
