"""Bins of features."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from sklearn.preprocessing import KBinsDiscretizer

from tire_pipeline.errors import DomainError
from tire_pipeline.tire_table import Binning

RNG = np.random.default_rng(3)
TRAIN = np.column_stack([RNG.normal(5, 2, 500), RNG.exponential(1e-3, 500), np.full(500, 7.0)])
KINDS = ["equal_width", "equal_frequency"]


def test_equal_width_is_that_of_scikit_learn():
    binning = Binning.fit(TRAIN[:, :2], 10)
    other = KBinsDiscretizer(10, encode="ordinal", strategy="uniform").fit(TRAIN[:, :2])
    assert np.array_equal(binning.transform(TRAIN[:, :2]), other.transform(TRAIN[:, :2]))
    bins = RNG.integers(0, 10, (20, 2))
    assert np.allclose(binning.inverse(bins), other.inverse_transform(bins), rtol=1e-12, atol=0)


def test_equal_frequency_holds_as_many_rows_in_each_bin():
    binning = Binning.fit(TRAIN[:, :2], 10, "equal_frequency")
    bins = binning.transform(TRAIN[:, :2])
    for i in range(2):
        assert np.bincount(bins[:, i], minlength=10).tolist() == [50] * 10


@pytest.mark.parametrize("kind", KINDS)
def test_range_is_that_of_the_training_set(kind):
    binning = Binning.fit(TRAIN, 8, kind)
    scaled = binning.scale(TRAIN)
    assert np.array_equal(scaled.min(axis=0), [0, 0, 0])
    assert np.array_equal(scaled.max(axis=0), [1, 1, 0])
    outside = np.array([[-1e6, -1e6, -1e6], [1e6, 1e6, 1e6]])
    assert binning.transform(outside)[:, :2].tolist() == [[0, 0], [7, 7]]


@pytest.mark.parametrize("kind", KINDS)
@settings(max_examples=60, deadline=None)
@given(
    data=hnp.arrays(
        float, st.tuples(st.integers(1, 40), st.integers(1, 4)), elements=st.floats(-1e3, 1e3, width=16)
    ),
    n_bins=st.integers(1, 30),
)
def test_centres_fall_into_their_own_bin(kind, data, n_bins):
    binning = Binning.fit(data, n_bins, kind)
    bins = binning.transform(data)
    assert bins.min() >= 0
    assert bins.max() < n_bins
    values = binning.inverse(bins)
    spans = (binning.high - binning.low) / n_bins
    if kind == "equal_width":
        assert np.all(np.abs(values - data) <= spans / 2 * (1 + 1e-9) + 1e-12)
        wide = spans > 0
        assert np.array_equal(binning.transform(values)[:, wide], bins[:, wide])
    assert np.all((values >= binning.low - 1e-9) & (values <= binning.high + 1e-9))


@pytest.mark.parametrize("kind", KINDS)
def test_state(kind, tmp_path):
    binning = Binning.fit(TRAIN, 6, kind, ["PCY1", "PDY1", "PEY1"])
    path = tmp_path / "bins.npz"
    np.savez(path, **binning.to_state())
    with np.load(path, allow_pickle=False) as state:
        again = Binning.from_state(state)
    assert (again.names, again.kind, again.n_bins) == (("PCY1", "PDY1", "PEY1"), kind, 6)
    assert np.array_equal(again.transform(TRAIN), binning.transform(TRAIN))
    assert np.array_equal(again.edges, binning.edges)


@pytest.mark.parametrize(
    "change",
    [
        {"kind": "other"},
        {"low": np.zeros(2)},
        {"edges": np.zeros((3, 1))},
        {"edges": "nonsense"},
        {"high": np.array([1.0, np.nan, 1.0])},
        {"names": np.array(["a"])},
    ],
)
def test_a_tampered_state_is_refused(change):
    with pytest.raises(DomainError, match="not the state of a binning"):
        Binning.from_state({**Binning.fit(TRAIN, 4).to_state(), **change})
    with pytest.raises(DomainError):
        Binning.from_state({})


def test_what_cannot_be_binned():
    with pytest.raises(DomainError, match="no value in some row"):
        Binning.fit(np.array([[1.0, np.nan]]), 4)
    with pytest.raises(DomainError, match="0 rows"):
        Binning.fit(np.empty((0, 3)), 4)
    with pytest.raises(DomainError, match="into 0 bins"):
        Binning.fit(TRAIN, 0)
    with pytest.raises(DomainError, match="kind 'round'"):
        Binning.fit(TRAIN, 4, "round")
    binning = Binning.fit(TRAIN, 4)
    with pytest.raises(DomainError, match="shape"):
        binning.transform(TRAIN[:, :2])
    for wrong in (-1, 4):
        with pytest.raises(DomainError, match="0 to 3"):
            binning.inverse([[0, 0, wrong]])
