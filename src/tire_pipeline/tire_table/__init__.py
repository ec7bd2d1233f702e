"""Many tires as one table: what can be learned from, one nominal load, splits, bins."""

from tire_pipeline.tire_table.binning import Binning
from tire_pipeline.tire_table.dedupe import (
    IDENTICAL,
    LARGEST_TO_SQUARE,
    NO_CATEGORY,
    NO_VALUE,
    OVER_MOST,
    OVERFLOWS,
    TOO_SMALL,
    dedupe_and_filter,
    usable_files,
)
from tire_pipeline.tire_table.from_models import KNOWN_COEFFICIENTS, METADATA, from_models, join_tables
from tire_pipeline.tire_table.in_pieces import Piece, TableInPieces
from tire_pipeline.tire_table.normalize import normalize_table
from tire_pipeline.tire_table.physical_tire import SIZE_KEYS, physical_tire_ids, told_tires
from tire_pipeline.tire_table.splits import random_split, split_by_tire, split_table

__all__ = [
    "IDENTICAL",
    "KNOWN_COEFFICIENTS",
    "LARGEST_TO_SQUARE",
    "METADATA",
    "NO_CATEGORY",
    "NO_VALUE",
    "OVERFLOWS",
    "OVER_MOST",
    "SIZE_KEYS",
    "TOO_SMALL",
    "Binning",
    "Piece",
    "TableInPieces",
    "dedupe_and_filter",
    "from_models",
    "join_tables",
    "normalize_table",
    "physical_tire_ids",
    "random_split",
    "split_by_tire",
    "split_table",
    "told_tires",
    "usable_files",
]
