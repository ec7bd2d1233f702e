"""Pipeline ``normalize``."""

from tire_pipeline.pipelines.normalize.pipeline import create_pipeline

__all__ = ["create_pipeline"]
