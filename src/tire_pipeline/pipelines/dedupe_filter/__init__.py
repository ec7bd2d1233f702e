"""Pipeline ``dedupe_filter``."""

from tire_pipeline.pipelines.dedupe_filter.pipeline import create_pipeline

__all__ = ["create_pipeline"]
