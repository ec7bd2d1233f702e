"""A table in pieces is the same table; what is learned from is bounded."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
from kedro.io import Version

from tire_pipeline.datasets import TablePartsDataset
from tire_pipeline.errors import DomainError
from tire_pipeline.files.rows_on_disk import joined
from tire_pipeline.tire_table import (
    OVER_MOST,
    Piece,
    TableInPieces,
    dedupe_and_filter,
    join_tables,
    usable_files,
)
from tire_pipeline.tire_table.from_models import as_in_whole
from tire_pipeline.tire_table.in_pieces import Scratch


def _parts(count: int = 5, rows: int = 12) -> list[pd.DataFrame]:
    """Parts whose columns differ; some rows are equal, some lack a value, some tires are nameless."""
    rng = np.random.default_rng(3)
    names = [f"{rng.choice(list('ABC'))}/{n:03d}.tir" for n in rng.permutation(count * rows)]
    parts = []
    for number in range(count):
        own = names[number * rows : (number + 1) * rows]
        frame = pd.DataFrame({"file": own, "category": [n[0] for n in own], "version": "5.2", "date": ""})
        frame["PCY1"] = rng.integers(0, 15, rows) / 10.0
        frame["PDY1"] = np.where(rng.random(rows) < 0.2, np.nan, 1.0)
        if number % 2:
            frame["PHY1"] = np.where(rng.random(rows) < 0.5, np.nan, 0.0)
        frame["WIDTH"] = np.where(rng.random(rows) < 0.3, np.nan, 0.2 + 0.01 * rng.integers(0, 9, rows))
        numbers = frame.columns[4:]
        parts.append(as_in_whole(frame, numbers))
    return parts


def _table(parts: list[pd.DataFrame]) -> TableInPieces:
    return TableInPieces(tuple(map(Piece.of, parts)))


@pytest.mark.parametrize("features", [(), ("PCY1", "PDY1")])
def test_the_same_files_are_usable_as_of_the_whole(features):
    parts = _parts()
    whole = join_tables(parts)
    kept, report = usable_files(_table(parts), minimum_per_category=5, features=features, most_files=1000)
    expected, dropped = dedupe_and_filter(whole, 5, features)
    pd.testing.assert_frame_equal(kept, expected)
    pd.testing.assert_frame_equal(joined(report), dropped)
    assert 0 < len(kept) < len(whole)


def _bounded(table: pd.DataFrame, most: int) -> pd.Series:
    """Files of each category where the largest ones have given up files until there are so many."""
    counts = table["category"].value_counts().sort_index()
    bound = max(bound for bound in range(counts.max() + 1) if np.minimum(counts, bound).sum() <= most)
    bounded = np.minimum(counts, bound)
    assert (bounded < counts).any()
    assert (bounded == counts).any()
    return bounded


def test_what_is_kept_is_bounded_and_small_categories_keep_their_files():
    parts = _parts(rows=30)
    all_of_them, _ = usable_files(_table(parts), minimum_per_category=1, features=(), most_files=1000)
    most = len(all_of_them) // 2
    kept, report = usable_files(_table(parts), minimum_per_category=1, features=(), most_files=most)
    dropped = joined(report)
    more = dropped[dropped["reason"] == OVER_MOST]
    assert len(kept) <= most
    assert len(kept) + len(more) == len(all_of_them)
    assert (kept["category"].value_counts().sort_index() == _bounded(all_of_them, most)).all()
    again, _ = usable_files(_table(parts[::-1]), minimum_per_category=1, features=(), most_files=most)
    pd.testing.assert_frame_equal(again, kept)


def test_pieces_on_the_disk_and_in_the_scratch_file_come_back(tmp_path):
    parts = _parts()
    scratch = Scratch()
    table = TableInPieces(tuple(scratch.put(part) for part in parts))
    whole = join_tables(parts)
    pd.testing.assert_frame_equal(table.frame(), whole)
    dataset = TablePartsDataset(filepath=str(tmp_path / "t.json"), version=Version(None, "2026-01-01"))
    dataset.save(table)
    again = TablePartsDataset(filepath=str(tmp_path / "t.json"), version=Version(None, None)).load()
    pd.testing.assert_frame_equal(again.frame(), whole)
    assert len(again) == len(whole)
    some = whole["file"].tolist()[::3]
    pd.testing.assert_frame_equal(again.rows_of(some), whole[::3].reset_index(drop=True))
    assert again.rows_of([]).columns.tolist() == whole.columns.tolist()
    (part,) = (tmp_path / "t.json/2026-01-01").glob("part-*.parquet")
    part.write_bytes(part.read_bytes()[:-10])
    with pytest.raises(DomainError, match=f"{part.name}: this part of the table is damaged"):
        again.frame()


def test_many_small_pieces_are_stored_as_few():
    parts = _parts(count=6, rows=10)
    table = _table(parts)
    few = list(table.gathered(25))
    assert [len(frame) for frame in few] == [30, 30]
    pd.testing.assert_frame_equal(
        pd.concat(few), pd.concat(table).reset_index(drop=True).set_axis([*range(30)] * 2)
    )
