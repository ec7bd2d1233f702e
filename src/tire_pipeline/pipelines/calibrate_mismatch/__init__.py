"""Pipeline ``calibrate_mismatch``."""

from tire_pipeline.pipelines.calibrate_mismatch.pipeline import create_pipeline

__all__ = ["create_pipeline"]
