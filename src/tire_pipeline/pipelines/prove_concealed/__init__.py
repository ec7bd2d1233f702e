"""Pipeline ``prove_concealed``."""

from tire_pipeline.pipelines.prove_concealed.pipeline import create_pipeline

__all__ = ["create_pipeline"]
