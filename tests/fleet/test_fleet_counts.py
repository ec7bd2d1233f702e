"""How many files of each sort there are."""

from collections import Counter

import pytest

from tire_pipeline.errors import DomainError
from tire_pipeline.fleet.settings import (
    FULL_FILES,
    FULL_KEPT,
    SMALLEST_FLEET,
    FleetSettings,
    file_counts,
)


def test_full_fleet_splits_as_in_the_thesis() -> None:
    counts = file_counts(FULL_FILES)
    assert sum(counts.kept.values()) == FULL_KEPT == 2061
    assert sum(counts.kept.values()) + counts.copies + counts.missing + sum(counts.tiny.values()) == 3648
    share = (counts.kept["D"] + counts.kept["E"]) / 2061
    assert 0.68 <= share <= 0.72
    assert len(counts.kept) == 6
    assert max(counts.tiny.values()) < 20 <= min(counts.kept.values())


@pytest.mark.parametrize("files", [SMALLEST_FLEET, 400, 1000, 2500, FULL_FILES])
def test_every_size_adds_up(files: int) -> None:
    counts = file_counts(files)
    parts = [*counts.kept.values(), *counts.tiny.values(), counts.copies, counts.missing]
    assert sum(parts) == files
    assert min(parts) > 0
    assert min(counts.kept.values()) >= 20


@pytest.mark.slow
def test_files_of_the_fleet_are_those_counted(small_fleet, small_settings) -> None:
    counts = file_counts(small_settings.files)
    origin = small_fleet.truth.files
    assert set(origin["file"]) == set(small_fleet.files)
    kept = origin[origin["file_role"] == "kept"]
    assert kept["category"].value_counts().to_dict() == counts.kept
    roles = Counter(origin["file_role"])
    assert roles["copy"] == counts.copies
    assert roles["missing"] == counts.missing
    assert roles["tiny"] == sum(counts.tiny.values())


@pytest.mark.parametrize(
    "wrong",
    [
        {"kind": "odd"},
        {"target": "F"},
        {"bias_size": -0.1},
        {"files": 10},
        {"hidden_tires": 0},
        {"paired_tires": 13},
        {"variants": 0.5},
        {"drifting": ("Z",)},
    ],
)
def test_wrong_settings_say_what_is_allowed(wrong: dict) -> None:
    with pytest.raises(DomainError, match=r"use|->") as caught:
        FleetSettings(**wrong)
    assert next(iter(wrong)) in str(caught.value)
    assert caught.value.todo
