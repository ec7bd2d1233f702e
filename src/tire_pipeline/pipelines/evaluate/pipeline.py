"""Evaluation tires -> translated by every translator -> the best one's .tir files; judged -> report."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.evaluation.all_translators import choose_sources, translate_files
from tire_pipeline.evaluation.best_translator import choose_best, write_best
from tire_pipeline.evaluation.compare_with_target import judge
from tire_pipeline.reporting.evaluation.evaluation_outcome import say_outcome
from tire_pipeline.reporting.evaluation.evaluation_page import build_report, force_figure

STATES = ["agent", "our_agent", "translator"]


def create_pipeline(**_: object) -> Pipeline:
    """Translate, choose, write, judge, report; only ``judge`` reads the truth of the judged tires."""
    return Pipeline([*_translating(), *_choosing(), *_judging()])


def _translating() -> list[Node]:
    return [
        Node(
            choose_sources,
            inputs=["evaluation_sources", "tir_files", "splits", "params:evaluate", "params:target_category"],
            outputs="chosen_sources",
            name="choose_sources",
        ),
        Node(
            translate_files,
            inputs=[
                "chosen_sources",
                "evaluation_sources",
                "tir_files",
                *STATES,
                "params:normalize",
            ],
            outputs="translated_table",
            name="translate_files",
        ),
    ]


def _choosing() -> list[Node]:
    return [
        Node(
            choose_best,
            inputs=[
                "evaluation_sources",
                "tuning_truth",
                *STATES,
                "params:evaluate",
                "params:normalize",
                "params:target_category",
            ],
            outputs="best_translator",
            name="choose_best",
        ),
        Node(
            write_best,
            inputs=[
                "translated_table",
                "best_translator",
                "chosen_sources",
                "evaluation_sources",
                "tir_files",
                "params:target_category",
            ],
            outputs="translated_tir",
            name="write_best",
        ),
    ]


def _judging() -> list[Node]:
    return [
        Node(
            judge,
            inputs=["translated_table", "evaluation_truth", "params:normalize", "params:target_category"],
            outputs=["evaluation_table", "evaluation_summary", "references"],
            name="judge",
        ),
        Node(
            say_outcome,
            inputs=["translated_table", "evaluation_summary", "best_translator", "params:target_category"],
            outputs="evaluation_outcome",
            name="say_outcome",
        ),
        Node(
            force_figure,
            inputs=["translated_table", "references", "best_translator"],
            outputs="force_figure",
            name="draw_force_curves",
        ),
        Node(
            build_report,
            inputs=[
                "evaluation_outcome",
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
                "best_translator",
                "params:target_category",
            ],
            outputs="evaluation_report",
            name="build_report",
        ),
    ]
