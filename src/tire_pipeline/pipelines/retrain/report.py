"""The page of the last retraining."""

from __future__ import annotations

from typing import Any

import pandas as pd

from tire_pipeline.reporting import HOME, Table, Text, render_page
from tire_pipeline.retraining import Shelf
from tire_pipeline.retraining.drift import DRIFT
from tire_pipeline.retraining.release import history_rows


def build_retraining_report(
    files: pd.DataFrame,
    drift: pd.DataFrame,
    comparison: pd.DataFrame,
    outcome: dict[str, Any],
    shelf: Shelf,
) -> str:
    """One page: what came, what drifted, how the candidate did, what was decided."""
    counts = files.groupby("status").size().to_dict()
    came = ", ".join(f"{count} {status}" for status, count in counts.items()) or "no change"
    model = shelf.release.current or "none"
    moved = drift[drift["verdict"] == DRIFT]
    seen = f"{len(moved)} of {len(drift)} comparisons show drift."
    if drift.empty:
        seen = "Nothing to compare: no incoming files, or none before them."
    history = pd.DataFrame(history_rows(shelf.release))
    return render_page(
        "Retraining",
        [
            Text(
                [
                    f"Candidate {outcome['event']}: {outcome['reason']}.",
                    f"Model in use: {model}. Files since the last run: {came}.",
                ],
                emphasis=True,
            ),
            Table(
                comparison,
                heading="Candidate and released model on the same held-out tires",
                caption="Share of files whose category is recognized. Decided by the mean over categories; "
                "no held-out tire was in the training of either model.",
            ),
            Text(
                [
                    f"{seen} psi: population stability index; ks: Kolmogorov-Smirnov distance; p is adjusted "
                    "for the number of comparisons. Features are Magic Formula coefficients at one nominal "
                    "load unless another representation was chosen."
                ],
                heading="Drift of incoming files, per category",
            ),
            *([] if drift.empty else [Table(moved if len(moved) else drift.head(20))]),
            Table(
                files[files["status"] != "read"],
                heading="Files that wait, cannot be read or are gone",
                caption="A file that cannot be read is tried again when its content changes.",
            ),
            Table(history, heading="History"),
        ],
        pages=HOME,
    )
