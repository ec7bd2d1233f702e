"""The pipelines by the names that users type, and how kedro-viz groups them."""

from __future__ import annotations

from kedro.framework.project import find_pipelines
from kedro.pipeline import Node, Pipeline

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

#: What kedro-viz opens on, beside the eight: the user's files translated; recordings -> mismatch -> proof.
STORY = ("translate", "explain_mismatch", "prove_concealed")

#: Group in kedro-viz of each pipeline. The first screen shows the groups only, and reads as the story:
#: files -> features -> classifier -> translators -> evaluation, translation; recordings -> mismatch -> proof.
PIPELINE_GROUPS = {
    "make_fleet": "files",
    "ingest_tir": "files",
    "dedupe_filter": "files",
    "normalize": "files",
    "represent": "features",
    "bin": "features",
    "train_classifier": "classifier",
    "train_agent": "translators",
    "translate": "translation",
    "compare_translators": "translation",
    "evaluate": "evaluation",
    "reproduce_thesis": "evaluation",
    "explain_mismatch": "mismatch",
    "prove_concealed": "proof",
    "calibrate_mismatch": "proof",
    "retrain": "retraining",
    "rollback": "retraining",
}


#: Nodes that belong to another group than the rest of their pipeline.
GROUPS_OF_NODES = {
    "fit_translator": "translators",
    "make_cases": "recordings",
    "part_cases": "recordings",
    "explain_cases": "mismatch",
    "explain_by_baselines": "mismatch",
    "make_real_cases": "recordings",
    "part_real_cases": "recordings",
    "explain_real_cases": "mismatch",
    "explain_real_by_baselines": "mismatch",
}


def register_pipelines() -> dict[str, Pipeline]:
    """All pipelines by name; ``__default__`` is the eight, ``story`` what kedro-viz opens on."""
    pipelines = {name: grouped(name, pipe) for name, pipe in find_pipelines(raise_errors=True).items()}
    pipelines["__default__"] = sum((pipelines[name] for name in DEFAULT if name in pipelines), Pipeline([]))
    story = [pipelines[name] for name in STORY if name in pipelines]
    pipelines["story"] = sum(story, pipelines["__default__"])
    return pipelines


def grouped(name: str, pipe: Pipeline) -> Pipeline:
    """The same nodes under their group's name; datasets and parameters keep theirs.

    A pipeline that groups its nodes itself stays as it is.
    """
    if name not in PIPELINE_GROUPS or any(node.namespace for node in pipe.nodes):
        return pipe
    parts: dict[str, list[Node]] = {}
    for node in pipe.nodes:
        parts.setdefault(GROUPS_OF_NODES.get(node.name, PIPELINE_GROUPS[name]), []).append(node)
    return sum(
        (
            Pipeline(nodes, namespace=group, prefix_datasets_with_namespace=False)
            for group, nodes in parts.items()
        ),
        Pipeline([]),
    )
