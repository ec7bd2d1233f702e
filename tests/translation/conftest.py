import importlib.util
from pathlib import Path

import numpy as np
import pytest

from tire_pipeline.classifiers.methods.random_forest import RandomForest
from tire_pipeline.representations import make_representation
from tire_pipeline.tire_table.bins import Binning


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
