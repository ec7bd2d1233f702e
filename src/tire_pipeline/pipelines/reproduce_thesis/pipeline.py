"""The thesis in full: experiments on classifiers, the grid of agents, one page."""

import warnings

from kedro.pipeline import Node, Pipeline

from tire_pipeline.pipelines.reproduce_thesis.chosen_grid import chosen_grid
from tire_pipeline.thesis.collected import EXPERIMENTS, build_page, collect, write_tables
from tire_pipeline.thesis.experiments import experiment_files as run
from tire_pipeline.thesis.experiments.agent_files import (
    fitter,
    judge_floor,
    judge_of,
    read_sources,
    trainer,
)
from tire_pipeline.translation.thesis.grid import Cell

PARAMETERS = "params:reproduce_thesis"
_SEALED = ["thesis_sources", "evaluation_truth", "params:normalize", "params:target_category"]


def create_pipeline(**_: object) -> Pipeline:
    """Build one namespace a cell of the run's grid; ``kedro run`` goes on where it stopped."""
    grid = chosen_grid()
    with warnings.catch_warnings():
        # the dots are those of the namespaces; Kedro says so even of names that it made itself
        warnings.filterwarnings("ignore", message="One or more dataset names contain")
        parts = [_experiments(), _shared(), _fitting(grid.all_representations), *map(_cell, grid.cells)]
        return Pipeline([*parts, _results(grid.cells)])


def _cell(cell: Cell) -> Pipeline:
    """The agents of one cell, one a seed."""
    nodes = [
        Node(
            trainer(cell),
            inputs=[
                "normalized_table",
                "splits",
                "fitted",
                PARAMETERS,
                "params:target_category",
            ],
            outputs="trained",
            name="train_agents",
        ),
        Node(judge_of(cell), inputs=["trained", *_SEALED], outputs="scores", name="judge"),
    ]
    shared = {name: name for name in ("normalized_table", "splits", "thesis_sources", "evaluation_truth")}
    shared["fitted"] = f"representations.{cell.representation}"
    return Pipeline(nodes, namespace=f"agents.{cell.name}", inputs=shared, parameters=_parameters(nodes))


def _fitting(names: tuple[str, ...]) -> Pipeline:
    """Every representation is fitted once a seed, for all its cells."""
    nodes = [
        Node(
            fitter(name),
            inputs=["normalized_table", "splits", PARAMETERS],
            outputs=name,
            name=f"fit_{name}",
        )
        for name in names
    ]
    return Pipeline(
        nodes,
        namespace="representations",
        inputs={"normalized_table", "splits"},
        parameters=_parameters(nodes),
    )


def _parameters(nodes: list[Node]) -> set[str]:
    """The parameters of nodes: all namespaces share them."""
    return {name for node in nodes for name in node.inputs if name.startswith("params:")}


def _shared() -> Pipeline:
    nodes = [
        Node(
            read_sources,
            inputs=["evaluation_sources", PARAMETERS, "params:normalize", "params:target_category"],
            outputs="thesis_sources",
            name="read_sources",
        ),
        Node(judge_floor, inputs=_SEALED, outputs="thesis_floor", name="judge"),
    ]
    return Pipeline(nodes, namespace="floor", prefix_datasets_with_namespace=False)


def _experiments() -> Pipeline:
    table, seeded = ["normalized_table"], [PARAMETERS, "params:seed"]
    both = [*table, "splits", *seeded]
    nodes = [
        Node(run.count_classes, inputs=both, outputs="class_counts", name="count_classes"),
        Node(run.search_at_random, inputs=[*table, *seeded], outputs="ann_random", name="search_at_random"),
        Node(
            run.search_the_grid,
            inputs=["ann_random", *table, *seeded],
            outputs="ann_grid",
            name="search_the_grid",
        ),
        Node(run.tune_forest, inputs=[*table, *seeded], outputs="forest", name="tune_forest"),
        Node(run.compare_classifiers, inputs=both, outputs="classifiers", name="compare_classifiers"),
        Node(run.measure_bins, inputs=both, outputs="bins", name="measure_bins"),
        Node(run.measure_latent_features, inputs=both, outputs="latent", name="measure_latent_features"),
        Node(run.measure_condition, inputs=table, outputs="condition", name="measure_condition"),
    ]
    return Pipeline(
        nodes,
        namespace="experiments",
        inputs={"normalized_table", "splits"},
        parameters=_parameters(nodes),
    )


def _results(cells: tuple[Cell, ...]) -> Pipeline:
    folders = {name: f"experiments.{name}" for name in EXPERIMENTS}
    folders |= {f"scores_of_{cell.name}": f"agents.{cell.name}.scores" for cell in cells}
    nodes = [
        Node(
            collect,
            inputs=["thesis_floor", "splits", PARAMETERS, "params:target_category", *folders],
            outputs="thesis_results",
            name="collect",
        ),
        Node(write_tables, inputs="thesis_results", outputs="thesis_tables", name="write_tables"),
        Node(build_page, inputs="thesis_results", outputs="thesis_page", name="build_page"),
    ]
    return Pipeline(nodes, namespace="reporting", inputs=folders, prefix_datasets_with_namespace=False)
