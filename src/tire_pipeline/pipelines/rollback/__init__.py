"""Pipeline ``rollback``."""

from tire_pipeline.pipelines.rollback.pipeline import create_pipeline

__all__ = ["create_pipeline"]
