"""Recordings -> reports, pages, corrected models."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.pipelines.explain_mismatch.nodes import explain_all


def create_pipeline(**_: object) -> Pipeline:
    """Explain where recordings and their models differ."""
    return Pipeline(
        [
            Node(
                explain_all,
                inputs="recordings",
                outputs=["mismatch_reports", "mismatch_overview", "mismatch_pages", "corrected_tir"],
                name="explain_recordings",
            )
        ]
    )
