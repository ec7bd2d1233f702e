"""Features -> splits and bins."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.tire_table.binned_features import bin_features, split_files


def create_pipeline(**_: object) -> Pipeline:
    """Split the files and bin the features."""
    return Pipeline(
        [
            Node(
                split_files,
                inputs=["features", "params:bin", "params:seed"],
                outputs="splits",
                name="split_files",
            ),
            Node(
                bin_features,
                inputs=["features", "splits", "params:bin"],
                outputs=["binned_features", "binned_features_by_tire", "binning"],
                name="bin_features",
            ),
        ]
    )
