"""Bins and forest -> agent."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.pipelines.train_agent.nodes import train_one_agent


def create_pipeline(**_: object) -> Pipeline:
    """Train the thesis' agent."""
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
            )
        ]
    )
