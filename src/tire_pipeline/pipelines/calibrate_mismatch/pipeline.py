"""Tuning cases -> what their sets say -> the posterior's sizes, and how they do on sources left out."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.calibration.learning import learn_sizes, reduce_cases, weigh_cases
from tire_pipeline.cluster import given_map


def create_pipeline(**_: object) -> Pipeline:
    """Learn the sizes of the posterior over sets of effects."""
    return Pipeline(
        [
            Node(
                reduce_cases,
                inputs="params:calibrate_mismatch",
                outputs="tuning_reductions",
                name="reduce_cases",
            ),
            Node(
                weigh_cases,
                inputs=["tuning_reductions", "params:calibrate_mismatch"],
                outputs="tuning_evidence",
                name="weigh_cases",
            ),
            Node(
                given_map(learn_sizes),
                inputs=["tuning_reductions", "tuning_evidence", "params:calibrate_mismatch"],
                outputs=["mismatch_sizes", "calibration_scores"],
                name="learn_sizes",
            ),
        ]
    )
