import importlib.util
from pathlib import Path

import numpy as np
import pytest
from small_fleet import table_of

from tire_pipeline.classifiers.methods.random_forest import RandomForest
from tire_pipeline.fleet import FleetSettings, make_fleet
from tire_pipeline.representations import make_representation
from tire_pipeline.representations.coefficients import LATERAL_WITHOUT_CAMBER
from tire_pipeline.tire_table import dedupe_and_filter, normalize_table
from tire_pipeline.tire_table.binning import Binning
from tire_pipeline.translation.population.fit_model import prepare
from tire_pipeline.translation.population.fit_space import fit_curve_space
from tire_pipeline.translation.translator import MixedModel


def _synthetic_table():
    path = Path(__file__).parents[1] / "representations" / "synthetic_tires.py"
    spec = importlib.util.spec_from_file_location("synthetic_tires_for_translation", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.synthetic_table


@pytest.fixture(scope="session")
def table():
    return _synthetic_table()(300, "ABC", seed=1)


@pytest.fixture(scope="session")
def binned(table):
    features = make_representation("coefficients").encode(table)
    return Binning.fit(features, 10).transform(features)


@pytest.fixture(scope="session")
def forest(table, binned):
    labels = table["category"].to_numpy().astype(str)
    trained = RandomForest().fit(binned, labels, seed=0)
    assert list(trained.classes_) == ["A", "B", "C"]
    return trained.forest


@pytest.fixture
def rng():
    return np.random.default_rng(0)


@pytest.fixture(scope="session")
def fleet():
    return make_fleet(FleetSettings(seed=77, files=450, tuning_tires=1, hidden_tires=6))


@pytest.fixture(scope="session")
def training(fleet):
    kept, _ = dedupe_and_filter(table_of(fleet.files), features=LATERAL_WITHOUT_CAMBER)
    return normalize_table(kept, 6000.0)


@pytest.fixture(scope="session")
def hidden(fleet):
    own = {k: v for k, v in fleet.evaluation.items() if k.startswith("hidden")}
    return normalize_table(table_of(own), 6000.0)


@pytest.fixture(scope="session")
def truth(fleet, hidden):
    own = {k: v for k, v in fleet.truth.first.items() if k.startswith("hidden/D")}
    table = normalize_table(table_of(own), 6000.0)
    names = hidden["file"].str.split("/").str[-1]
    return table.set_index(table["file"].str.split("/").str[-1]).loc[names].reset_index(drop=True)


@pytest.fixture(scope="session")
def space(training):
    return fit_curve_space(training)


@pytest.fixture(scope="session")
def made(training, space):
    """What all translators without pairs begin with."""
    return prepare(training, pairs=False, space_and_cells=space)


@pytest.fixture(scope="session")
def mixed(training, made):
    return MixedModel(pairs=False).fit(training, target="D", seed=0, made=made)


@pytest.fixture(scope="session")
def made_of_pairs(training, space):
    """What all translators with pairs begin with."""
    return prepare(training, pairs=True, space_and_cells=space)


@pytest.fixture(scope="session")
def paired(training, made_of_pairs):
    return MixedModel(pairs=True).fit(training, target="D", seed=0, made=made_of_pairs)
