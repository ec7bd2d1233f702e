"""What is left to learn from, and what a user with few files is told."""

from __future__ import annotations

import pandas as pd
import pytest

from tire_pipeline.errors import DomainError
from tire_pipeline.files.rows_on_disk import joined
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.representations.encoded_tires import RepresentParameters, needed_coefficients
from tire_pipeline.representations.usable_tires import DedupeFilterParameters, keep_usable
from tire_pipeline.tire_table import (
    NO_CATEGORY,
    NO_VALUE,
    Piece,
    TableInPieces,
    dedupe_and_filter,
    from_models,
)

COUNTS = {"a_lab": 4, "b_lab": 3, "c_lab": 2}


def _files(without_radius: str = "") -> TableInPieces:
    models = []
    for name, count in COUNTS.items():
        for number in range(count):
            path = f"{name}/{number}.tir"
            values = dict.fromkeys(needed_coefficients(RepresentParameters()), 0.1 + 0.01 * len(models))
            values |= {"FNOMIN": 4000.0} | ({} if path == without_radius else {"UNLOADED_RADIUS": 0.3})
            models.append((path, name, TireModel.from_coefficients(values)))
    return TableInPieces((Piece.of(from_models(models)),))


def _keep(minimum: int, target: str = "a_lab", **files: str) -> tuple[pd.DataFrame, pd.DataFrame]:
    parameters = DedupeFilterParameters(minimum_per_category=minimum)
    kept, report = keep_usable(_files(**files), parameters, RepresentParameters(), target)
    return kept, joined(report)


def test_a_file_without_radius_does_not_stop_the_others():
    kept, report = _keep(2, without_radius="b_lab/1.tir")
    assert len(kept) == sum(COUNTS.values()) - 1
    assert report[["file", "reason", "detail"]].to_numpy().tolist() == [
        ["b_lab/1.tir", NO_VALUE, "UNLOADED_RADIUS"]
    ]


def test_few_files_are_counted_in_the_message():
    with pytest.raises(DomainError) as found:
        _keep(20)
    assert "what remains: none; too small: a_lab (4 usable, 20 needed), b_lab (3 usable" in str(found.value)
    assert "lower dedupe_filter.minimum_per_category" in str(found.value)


def test_files_that_lie_in_no_folder_are_of_no_organisation(monkeypatch):
    """They were treated as the files of one more organisation, which had no name."""
    monkeypatch.setitem(COUNTS, "", 5)
    kept, report = _keep(2)
    assert set(kept["category"]) == {"a_lab", "b_lab", "c_lab"}
    loose = report[report["reason"] == NO_CATEGORY]
    assert len(loose) == 5
    assert set(loose["detail"]) == {"its folder would say which organisation measured it"}
    with pytest.raises(DomainError) as found:
        _keep(20)
    assert "not used: in no folder (5 files, such as /0.tir: its folder would say which" in str(found.value)
    assert "-> put the files that lie in no folder into one for each organisation; " in str(found.value)


def test_a_copy_in_no_folder_does_not_replace_the_file_in_one():
    values = dict.fromkeys(needed_coefficients(RepresentParameters()), 0.1) | {"FNOMIN": 4000.0}
    model = TireModel.from_coefficients(values)
    table = from_models([("1.tir", "", model), ("a_lab/1.tir", "a_lab", model)])
    kept, report = dedupe_and_filter(table, 1)
    assert list(kept["file"]) == ["a_lab/1.tir"]
    assert list(report["reason"]) == [NO_CATEGORY]


def test_a_target_that_is_too_small_is_not_answered_by_another_target():
    with pytest.raises(DomainError) as found:
        _keep(3, target="c_lab")
    assert "'c_lab' has no usable files; what remains: a_lab (4), b_lab (3)" in str(found.value)
    assert "c_lab (2 usable, 3 needed)" in str(found.value)
    assert "lower dedupe_filter.minimum_per_category" in str(found.value)
