"""The pipeline's shape: one namespace a cell, made from parameters; the truth is for judging only."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import pytest
import yaml
from kedro.pipeline import Pipeline

from tire_pipeline.kedro_runs.thesis_grid import ThesisGridHooks
from tire_pipeline.pipelines.reproduce_thesis import create_pipeline
from tire_pipeline.pipelines.reproduce_thesis.chosen_grid import chosen_grid
from tire_pipeline.thesis.parameters import GridParameters, ReproduceThesisParameters
from tire_pipeline.translation.thesis.grid import CELLS

ROOT = Path(__file__).resolve().parents[2]


def _cells(pipeline: Pipeline) -> set[str]:
    return {n.namespace.split(".")[1] for n in pipeline.nodes if n.namespace.startswith("agents.")}


@pytest.fixture
def choose():
    """What Kedro calls before a run with this grid in its parameters."""

    def made(**grid) -> Pipeline:
        context = SimpleNamespace(config_loader={"parameters": {"reproduce_thesis": {"grid": grid}}})
        ThesisGridHooks().after_context_created(context)
        return create_pipeline()

    before = chosen_grid()
    yield made
    made(**before.model_dump())


@pytest.fixture
def whole(choose) -> Pipeline:
    """The pipeline of the default grid, whichever grid a run of another test in this process chose."""
    return choose()


def test_the_configured_grid_is_the_thesis_48_and_the_stable_power_series():
    parameters = yaml.safe_load((ROOT / "conf/base/parameters/reproduce_thesis.yml").read_text())
    read = ReproduceThesisParameters.model_validate(parameters["reproduce_thesis"])
    assert read == ReproduceThesisParameters()
    names = {cell.name for cell in read.grid.cells}
    assert {cell.name for cell in CELLS} < names
    assert {name for name in names if "stable" not in name} == {cell.name for cell in CELLS}


def test_every_cell_is_a_namespace(whole):
    assert _cells(whole) == {cell.name for cell in GridParameters().cells}
    assert len(_cells(whole)) == 60


def test_the_namespaces_follow_the_parameters(choose):
    grid = GridParameters(algorithms=("A2C",), rewards=("maximize_reward",), bins=(10,))
    assert _cells(choose(**grid.model_dump())) == {cell.name for cell in grid.cells}


def test_nothing_that_follows_from_the_truth_trains_anything(whole):
    after = {node.short_name for node in whole.from_inputs("evaluation_truth").nodes}
    assert after == {"judge", "collect", "write_tables", "build_page"}


def test_a_misspelt_parameter_is_refused():
    with pytest.raises(ValueError, match="algoritms"):
        GridParameters.model_validate({"algoritms": ["PPO"]})
