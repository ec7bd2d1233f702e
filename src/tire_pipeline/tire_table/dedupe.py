"""Drop the files that cannot be learned from, and say which and why."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable, Sequence

import numpy as np
import pandas as pd

from tire_pipeline.errors import DomainError
from tire_pipeline.files.rows_on_disk import FramesOfRows, RowsOnDisk, joined
from tire_pipeline.tire_table.in_pieces import TableInPieces

IDENTICAL = "identical coefficients"
NO_VALUE = "feature without a value"
OVERFLOWS = "value that overflows"
TOO_SMALL = "category too small"
NO_CATEGORY = "in no folder"
OVER_MOST = "more files than training takes"

LARGEST_TO_SQUARE = float(np.sqrt(np.finfo(np.float32).max))
"""Larger values overflow where they are squared in single precision."""
_MARKED = ["place", "file", "category", "equal", "chance", "missing", "overflow", "reason", "detail"]
_REPORT_TYPES = {"file": "str", "category": "str", "reason": "str", "detail": "str"}
_STAYS = "reason = ''"
_USABLE_OF_EACH = f"select category, count(*) from rows where {_STAYS} group by category"
_NAME_OF_FORCE_COLUMN = re.compile(r"[PQRS][A-Z]+\d+|L[A-Z]{2,4}|FNOMIN").fullmatch


def dedupe_and_filter(
    table: pd.DataFrame,
    minimum_per_category: int = 20,
    features: Sequence[str] = (),
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Drop duplicates, files with features without a value, and small categories (thesis, section 4.1).

    In this order, each step on what the one before left: first files that lie in no folder, of which nobody
    knows who measured them; then files whose p, q, r, s coefficients, scale factors and ``FNOMIN`` are all
    equal to those of an earlier row (to the bit; a missing one equals a missing one), whatever their
    category; then files that lack a feature; then files with a number that overflows when it is squared in
    single precision, or a nominal load so near zero; then categories with fewer than
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
        of ``IDENTICAL``, ``NO_CATEGORY``, ``NO_VALUE``, ``OVERFLOWS`` and ``TOO_SMALL``; ``detail`` names
        the file that stays, the features, the values, or the count.

    Raises
    ------
    DomainError
        A feature is no column of the table.
    """
    _refuse_nothing(len(table))
    _refuse_unknown(features, table.columns)
    force = [name for name in table.columns if _NAME_OF_FORCE_COLUMN(name)]
    keys = _keys(table, force, list(features))
    marked = _marked([keys.assign(place=np.arange(len(keys)))], minimum_per_category)
    kept = [place for (place,) in marked.do(f"select place from rows where {_STAYS} order by place")]
    return table.iloc[kept].reset_index(drop=True), joined(_report(marked))


def usable_files(
    table: TableInPieces, *, minimum_per_category: int, features: Sequence[str], most_files: int
) -> tuple[pd.DataFrame, FramesOfRows]:
    """The same of a table that need not fit into memory; what stays is held whole, so it is bounded.

    Name, category and a hash of the coefficients of each file are compared on the disk.

    Parameters
    ----------
    table : TableInPieces
    minimum_per_category, features
        As in :func:`dedupe_and_filter`.
    most_files : int
        If more files than this are usable, large categories give up files until there are so many; small
        ones keep all of theirs. Which files stay depends on their physical tires alone
        (:func:`.physical_tire.physical_tire_ids`), so that each category keeps the same ones. The others
        are reported as ``OVER_MOST``.

    Returns
    -------
    kept : DataFrame
    report : iterable of DataFrame
        As in :func:`dedupe_and_filter`, in the order of ``file``; the report some thousand rows at a time.
    """
    _refuse_nothing(len(table))
    _refuse_unknown(features, table.numbers)
    force = sorted(name for name in table.numbers if _NAME_OF_FORCE_COLUMN(name))
    parts = (_keys(part, force, list(features)) for part in table)
    marked = _marked((keys.assign(place=keys["file"]) for keys in parts), minimum_per_category)
    _mark_more(marked, most_files)
    kept = {file for (file,) in marked.do(f"select file from rows where {_STAYS}")}
    return table.rows_of(kept), _report(marked)


def _refuse_nothing(files: int) -> None:
    if not files:
        raise DomainError(
            "there is no file to learn from",
            todo="put .tir files into <folder>/<category>/*.tir; the list of files says why each of those "
            "there was not read",
        )


