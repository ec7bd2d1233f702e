"""Drop the files that cannot be learned from, and say which and why."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Sequence

import numpy as np
import pandas as pd

from tire_pipeline.errors import DomainError
from tire_pipeline.tire_table.in_pieces import TableInPieces

IDENTICAL = "identical coefficients"
NO_VALUE = "feature without a value"
OVERFLOWS = "value that overflows"
TOO_SMALL = "category too small"
OVER_MOST = "more files than training takes"

LARGEST_TO_SQUARE = float(np.sqrt(np.finfo(np.float32).max))
"""Larger values overflow where they are squared in single precision."""
_NAME_OF_FORCE_COLUMN = re.compile(r"[PQRS][A-Z]+\d+|L[A-Z]{2,4}|FNOMIN").fullmatch


def dedupe_and_filter(
    table: pd.DataFrame,
    minimum_per_category: int = 20,
    features: Sequence[str] = (),
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Drop duplicates, files with features without a value, and small categories (thesis, section 4.1).

    In this order, each step on what the one before left: first files whose p, q, r, s coefficients, scale
    factors and ``FNOMIN`` are all equal to those of an earlier row (to the bit; a missing one equals a
    missing one), whatever their category; then files that lack a feature; then files with a number that
    overflows when it is squared in single precision, or a nominal load so near zero; then categories with
    fewer than ``minimum_per_category`` files left. So a category counts by what can be used of it.

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
        of ``IDENTICAL``, ``NO_VALUE``, ``OVERFLOWS`` and ``TOO_SMALL``; ``detail`` names the file that
        stays, the features, the values, or the count.

    Raises
    ------
    DomainError
        A feature is no column of the table.
    """
    _refuse_unknown(features, table.columns)
    force = [name for name in table.columns if _NAME_OF_FORCE_COLUMN(name)]
    keys = _keys(table, force, list(features))
    reason, detail = _marks(keys, minimum_per_category)
    return table[(reason == "").to_numpy()].reset_index(drop=True), _report(keys, reason, detail)


def usable_files(
    table: TableInPieces, *, minimum_per_category: int, features: Sequence[str], most_files: int
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """The same of a table that need not fit into memory; what stays is held whole, so it is bounded.

    Of each file its name, category and a hash of its coefficients are held, about 0.3 kB.

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
    kept, report : DataFrame
        As in :func:`dedupe_and_filter`, in the order of ``file``.
    """
    _refuse_unknown(features, table.numbers)
    force = sorted(name for name in table.numbers if _NAME_OF_FORCE_COLUMN(name))
    parts = [_keys(part, force, list(features)) for part in table]
    keys = pd.concat(parts or [_keys(table.frame(), force, list(features))], ignore_index=True)
    keys = keys.sort_values("file", ignore_index=True)
    reason, detail = _marks(keys, minimum_per_category)
    _mark_more(keys, most_files, reason, detail)
    return table.rows_of(set(keys["file"][reason == ""])), _report(keys, reason, detail)


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
    keys["tire"] = table["tire_id"].to_numpy() if "tire_id" in table else ""
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


def _marks(keys: pd.DataFrame, minimum: int) -> tuple[pd.Series, pd.Series]:
    """Why each file is dropped, empty if it is not, and the detail."""
    reason = pd.Series("", index=keys.index, dtype="str")
    detail = reason.copy()
    _mark_identical(keys, reason, detail)
    for column, why in (("missing", NO_VALUE), ("overflow", OVERFLOWS)):
        here = (keys[column] != "") & (reason == "")
        reason[here] = why
        detail[here] = keys[column][here]
    _mark_small(keys, minimum, reason, detail)
    return reason, detail


def _report(keys: pd.DataFrame, reason: pd.Series, detail: pd.Series) -> pd.DataFrame:
    dropped = reason != ""
    report = keys.loc[dropped, ["file", "category"]].assign(reason=reason[dropped], detail=detail[dropped])
    return report.reset_index(drop=True)


def _mark_identical(keys: pd.DataFrame, reason: pd.Series, detail: pd.Series) -> None:
    first = keys.groupby("equal", sort=False)["file"].transform("first")
    double = first != keys["file"]
    reason[double] = IDENTICAL
    detail[double] = "as " + first[double]


def _mark_more(keys: pd.DataFrame, most: int, reason: pd.Series, detail: pd.Series) -> None:
    usable = keys[reason == ""]
    if len(usable) <= most:
        return
    each = _most_of_each(sorted(usable.groupby("category").size()), most)
    place = usable["tire"].map(lambda tire: hashlib.sha256(tire.encode()).digest())
    rank = usable.assign(place=place).sort_values(["place", "file"]).groupby("category").cumcount()
    more = rank.index[rank >= each]
    reason[more] = OVER_MOST
    detail[more] = f"{each} of its category are taken"


def _most_of_each(counts: Sequence[int], most: int) -> int:
    """How many of each category there may be, so that all together are at most so many."""
    left = most
    for done, count in enumerate(counts):
        each = left // (len(counts) - done)
        if count > each:
            return each
        left -= count
    return most


def _mark_small(keys: pd.DataFrame, minimum: int, reason: pd.Series, detail: pd.Series) -> None:
    left = keys.loc[reason == "", "category"]
    counts = left.map(left.value_counts())
    small = counts.index[counts < minimum]
    reason[small] = TOO_SMALL
    detail[small] = [f"{count} usable, {minimum} needed" for count in counts[small]]
