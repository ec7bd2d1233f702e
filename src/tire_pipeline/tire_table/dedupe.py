"""Drop the files that cannot be learned from, and say which and why."""

from __future__ import annotations

import re
from collections.abc import Sequence

import pandas as pd

from tire_pipeline.errors import DomainError

IDENTICAL = "identical coefficients"
NO_VALUE = "feature without a value"
TOO_SMALL = "category too small"

_FORCE_COEFFICIENT = re.compile(r"[PQRS][A-Z]+\d+|L[A-Z]{2,4}|FNOMIN").fullmatch


def dedupe_and_filter(
    table: pd.DataFrame,
    minimum_per_category: int = 20,
    features: Sequence[str] = (),
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Drop duplicates, files with features without a value, and small categories (thesis, section 4.1).

    In this order, each step on what the one before left: first files whose p, q, r, s coefficients, scale
    factors and ``FNOMIN`` are all equal to those of an earlier row (to the bit; a missing one equals a
    missing one), whatever their category; then files that lack a feature; then categories with fewer than
    ``minimum_per_category`` files left. So a category counts by what can be used of it.

    Parameters
    ----------
    table : DataFrame
        A tire table.
    minimum_per_category : int
    features : sequence of str
        Columns that must have a value.

    Returns
    -------
    kept : DataFrame
        The rows that stay, in their order, with a new index.
    report : DataFrame
        One row a dropped file, in the table's order: ``file, category, reason, detail``. ``reason`` is one
        of ``IDENTICAL``, ``NO_VALUE`` and ``TOO_SMALL``; ``detail`` names the file that stays, the
        features, or the count.

    Raises
    ------
    DomainError
        A feature is no column of the table.
    """
    unknown = [name for name in features if name not in table.columns]
    if unknown:
        raise DomainError(
            f"no file has a value for {', '.join(unknown)}",
            todo="choose a representation that these files can give",
        )
    reason = pd.Series("", index=table.index, dtype="str")
    detail = reason.copy()
    _mark_identical(table, reason, detail)
    _mark_empty(table, list(features), reason, detail)
    _mark_small(table, minimum_per_category, reason, detail)
    dropped = reason != ""
    report = table.loc[dropped, ["file", "category"]].assign(reason=reason[dropped], detail=detail[dropped])
    return table[~dropped].reset_index(drop=True), report.reset_index(drop=True)


def _mark_identical(table: pd.DataFrame, reason: pd.Series, detail: pd.Series) -> None:
    columns = [name for name in table.columns if _FORCE_COEFFICIENT(name)]
    if not columns:
        return
    groups = table.groupby(columns, dropna=False, sort=False)["file"]
    first = groups.transform("first")
    double = first != table["file"]
    reason[double] = IDENTICAL
    detail[double] = "as " + first[double]


def _mark_empty(table: pd.DataFrame, features: list[str], reason: pd.Series, detail: pd.Series) -> None:
    empty = table[features].isna()
    here = empty.any(axis=1) & (reason == "")
    reason[here] = NO_VALUE
    detail[here] = [", ".join(empty.columns[row]) for row in empty[here].to_numpy()]


def _mark_small(table: pd.DataFrame, minimum: int, reason: pd.Series, detail: pd.Series) -> None:
    left = table.loc[reason == "", "category"]
    counts = left.map(left.value_counts())
    small = counts.index[counts < minimum]
    reason[small] = TOO_SMALL
    detail[small] = [f"{count} usable, {minimum} needed" for count in counts[small]]
