"""Recordings -> reports, pages, corrected models."""

from kedro.pipeline import Node, Pipeline

from tire_pipeline.reporting.mismatch.explained_recordings import (
    collect_explained,
    explain_each,
    refuse_none_explained,
)
from tire_pipeline.reporting.mismatch.mismatch_overview import draw_overview, rows_to_keep


def create_pipeline(**_: object) -> Pipeline:
    """Explain where recordings and their models differ."""
    return Pipeline(
        [
            Node(
                explain_each,
                inputs=["recordings", "params:explain_mismatch"],
                outputs="mismatch_explained",
                name="explain_recordings",
            ),
            Node(
                collect_explained,
                inputs="mismatch_explained",
                outputs=["mismatch_reports", "mismatch_overview", "mismatch_pages", "corrected_tir"],
                name="collect_reports",
            ),
            Node(
                rows_to_keep,
                inputs="mismatch_overview",
                outputs="mismatch_rows",
                name="note_reports",
            ),
            Node(
                draw_overview,
                inputs=["mismatch_overview", "mismatch_pages", "mismatch_rows"],
                outputs=["mismatch_overview_page", "mismatch_outcome"],
                name="draw_overview",
            ),
            Node(
                refuse_none_explained,
                inputs=["mismatch_overview", "mismatch_outcome"],
                outputs=None,
                name="check_any_explained",
            ),
        ]
    )
