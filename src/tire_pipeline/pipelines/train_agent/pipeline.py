"""Bins and forest -> the thesis' agent; tires -> our agent; tires -> the translator."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.pipelines.train_agent.nodes import train_one_agent, train_our_agent
from tire_pipeline.pipelines.translate.fit import fit_node


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
                outputs=["agent", "learning_curve", "learning_figure"],
                name="train_one_agent",
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