def _refuse_unknown(features: Sequence[str], columns: Sequence[str] | pd.Index) -> None:
    unknown = [name for name in features if name not in columns]
    if unknown:
        raise DomainError(
            f"no file has a value for {', '.join(unknown)}",
            todo="choose a representation that these files can give",
        )


def _keys(table: pd.DataFrame, force: list[str], features: list[str]) -> pd.DataFrame:
    """Of each file what is needed to judge it among all others."""
    values = table[force].to_numpy(dtype=float) + 0.0  # one zero only
    values[np.isnan(values)] = np.nan  # and one NaN
    keys = table[["file", "category"]].reset_index(drop=True)
    keys["equal"] = [hashlib.blake2b(row.tobytes(), digest_size=16).digest() for row in values]
    tires = table["tire_id"] if "tire_id" in table else [""] * len(table)
    keys["chance"] = [hashlib.sha256(tire.encode()).digest() for tire in tires]
    empty = table[features].isna().to_numpy()
    keys["missing"] = _named(features, empty)
    sizes = table.select_dtypes("number").abs()
    overflow = sizes > LARGEST_TO_SQUARE
    if "FNOMIN" in overflow:  # loads are divided by it
        overflow["FNOMIN"] |= sizes["FNOMIN"] < 1.0 / LARGEST_TO_SQUARE
    keys["overflow"] = _named(list(overflow.columns), overflow.to_numpy())
    return keys


def _named(columns: Sequence[str], marked: np.ndarray) -> list[str]:
    """The names of the columns that are marked in each row."""
    names = np.array(columns, dtype=object)
    return [", ".join(names[row]) if row.any() else "" for row in marked]


def _marked(keys: Iterable[pd.DataFrame], minimum: int) -> RowsOnDisk:
    """Each file with its reason, empty if it is not dropped, and the detail; ``place`` orders the files."""
    rows = RowsOnDisk(_MARKED)
    for frame in keys:
        rows.add(frame.assign(reason="", detail="")[_MARKED].astype(object).itertuples(index=False))
    _mark(rows, NO_CATEGORY, "?", "category = ''", "its folder would say which organisation measured it")
    _mark_identical(rows)
    for column, why in (("missing", NO_VALUE), ("overflow", OVERFLOWS)):
        _mark(rows, why, column, f"{column} <> ''")
    for category, count in rows.do(_USABLE_OF_EACH).fetchall():
        if count < minimum:
            _mark(rows, TOO_SMALL, "?", "category = ?", f"{count} usable, {minimum} needed", category)
    return rows


def _mark(rows: RowsOnDisk, why: str, detail: str, where: str, *values: str) -> None:
    rows.do(f"update rows set reason = '{why}', detail = {detail} where {_STAYS} and {where}", values)


def _report(marked: RowsOnDisk) -> FramesOfRows:
    query = f"select {', '.join(_REPORT_TYPES)} from rows where not {_STAYS} order by place"
    return FramesOfRows(marked, query, _REPORT_TYPES)


def _mark_identical(rows: RowsOnDisk) -> None:
    """With ``min``, SQLite gives the file of the row that has it."""
    first = (
        f"select equal, file, min(place) as place from rows where {_STAYS} group by equal having count(*) > 1"
    )
    rows.do(
        f"update rows set reason = '{IDENTICAL}', detail = 'as ' || first.file from ({first}) as first "
        f"where {_STAYS} and rows.equal = first.equal and rows.place <> first.place"
    )


def _mark_more(rows: RowsOnDisk, most: int) -> None:
    counts = sorted(count for _, count in rows.do(_USABLE_OF_EACH))
    if sum(counts) <= most:
        return
    each = _most_of_each(counts, most)
    rank = "row_number() over (partition by category order by chance, file)"
    ranked = f"select place, {rank} as rank from rows where {_STAYS}"
    more = f"place in (select place from ({ranked}) where rank > {each})"
    _mark(rows, OVER_MOST, "?", more, f"{each} of its category are taken")


def _most_of_each(counts: Sequence[int], most: int) -> int:
    """How many of each category there may be, so that all together are at most so many."""
    left = most
    for done, count in enumerate(counts):
        each = left // (len(counts) - done)
        if count > each:
            return each
        left -= count
    return most
