"""The pipelines by the names that users type, and how kedro-viz groups them."""

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

#: Group in kedro-viz of each pipeline. The first screen shows the groups only, and reads as the story:
#: files -> features -> classifier -> agent -> evaluation; recordings -> mismatch -> proof.
GROUPS = {
    "make_fleet": "files",
    "ingest_tir": "files",
    "dedupe_filter": "files",
    "normalize": "files",
    "represent": "features",
    "bin": "features",
    "train_classifier": "classifier",
    "train_agent": "agent",
    "translate": "translation",
    "evaluate": "evaluation",
    "reproduce_thesis": "evaluation",
    "read_recordings": "recordings",
    "explain_mismatch": "mismatch",
    "prove_concealed": "proof",
    "retrain": "retraining",
    "rollback": "retraining",
}


def register_pipelines() -> dict[str, Pipeline]:
    """All pipelines by name; ``__default__`` is the eight from reading to evaluation."""
    pipelines = {name: grouped(name, pipe) for name, pipe in find_pipelines(raise_errors=True).items()}
    pipelines["__default__"] = sum((pipelines[name] for name in DEFAULT if name in pipelines), Pipeline([]))
    return pipelines


def grouped(name: str, pipe: Pipeline) -> Pipeline:
    """The same nodes under their group's name; datasets and parameters keep theirs.

    A pipeline that groups its nodes itself (``recordings`` and ``mismatch`` in one, say) stays as it is.
    """
    group = GROUPS.get(name)
    if group is None or not pipe.nodes or any(node.namespace for node in pipe.nodes):
        return pipe
    return Pipeline(pipe, namespace=group, prefix_datasets_with_namespace=False)
