"""Pipeline ``ingest_tir``."""

from tire_pipeline.pipelines.ingest_tir.pipeline import create_pipeline

__all__ = ["create_pipeline"]
