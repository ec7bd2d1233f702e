"""Bins and forest -> the thesis' agent; tires -> our agent; tires -> the translator."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.pipelines.translate.pipeline import fit_node
from tire_pipeline.reporting.training_figures import learning_figure
from tire_pipeline.translation.trained_agents import train_one_agent, train_our_agent


def create_pipeline(**_: object) -> Pipeline:
    """Train both agents, and fit the translator that they are compared with."""
    return Pipeline(
        [
            Node(
                train_one_agent,
                inputs=[
                    "normalized_table",
                    "representation",
                    "binning",
                    "classifier",
                    "params:train_agent",
                    "params:target_category",
                    "params:seed",
                ],
                outputs=["agent", "learning_curve"],
                name="train_one_agent",
            ),
            Node(
                learning_figure,
                inputs="learning_curve",
                outputs="learning_figure",
                name="draw_learning_curve",
            ),
            Node(
                train_our_agent,
                inputs=[
                    "normalized_table",
                    "params:train_agent",
                    "params:normalize",
                    "params:target_category",
                    "params:seed",
                ],
                outputs="our_agent",
                name="train_our_agent",
            ),
            fit_node(),
        ]
    )
