"""Bins and forest -> the thesis' agent; tires -> our agent; tires -> the translator."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.cluster import given_map
from tire_pipeline.pipelines.translate.pipeline import fit_node
from tire_pipeline.reporting.evaluation.training_figures import learning_figure
from tire_pipeline.translation.trained_agents import train_agents


def create_pipeline(**_: object) -> Pipeline:
    """Train both agents, and fit the translator that they are compared with."""
    return Pipeline(
        [
            Node(
                given_map(train_agents),
                inputs=[
                    "normalized_table",
                    "representation",
                    "binning",
                    "classifier",
                    "params:train_agent",
                    "params:normalize",
                    "params:target_category",
                    "params:seed",
                ],
                outputs=["agent", "learning_curve", "our_agent"],
                name="train_agents",
            ),
            Node(
                learning_figure,
                inputs="learning_curve",
                outputs="learning_figure",
                name="draw_learning_curve",
            ),
            fit_node(),
        ]
    )
