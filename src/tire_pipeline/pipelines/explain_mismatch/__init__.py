"""Pipeline ``explain_mismatch``."""

from tire_pipeline.pipelines.explain_mismatch.pipeline import create_pipeline

__all__ = ["create_pipeline"]
