"""The model before the present one, back in use."""

import datetime

from kedro.pipeline import Node, Pipeline

from tire_pipeline.retraining import ModelRegistry, roll_back


def restore_previous(registry: ModelRegistry) -> ModelRegistry:
    """Put the newest earlier model back whose file is intact."""
    now = datetime.datetime.now(datetime.UTC).isoformat(timespec="milliseconds")
    release = roll_back(registry.release, time=now, unusable=registry.unusable)
    print(f"model in use: {release.current} ({registry.release.current} taken back)")
    return ModelRegistry(release)


def create_pipeline(**_: object) -> Pipeline:
    """Take the last release back."""
    return Pipeline(
        [
            Node(
                restore_previous,
                inputs="released_record",
                outputs="released_model_updated",
                name="restore_previous",
            )
        ]
    )
