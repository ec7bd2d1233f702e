"""Pipeline ``translate``."""

from tire_pipeline.pipelines.translate.pipeline import create_pipeline

__all__ = ["create_pipeline"]
