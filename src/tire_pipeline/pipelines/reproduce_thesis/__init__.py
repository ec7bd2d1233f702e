"""Pipeline ``reproduce_thesis``."""

from tire_pipeline.pipelines.reproduce_thesis.pipeline import create_pipeline

__all__ = ["create_pipeline"]
