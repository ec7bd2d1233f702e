"""Pipeline ``bin``."""

from tire_pipeline.pipelines.bin.pipeline import create_pipeline

__all__ = ["create_pipeline"]
