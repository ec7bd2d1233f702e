"""Drop what the thesis drops: duplicates, files without values, small categories."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

import pandas as pd
from pydantic import Field

from tire_pipeline.errors import DomainError
from tire_pipeline.parameters import Parameters
from tire_pipeline.representations.encoded_tires import RepresentParameters, needed_coefficients
from tire_pipeline.tire_table import NO_CATEGORY, TOO_SMALL, TableInPieces, usable_files

_STATED_IN_FILE = ("UNLOADED_RADIUS",)
"""What a file must state beside its features: without it moments have no value to learn from."""


class DedupeFilterParameters(Parameters):
    """Parameters of ``dedupe_filter``.

    Attributes
    ----------
    minimum_per_category : int
        Smaller categories are set aside.
    most_files : int
        So many are learned from at most; they are held in memory together.
    """

    minimum_per_category: int = Field(20, ge=1)
    most_files: int = Field(100_000, ge=1)


def keep_usable(
    tire_table_raw: TableInPieces,
    parameters: DedupeFilterParameters,
    represent: RepresentParameters,
    target_category: str,
) -> tuple[pd.DataFrame, Iterable[pd.DataFrame]]:
    """Keep the files that can be learned from.

    Parameters
    ----------
    tire_table_raw : TableInPieces
        Tire table of all files that could be read.
    parameters : DedupeFilterParameters
    represent : RepresentParameters
        Says which coefficients must have a value; the unloaded radius must have one, too.
    target_category : str
        Must be among the categories that remain.

    Returns
    -------
    kept : DataFrame
    report : iterable of DataFrame
        One row a dropped file, with the reason; some thousand at a time.

    Raises
    ------
    DomainError
        If fewer than two categories remain, or the target is not among them.
    """
    kept, report = usable_files(
        tire_table_raw,
        minimum_per_category=parameters.minimum_per_category,
        features=[*needed_coefficients(represent), *_STATED_IN_FILE],
        most_files=parameters.most_files,
    )
    _check_categories(kept, report, target_category)
    return kept, report


def _check_categories(kept: pd.DataFrame, report: Iterable[pd.DataFrame], target_category: str) -> None:
    """Raise if fewer than two categories remain, or the target is not among them."""
    have = kept.groupby("category").size().to_dict()
    if len(have) >= 2 and target_category in have:
        return
    small = _too_small(report)
    remains = f"what remains: {_listed(have)}"
    if small:
        remains += f"; too small: {_listed(small)}"
    remains += _not_used(report)
    more = "add files to these, or lower dedupe_filter.minimum_per_category"
    loose = any((frame["reason"] == NO_CATEGORY).any() for frame in report)
    first = "put the files that lie in no folder into one for each organisation; " if loose else ""
    if len(have) < 2:
        raise DomainError(
            f"two categories are needed to tell organisations apart; {remains}",
            where="dedupe_filter",
            todo=first + (more if small else "add files of a second organisation"),
        )
    raise DomainError(
        f"the target category {target_category!r} has no usable files; {remains}",
        where="dedupe_filter",
        todo=first
        + (more if target_category in small else "set target_category to one of those that remain"),
    )


def _too_small(report: Iterable[pd.DataFrame]) -> dict[str, object]:
    """The detail of each category that is too small."""
    found: dict[str, object] = {}
    for frame in report:
        rows = frame[frame["reason"] == TOO_SMALL].groupby("category")["detail"].first()
        found = rows.to_dict() | found
    return dict(sorted(found.items()))


def _not_used(report: Iterable[pd.DataFrame]) -> str:
    """Say which files do not count and why: a run that stops here writes no report of it."""
    counts, firsts = Counter[str](), dict[str, str]()
    for frame in report:
        for reason, rows in frame[frame["reason"] != TOO_SMALL].groupby("reason", sort=False):
            counts[str(reason)] += len(rows)
            firsts.setdefault(str(reason), f"{rows['file'].iloc[0]}: {rows['detail'].iloc[0]}")
    said = [
        f"{reason} ({count} {'file' if count == 1 else 'files, such as'} {firsts[reason]})"
        for reason, count in counts.items()
    ]
    return f"; not used: {'; '.join(said)}" if said else ""


def _listed(found: dict[str, object]) -> str:
    return ", ".join(f"{name} ({what})" for name, what in found.items()) or "none"
