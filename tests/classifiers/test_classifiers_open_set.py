"""Files of suppliers that were never seen are turned away, those of known ones are not."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.classifiers.open_set import (
    LEAST_PROBABILITY,
    LEAST_TYPICALITY,
    Assignment,
    OpenSetClassifier,
    left_out_check,
)
from tire_pipeline.classifiers.supplier_features import supplier_features
from tire_pipeline.errors import DomainError
from tire_pipeline.fleet import FleetSettings, make_fleet
from tire_pipeline.representations.coefficients import LATERAL_WITHOUT_CAMBER
from tire_pipeline.tir import read_tir
from tire_pipeline.tire_table import dedupe_and_filter, from_models, normalize_table

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def table():
    fleet = make_fleet(FleetSettings(seed=41, files=500, tuning_tires=1, hidden_tires=1, threads=1))
    models = ((p, p.split("/")[0], read_tir(text.encode("latin-1"))) for p, text in fleet.files.items())
    kept, _ = dedupe_and_filter(from_models(models), features=LATERAL_WITHOUT_CAMBER)
    return normalize_table(kept, 6000.0).reset_index(drop=True)


def blobs(rng, centres, tires=30, files=4, spread=1.0):
    """Files of tires of suppliers, 6 numbers each, about the suppliers' means."""
    parts, labels, names = [], [], []
    for k, centre in enumerate(centres):
        own = rng.normal(0.0, spread, (tires, 1, 6)) + centre
        parts.append((own + rng.normal(0.0, 0.2, (tires, files, 6))).reshape(-1, 6))
        labels += [f"S{k}"] * (tires * files)
        names += [f"S{k} tire {i}" for i in range(tires) for _ in range(files)]
    return np.concatenate(parts), np.array(labels), np.array(names)


def test_each_category_left_out_in_turn(table):
    features, _ = supplier_features(table)
    found = left_out_check(
        features, table["category"].to_numpy(str), table["tire_id"].to_numpy(str)
    ).set_index("category")
    assert set(found.index) == {"A", "B", "C", "D", "E", "F"}
    assert (found["given_when_unseen"] <= 0.05).all(), found
    assert np.average(found["right"], weights=found["files"]) >= 0.80, found
    assert np.average(found["wrong"], weights=found["files"]) <= 0.01, found


def test_an_unknown_supplier_gets_a_high_probability_and_is_turned_away_all_the_same():
    rng = np.random.default_rng(5)
    features, labels, tires = blobs(rng, [0.0, 8.0])
    model = OpenSetClassifier().fit(features, labels, tires)
    far = np.full((1, 6), 30.0)
    found = model.assign(far)
    assert found.probability[0] >= LEAST_PROBABILITY
    assert found.typicality[0] == pytest.approx(1 / 121)
    assert not found.given[0]
    between = model.assign(np.full((1, 6), 4.0))
    assert not between.given[0]


def test_typicality_turns_away_the_stated_share_of_files_of_new_tires():
    shares = []
    for seed in range(20):
        rng = np.random.default_rng(seed)
        centres = [0.0, 12.0, -12.0]
        model = OpenSetClassifier().fit(*blobs(rng, centres, files=1), seed=seed)
        new, labels, _ = blobs(rng, centres, files=1)
        found = model.assign(new)
        assert (found.category == labels).all()
        shares.append((found.typicality >= LEAST_TYPICALITY).mean())
    assert np.mean(shares) == pytest.approx(1.0 - LEAST_TYPICALITY, abs=0.03)


def test_a_habit_that_is_broken_tells_another_supplier(table):
    """One number that never varied: the supplier's files always state this range, the new one does not."""
    features, names = supplier_features(table)
    model = OpenSetClassifier().fit(features, table["category"].to_numpy(str), table["tire_id"].to_numpy(str))
    own = features[(table["category"] == "B").to_numpy()]
    usual = model.assign(own).given.mean()
    own[:, names.index("CAMMAX")] *= 2.0
    assert usual > 0.8
    assert model.assign(own).given.mean() == 0.0


def test_only_both_together_give_a_file():
    found = Assignment(np.array(["A"] * 4), np.array([0.94, 0.95, 1.0, 0.5]), np.array([0.9, 0.1, 0.09, 0.0]))
    assert list(found.given) == [False, True, False, False]


def test_features_are_finite_whatever_a_file_lacks():
    rows = pd.DataFrame(
        {"file": ["a", "b"], "version": ["5.2", "PAC2002"], "PCY1": [1.3, np.nan], "FZMIN": [100.0, np.nan]}
    ).assign(FZMAX=0.0)
    values, names = supplier_features(rows)
    assert values.shape == (2, len(names))
    assert np.isfinite(values).all()
    assert list(values[:, names.index("PCY1 = 0")]) == [0.0, 1.0]
    assert list(values[:, names.index("version PAC2002")]) == [0.0, 1.0]
    assert list(values[:, names.index("FZMIN/FZMAX not stated")]) == [1.0, 1.0]


def test_too_little_to_learn_from_is_said():
    features = np.random.default_rng(0).normal(size=(8, 3))
    with pytest.raises(DomainError, match="category B has files of one tire only"):
        OpenSetClassifier().fit(features, np.array(list("AAAABBBB")), np.array(list("12341111")))
    with pytest.raises(DomainError, match="one category only"):
        OpenSetClassifier().fit(features, np.array(list("AAAAAAAA")), np.array(list("12341234")))
