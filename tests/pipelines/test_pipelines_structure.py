"""What the registry, the catalog and the lineage graph promise."""

from __future__ import annotations

from graphlib import TopologicalSorter
from pathlib import Path

import pytest
from kedro.framework.cli.utils import find_run_command
from kedro.framework.project import pipelines
from kedro.framework.session import KedroSession
from kedro.framework.startup import bootstrap_project

from tire_pipeline.cli import cli
from tire_pipeline.datasets import ComputedFolderDataset

ROOT = Path(__file__).resolve().parents[2]
EIGHT = [
    "ingest_tir",
    "dedupe_filter",
    "normalize",
    "represent",
    "bin",
    "train_classifier",
    "train_agent",
    "evaluate",
]


@pytest.fixture(scope="module")
def catalog():
    bootstrap_project(ROOT)
    with KedroSession.create(project_path=ROOT) as session:
        return session.load_context().catalog


def _datasets(pipeline) -> set[str]:
    return {
        name
        for name in pipeline.all_inputs() | pipeline.all_outputs()
        if not name.startswith(("params:", "parameters"))
    }


def test_the_names_that_users_type_are_registered(catalog):
    assert {*EIGHT, "make_fleet", "__default__"} <= set(pipelines)


def test_python_m_tire_pipeline_does_what_kedro_run_does():
    assert find_run_command("tire_pipeline") is cli.commands["run"]


def test_the_default_is_the_eight(catalog):
    default = {node.name for node in pipelines["__default__"].nodes}
    assert default == {node.name for name in EIGHT for node in pipelines[name].nodes}


def test_every_dataset_is_in_the_catalog_with_layer_and_description(catalog):
    for name in sorted({d for p in pipelines.values() for d in _datasets(p)}):
        assert name in catalog, name
        metadata = catalog.get(name).metadata
        assert metadata["kedro-viz"]["layer"][:2].isdigit(), name
        assert len(metadata["description"]) > 15, name


def test_no_layer_comes_before_and_after_another(catalog):
    """kedro-viz draws no layers at all where two depend on each other."""

    def layers(names) -> set[str]:
        datasets = {name for name in names if not name.startswith(("params:", "parameters"))}
        return {catalog.get(name).metadata["kedro-viz"]["layer"] for name in datasets}

    for pipeline in pipelines.values():
        order: TopologicalSorter[str] = TopologicalSorter()
        for node in pipeline.nodes:
            before = layers(node.inputs)
            for after in layers(node.outputs):
                order.add(after, *(before - {after}))
        order.prepare()  # raises CycleError


def test_everything_between_the_eight_is_versioned(catalog):
    default = pipelines["__default__"]
    between = _datasets(default) - default.inputs() - default.outputs()
    assert {"agent", "our_agent", "translator"} <= between
    for name in sorted(between):
        if isinstance(catalog.get(name), ComputedFolderDataset):
            continue  # its files are named by all that they depend on
        assert catalog.get(name).resolve_save_version(), name


def test_only_the_judging_node_reads_the_truth(catalog):
    readers = {
        node.short_name
        for pipeline in pipelines.values()
        for node in pipeline.nodes
        if {"evaluation_truth", "fleet_truth_files"} & set(node.inputs)
    }
    assert readers == {"judge"}


def test_nothing_that_judging_makes_comes_back_into_what_is_judged(catalog):
    default = pipelines["__default__"]
    after = default.from_nodes("evaluation.judge")
    assert {node.short_name for node in after.nodes} == {
        "judge",
        "say_outcome",
        "draw_force_curves",
        "build_report",
    }


def test_the_tires_that_choose_a_translator_are_judged_nowhere(catalog):
    readers = {
        node.short_name
        for pipeline in pipelines.values()
        for node in pipeline.nodes
        if "tuning_truth" in node.inputs
    }
    assert readers == {"choose_best"}
    with KedroSession.create(project_path=ROOT) as session:
        config = session.load_context().config_loader
    assert config["catalog"]["tuning_truth"]["path"].endswith("truth/first/tuning")
    assert "tuning" not in config["parameters"]["evaluate"]["sets"]


def test_translate_reads_fits_translates_joins_and_draws():
    steps = [node.short_name for node in pipelines["translate"].nodes]
    first, *_, last = steps  # what was asked for is looked up before anything is fitted
    assert (first, last) == ("choose_files", "draw_translated_files")
    assert {*steps} == {first, "fit_translator", "translate_each", "join_translated", last}
    fitted = next(node for node in pipelines["translate"].nodes if node.short_name == "fit_translator")
    assert fitted.outputs == ["translator"]
    assert fitted in pipelines["__default__"].nodes


def test_the_data_may_not_hold_pickles(catalog):
    for name in sorted({d for p in pipelines.values() for d in _datasets(p)}):
        kind = f"{type(catalog.get(name)).__module__}.{type(catalog.get(name)).__name__}".lower()
        assert "pickle" not in kind, name
        assert "joblib" not in kind, name
