"""Recordings -> reports, pages, corrected models."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.reporting.explained_recordings import explain_all
from tire_pipeline.reporting.mismatch_overview import draw_overview


def create_pipeline(**_: object) -> Pipeline:
    """Explain where recordings and their models differ."""
    return Pipeline(
        [
            Node(
                explain_all,
                inputs=["recordings", "params:explain_mismatch"],
                outputs=["mismatch_reports", "mismatch_overview", "mismatch_pages", "corrected_tir"],
                name="explain_recordings",
            ),
            Node(
                draw_overview,
                inputs=["mismatch_overview", "mismatch_pages"],
                outputs=["mismatch_overview_page", "mismatch_outcome"],
                name="draw_overview",
            ),
        ]
    )
