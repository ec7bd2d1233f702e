"""Table -> features."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.representations.encoded_tires import encode_tires


def create_pipeline(**_: object) -> Pipeline:
    """Encode every tire as features."""
    return Pipeline(
        [
            Node(
                encode_tires,
                inputs=["normalized_table", "params:represent", "params:seed"],
                outputs=["features", "representation"],
                name="encode_tires",
            )
        ]
    )
