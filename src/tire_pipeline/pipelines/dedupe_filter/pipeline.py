"""Table -> table without duplicates, gaps and small categories."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.representations.usable_tires import keep_usable


def create_pipeline(**_: object) -> Pipeline:
    """Drop identical files, files without values and small categories."""
    return Pipeline(
        [
            Node(
                keep_usable,
                inputs=[
                    "tire_table_raw",
                    "params:dedupe_filter",
                    "params:represent",
                    "params:target_category",
                ],
                outputs=["tire_table", "filter_report"],
                name="keep_usable",
            )
        ]
    )
