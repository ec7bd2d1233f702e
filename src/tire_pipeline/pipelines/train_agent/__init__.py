"""Pipeline ``train_agent``."""

from tire_pipeline.pipelines.train_agent.pipeline import create_pipeline

__all__ = ["create_pipeline"]
