"""Evaluation tires -> translated .tir files -> judged -> report."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.pipelines.evaluate.judge import judge
from tire_pipeline.pipelines.evaluate.report import build_report, force_figure
from tire_pipeline.pipelines.evaluate.translate import choose_sources, translate_files


def create_pipeline(**_: object) -> Pipeline:
    """Translate, judge, report; only ``judge`` reads the truth."""
    return Pipeline(
        [
            Node(
                choose_sources,
                inputs=[
                    "evaluation_sources",
                    "tir_files",
                    "splits",
                    "params:evaluate",
                    "params:target_category",
                ],
                outputs="chosen_sources",
                name="choose_sources",
            ),
            Node(
                translate_files,
                inputs=[
                    "chosen_sources",
                    "evaluation_sources",
                    "tir_files",
                    "agent",
                    "params:normalize",
                    "params:target_category",
                ],
                outputs=["translated_table", "translated_tir"],
                name="translate_files",
            ),
            Node(
                judge,
                inputs=[
                    "translated_table",
                    "evaluation_truth",
                    "params:normalize",
                    "params:target_category",
                ],
                outputs=["evaluation_table", "evaluation_summary", "references"],
                name="judge",
            ),
            Node(
                force_figure,
                inputs=["translated_table", "references"],
                outputs="force_figure",
                name="draw_force_curves",
            ),
            Node(
                build_report,
                inputs=[
                    "ingest_summary",
                    "filter_report",
                    "tire_table",
                    "classifier_scores",
                    "classifier_per_class",
                    "confusion_table",
                    "learning_curve",
                    "evaluation_summary",
                    "translated_table",
                    "references",
                    "params:target_category",
                ],
                outputs="evaluation_report",
                name="build_report",
            ),
        ]
    )
