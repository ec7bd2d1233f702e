"""The pipelines by the names that users type."""

from __future__ import annotations

from kedro.framework.project import find_pipelines
from kedro.pipeline import Pipeline

DEFAULT = (
    "ingest_tir",
    "dedupe_filter",
    "normalize",
    "represent",
    "bin",
    "train_classifier",
    "train_agent",
    "evaluate",
)


def register_pipelines() -> dict[str, Pipeline]:
    """All pipelines by name; ``__default__`` is the eight from reading to evaluation."""
    pipelines = find_pipelines(raise_errors=True)
    pipelines["__default__"] = sum((pipelines[name] for name in DEFAULT if name in pipelines), Pipeline([]))
    return pipelines
