"""New files -> table -> candidate -> comparison -> release."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.cluster import given_map
from tire_pipeline.pipelines.dedupe_filter import create_pipeline as dedupe_filter
from tire_pipeline.pipelines.normalize import create_pipeline as normalize
from tire_pipeline.reporting.retraining_page import build_retraining_report
from tire_pipeline.retraining.train_and_release import (
    compare,
    decide,
    hold_out,
    measure_drift,
    read_new_files,
    report_on_files,
    stored_table,
    train_candidate,
)

_SHAPING_PARAMETERS = [
    "params:normalize",
    "params:represent",
    "params:bin",
    "params:train_classifier",
    "params:seed",
]


def create_pipeline(**_: object) -> Pipeline:
    """Retrain on what has arrived; the steps from table to table are those of the other pipelines."""
    reading = [
        Node(
            given_map(read_new_files),
            inputs=["ingested", "tir_folder", "params:retrain"],
            outputs=["ingested_updated", "files_taken_up"],
            name="read_new_files",
        ),
        Node(report_on_files, inputs="files_taken_up", outputs="retraining_files", name="report_on_files"),
        Node(stored_table, inputs="ingested_updated", outputs="ingested_table", name="stored_table"),
    ]
    cleaning = Pipeline(
        [dedupe_filter(), normalize()],
        inputs={"tire_table_raw": "ingested_table"},
        outputs={
            "tire_table": "retraining_table",
            "filter_report": "retraining_filter_report",
            "normalized_table": "retraining_normalized_table",
        },
        prefix_datasets_with_namespace=False,
    )
    return Pipeline([*reading, cleaning, *_training(), *_judging(), *_releasing()])


def _training() -> list[Node]:
    return [
        Node(
            hold_out,
            inputs=["retraining_normalized_table", "retraining_table", "params:retrain"],
            outputs=["training_tires", "held_out_tires"],
            name="hold_out",
        ),
        Node(
            train_candidate,
            inputs=["training_tires", *_SHAPING_PARAMETERS],
            outputs="candidate_model",
            name="train_candidate",
        ),
    ]


def _judging() -> list[Node]:
    return [
        Node(
            compare,
            inputs=["candidate_model", "released_model", "held_out_tires", "params:retrain"],
            outputs="retraining_comparison",
            name="compare",
        ),
        Node(
            measure_drift,
            inputs=["candidate_model", "retraining_normalized_table", "ingested_updated", "released_model"],
            outputs="retraining_drift",
            name="measure_drift",
        ),
    ]


def _releasing() -> list[Node]:
    return [
        Node(
            decide,
            inputs=[
                "candidate_model",
                "released_model",
                "retraining_comparison",
                "ingested_updated",
                "params:retrain",
                *_SHAPING_PARAMETERS,
                "params:dedupe_filter",
            ],
            outputs=["released_model_updated", "retraining_outcome"],
            name="decide",
        ),
        Node(
            build_retraining_report,
            inputs=[
                "retraining_files",
                "retraining_drift",
                "retraining_comparison",
                "retraining_outcome",
                "released_model_updated",
            ],
            outputs="retraining_report",
            name="build_retraining_report",
        ),
    ]
