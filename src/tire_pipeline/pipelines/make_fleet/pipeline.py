"""Parameters -> a fleet of .tir files with a sealed truth."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.fleet.write import build_fleet


def create_pipeline(**_: object) -> Pipeline:
    """Make the demonstration fleet."""
    return Pipeline(
        [
            Node(
                build_fleet,
                inputs=["params:make_fleet", "params:target_category", "params:seed"],
                outputs=["fleet_truth_files", "fleet_evaluation_files", "fleet_files"],
                name="build_fleet",
            )
        ]
    )
