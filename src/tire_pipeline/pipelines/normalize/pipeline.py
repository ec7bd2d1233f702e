"""Table -> table at one nominal load."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.tire_table.one_nominal_load import to_one_nominal_load


def create_pipeline(**_: object) -> Pipeline:
    """Rewrite all coefficients for one nominal load."""
    return Pipeline(
        [
            Node(
                to_one_nominal_load,
                inputs=["tire_table", "params:normalize"],
                outputs="normalized_table",
                name="to_one_nominal_load",
            )
        ]
    )
