"""Pipeline ``train_classifier``."""

from tire_pipeline.pipelines.train_classifier.pipeline import create_pipeline

__all__ = ["create_pipeline"]
