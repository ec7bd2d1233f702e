"""The page of the last retraining."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from tire_pipeline.reporting import HOME, Part, Table, Text, render_page
from tire_pipeline.retraining import ModelRegistry
from tire_pipeline.retraining.drift import DRIFT
from tire_pipeline.retraining.release import history_rows

_HAPPENED = {
    "released": "The new model (candidate) was released",
    "refused": "The new model (candidate) was not released",
    "unchanged": "Nothing changed",
    "rolled back": "An earlier model was put back",
}


def build_retraining_report(
    files: pd.DataFrame,
    drift: pd.DataFrame,
    comparison: pd.DataFrame,
    outcome: dict[str, Any],
    registry: ModelRegistry,
) -> str:
    """One page: what came, what drifted, how the candidate did, what was decided."""
    return render_page(
        "Retraining",
        [
            _decision(files, outcome, registry),
            Table(
                comparison,
                heading="Candidate and released model on the same held-out tires",
                caption="Share of files whose category is recognised. Decided by the mean over categories; "
                "no held-out tire was in the training of either model.",
            ),
            *_drift(drift),
            Table(
                files[files["status"] != "read"],
                heading="Files that wait, cannot be read or are gone",
                caption="A file that cannot be read is tried again when its content changes.",
            ),
            Table(_to_the_minute(history_rows(registry.release)), heading="History"),
        ],
        pages=HOME,
    )


def _to_the_minute(history: Sequence[Mapping[str, Any]]) -> pd.DataFrame:
    """The last events with times that a person reads."""
    table = pd.DataFrame(history)
    if "time" in table:
        table["time"] = table["time"].str[:16].str.replace("T", " ") + " UTC"
    return table


def _decision(files: pd.DataFrame, outcome: dict[str, Any], registry: ModelRegistry) -> Text:
    counts = files.groupby("status").size().to_dict()
    came = ", ".join(f"{count} {status}" for status, count in counts.items()) or "no change"
    return Text(
        [
            f"{_HAPPENED.get(outcome['event'], outcome['event'])}: {outcome['reason']}.",
            f"Model in use: {registry.release.current or 'none'}. Files since the last run: {came}.",
        ],
        emphasis=True,
    )


def _drift(drift: pd.DataFrame) -> list[Part]:
    moved = drift[drift["verdict"] == DRIFT]
    heading = "Drift of incoming files, per category"
    if drift.empty:
        return [Text(["Nothing to compare: no incoming files, or none before them."], heading=heading)]
    seen = f"{len(moved)} of {len(drift)} comparisons show drift."
    said = Text(
        [
            f"{seen} psi: population stability index; ks: Kolmogorov-Smirnov distance; p is adjusted "
            "for the number of comparisons. Features are Magic Formula coefficients at one nominal "
            "load unless another representation was chosen."
        ],
        heading=heading,
    )
    return [said, Table(moved if len(moved) else drift.head(20))]
