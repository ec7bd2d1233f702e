"""Pipeline ``represent``."""

from tire_pipeline.pipelines.represent.pipeline import create_pipeline

__all__ = ["create_pipeline"]
