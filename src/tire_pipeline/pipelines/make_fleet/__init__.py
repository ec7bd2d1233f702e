"""Pipeline ``make_fleet``."""

from tire_pipeline.pipelines.make_fleet.pipeline import create_pipeline

__all__ = ["create_pipeline"]
