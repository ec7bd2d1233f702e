"""The model before the present one, back in use."""

import datetime

from kedro.pipeline import Node, Pipeline

from tire_pipeline.reporting.retraining_page import build_rollback_report
from tire_pipeline.retraining import ModelRegistry, roll_back


def restore_previous(registry: ModelRegistry) -> ModelRegistry:
    """Put the newest earlier model back whose file is intact."""
    now = datetime.datetime.now(datetime.UTC).isoformat(timespec="milliseconds")
    return ModelRegistry(roll_back(registry.release, time=now, unusable=registry.unusable))


def create_pipeline(**_: object) -> Pipeline:
    """Take the last release back."""
    return Pipeline(
        [
            Node(
                restore_previous,
                inputs="released_record",
                outputs="released_model_updated",
                name="restore_previous",
            ),
            Node(
                build_rollback_report,
                inputs="released_model_updated",
                outputs="retraining_report",
                name="build_rollback_report",
            ),
        ]
    )
