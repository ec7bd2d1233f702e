"""Drop what the thesis drops: duplicates, files without values, small categories."""

from __future__ import annotations

import pandas as pd
from pydantic import Field

from tire_pipeline.errors import DomainError
from tire_pipeline.parameters import Parameters
from tire_pipeline.representations.encoded_tires import RepresentParameters, needed_coefficients
from tire_pipeline.tire_table import TableInPieces, usable_files


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
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Keep the files that can be learned from.

    Parameters
    ----------
    tire_table_raw : TableInPieces
        Tire table of all files that could be read.
    parameters : DedupeFilterParameters
    represent : RepresentParameters
        Says which coefficients must have a value.
    target_category : str
        Must be among the categories that remain.

    Returns
    -------
    kept : DataFrame
    report : DataFrame
        One row a dropped file, with the reason.

    Raises
    ------
    DomainError
        If fewer than two categories remain, or the target is not among them.
    """
    kept, report = usable_files(
        tire_table_raw,
        minimum_per_category=parameters.minimum_per_category,
        features=needed_coefficients(represent),
        most_files=parameters.most_files,
    )
    _check_categories(kept, target_category)
    return kept, report


def _check_categories(kept: pd.DataFrame, target_category: str) -> None:
    """Raise if fewer than two categories remain, or the target is not among them."""
    counts = kept.groupby("category").size().to_dict()
    have = ", ".join(f"{name} ({count})" for name, count in counts.items()) or "none"
    if len(counts) < 2:
        raise DomainError(
            f"two categories are needed to tell organisations apart; what remains: {have}",
            where="dedupe_filter",
            todo="add files of a second organisation, or lower dedupe_filter.minimum_per_category",
        )
    if target_category not in counts:
        raise DomainError(
            f"the target category {target_category!r} has no usable files; what remains: {have}",
            where="dedupe_filter",
            todo="set target_category to one of these",
        )
