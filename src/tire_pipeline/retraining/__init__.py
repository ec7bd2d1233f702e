"""Retraining when files arrive: what is new, what has drifted, whether the new model may replace the old."""

from tire_pipeline.retraining.release.compare import BALANCED, compare_models, not_worse
from tire_pipeline.retraining.release.drift import drift_of_features
from tire_pipeline.retraining.release.held_out import held_out_rows
from tire_pipeline.retraining.release.model import CategoryModel, train_model
from tire_pipeline.retraining.release.record import Judged, ModelRegistry, Release, judge, roll_back
from tire_pipeline.retraining.scan.folder_difference import (
    FolderDifference,
    Look,
    difference,
    look_at,
    settled_difference,
)
from tire_pipeline.retraining.scan.manifest import Manifest, ManifestEntry
from tire_pipeline.retraining.stored_table.in_steps import Store, ingest, ingest_in_steps

__all__ = [
    "BALANCED",
    "CategoryModel",
    "FolderDifference",
    "Judged",
    "Look",
    "Manifest",
    "ManifestEntry",
    "ModelRegistry",
    "Release",
    "Store",
    "compare_models",
    "difference",
    "drift_of_features",
    "held_out_rows",
    "ingest",
    "ingest_in_steps",
    "judge",
    "look_at",
    "not_worse",
    "roll_back",
    "settled_difference",
    "train_model",
]
