"""Training and test sets."""

from __future__ import annotations

from functools import partial

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tire_pipeline.errors import DomainError
from tire_pipeline.tire_table import random_split, split_by_tire, split_table

RNG = np.random.default_rng(7)
TIRES = RNG.integers(0, 150, 1000)
CATEGORIES = RNG.choice(list("ABCDEF"), 1000, p=[0.05, 0.1, 0.1, 0.4, 0.3, 0.05])


def test_random_split_is_stratified_and_complete():
    train, test = random_split(CATEGORIES, seed=1)
    assert len(test) == 200
    assert np.array_equal(np.sort(np.concatenate([train, test])), np.arange(1000))
    for name in "ABCDEF":
        share = np.mean(CATEGORIES[test] == name) - np.mean(name == CATEGORIES)
        assert abs(share) < 0.005


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**31), st.sampled_from([0.2, 0.25, 0.1, 0.5]))
def test_no_tire_is_on_both_sides(seed: int, share: float):
    train, test = split_by_tire(CATEGORIES, TIRES, seed=seed, test_share=share)
    assert not set(TIRES[train]) & set(TIRES[test])
    assert len(train) + len(test) == 1000
    assert abs(len(test) / 1000 - share) < 0.05
    for name in "DE":
        assert abs(np.mean(CATEGORIES[test] == name) - np.mean(name == CATEGORIES)) < 0.1


def test_the_random_split_does_mix_tires():
    train, test = random_split(CATEGORIES, seed=1)
    assert set(TIRES[train]) & set(TIRES[test])


def test_the_seed_decides():
    for split in (
        partial(random_split, CATEGORIES),
        partial(split_by_tire, CATEGORIES, TIRES),
    ):
        assert np.array_equal(split(seed=3)[1], split(seed=3)[1])
        assert not np.array_equal(split(seed=3)[1], split(seed=4)[1])


def test_split_table():
    table = pd.DataFrame(
        {"file": [f"{i}.tir" for i in range(1000)], "category": CATEGORIES, "tire_id": TIRES.astype(str)}
    )
    splits = split_table(table, seed=2)
    assert list(splits.columns) == ["file", "random", "by_tire"]
    assert splits["file"].tolist() == table["file"].tolist()
    assert splits["random"].value_counts().to_dict() == {"train": 800, "test": 200}
    sides = pd.concat([table["tire_id"], splits["by_tire"]], axis=1).groupby("tire_id")["by_tire"].nunique()
    assert (sides == 1).all()


def test_too_little_to_split():
    with pytest.raises(DomainError, match="cannot be split"):
        random_split(["A", "A", "A", "B"], seed=0)
    with pytest.raises(DomainError, match="2 physical tires cannot be split"):
        split_by_tire(["A", "B"] * 10, ["x", "y"] * 10, seed=0)
