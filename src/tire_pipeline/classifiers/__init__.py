"""Classifiers that tell who measured a tire: one small interface, one file each."""

from tire_pipeline.classifiers.base import (
    CLASSIFIERS,
    Classifier,
    classifier_from_state,
    make_classifier,
)

__all__ = ["CLASSIFIERS", "Classifier", "classifier_from_state", "make_classifier"]
