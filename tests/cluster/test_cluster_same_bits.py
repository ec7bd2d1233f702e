"""Concealed cases, agents of the grid and tuning: the same to the last bit with a cluster as without."""

from __future__ import annotations

import io
import json
import sys
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

import pandas as pd
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "representations"))
from synthetic_tires import synthetic_table

from tire_pipeline.concealed.proof.simulated import (
    ProveConcealedParameters,
    cases_to_make,
    explain_by_baselines,
    explain_cases,
    part_cases,
)
from tire_pipeline.files.packed import as_parquet, pack, unpack
from tire_pipeline.files.state_files import pack_state, unpack_state
from tire_pipeline.tasks import Map, all_done, in_turn
from tire_pipeline.thesis.experiments import experiment_files, files
from tire_pipeline.thesis.experiments.agent_files import fitter, trainer
from tire_pipeline.thesis.parameters import ReproduceThesisParameters
from tire_pipeline.tire_table.splits import split_table
from tire_pipeline.translation.thesis.grid import Cell

CELLS = [
    Cell("PPO", "reach_target_fast", "key_attributes", 10),
    Cell("A2C", "maximize_reward", "latent", 20),
]
SETTINGS = ReproduceThesisParameters.model_validate(
    {
        "agents": {"seeds": [1, 2], "total_steps": 640},
        "latent_epochs": 1,
        "ann": {"random": 5, "epochs": [1, 2]},
        "forest": {"trees": 2, "most_trees": 2, "most_depth": 2},
    }
)
CHANNELS = {"time", "slip_angle", "normal_load", "fy"}
Work = Mapping[str, Callable[[], bytes]]


@pytest.fixture(scope="module")
def table():
    return synthetic_table(150, "AB", seed=1)


@pytest.fixture(scope="module")
def splits(table):
    return split_table(table, seed=0)


def _done(by: Map, work: Work) -> dict[str, bytes]:
    assert len(work) >= 2  # so that both workers have something to do
    return {name: done.result() for name, done in all_done(by, work, "computing").items()}


def _stored(parts: Mapping[str, bytes]) -> Work:
    """What a folder of computed files loads."""
    return {name: partial(bytes, content) for name, content in parts.items()}


@pytest.fixture(scope="module")
def shown():
    """Two cases with concealed effects, as they are shown to who explains them."""
    made = _done(in_turn, cases_to_make(ProveConcealedParameters(cases=2, seed=10_000)))
    return part_cases(_stored(made))[0]


def test_concealed_cases_are_made_the_same(work):
    wanted = cases_to_make(ProveConcealedParameters(cases=2, seed=10_000))
    assert _done(work, wanted) == _done(in_turn, wanted)


@pytest.mark.parametrize(
    "baselines",
    [("bic_stepwise",), pytest.param(("pysindy", "gaussian_process"), marks=pytest.mark.long)],
)
def test_concealed_cases_are_explained_the_same_by_baselines(work, shown, baselines):
    wanted = explain_by_baselines(shown, ProveConcealedParameters(seed=10_000, baselines=baselines))
    assert _done(work, wanted) == _done(in_turn, wanted)


def _small(read: Callable[[], bytes]) -> bytes:
    """A case with few channels and a twentieth of its rows: a whole one takes minutes."""
    parts = unpack(read())
    for name, every in (("recording.parquet", 20), ("inputs.parquet", 1)):
        table = pd.read_parquet(io.BytesIO(parts[name])).iloc[::every].reset_index(drop=True)
        parts[name] = as_parquet(table[[each for each in table if each in CHANNELS]])
    return pack(parts)


@pytest.mark.long
def test_concealed_cases_are_explained_the_same_by_the_engine(work, shown):
    wanted = explain_cases({name: partial(_small, read) for name, read in shown.items()})
    alone = _done(in_turn, wanted)
    for each in alone.values():
        assert json.loads(unpack(each)["report.json"])["verdict"] != "refused"
    assert _done(work, wanted) == alone


def _without_seconds(parts: Mapping[str, bytes]) -> dict[str, bytes]:
    """How long a training took is stored with it, and no two take the same time."""
    return {name: pack_state({**unpack_state(part), "seconds": 0.0}) for name, part in parts.items()}


@pytest.mark.long
@pytest.mark.parametrize("cell", CELLS, ids=lambda cell: cell.name)
def test_agents_of_the_grid_are_trained_and_judged_the_same(work, table, splits, cell):
    fitting = fitter(cell.representation)(table, splits, SETTINGS)
    fitted = _done(in_turn, fitting)
    assert _done(work, fitting) == fitted
    training = trainer(cell)(table, splits, _stored(fitted), SETTINGS, "A")
    trained = _without_seconds(_done(in_turn, training))
    assert _without_seconds(_done(work, training)) == trained
    own, other = (table[table["category"] == name].head(6).assign(tire=list("uvwxyz")) for name in "AB")
    sources = pd.concat([own.assign(set="four"), other.assign(set="hidden")])
    given = (sources, pd.concat([own, own]))
    judging = {
        name: partial(files.judged, read, cell, seed, *given)
        for seed, (name, read) in enumerate(_stored(trained).items())
    }
    assert _done(work, judging) == _done(in_turn, judging)


@pytest.mark.parametrize(
    "experiment",
    [
        experiment_files.tune_forest,
        pytest.param(experiment_files.search_at_random, marks=pytest.mark.long),
    ],
)
def test_classifiers_are_tuned_the_same(work, table, experiment):
    wanted = experiment(table, SETTINGS, 0)
    assert _done(work, wanted) == _done(in_turn, wanted)
