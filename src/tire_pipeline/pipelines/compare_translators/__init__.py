"""Pipeline ``compare_translators``."""

from tire_pipeline.pipelines.compare_translators.pipeline import create_pipeline

__all__ = ["create_pipeline"]
