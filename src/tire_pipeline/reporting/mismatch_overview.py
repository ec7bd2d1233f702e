"""All recordings on one page, and what a run says last."""

from __future__ import annotations

from pathlib import PurePosixPath

import pandas as pd

from tire_pipeline.mismatch.report.words import in_words
from tire_pipeline.reporting import HOME, Links, Table, Text, render_page
from tire_pipeline.reporting.page import without_empty_columns

_ALWAYS = ("recording", "verdict", "effects")
_KEPT = (
    "This page lists the recordings of the last run. Pages of earlier runs stay in the folder mismatch "
    "beside it until you delete them; corrected files are those of the last run."
)
_FEW = 5
"""Of so many recordings a run says what was found in each."""


def draw_overview(overview: pd.DataFrame, pages: dict[str, str]) -> tuple[str, list[str]]:
    """Sum up all recordings of a run on one page.

    Parameters
    ----------
    overview : DataFrame
        ``recording, verdict, summary, effects, alternatives, held_out, problem``.
    pages : dict of str to str
        The recordings' pages by path.

    Returns
    -------
    page : str
        HTML; it links the recordings' pages.
    outcome : list of str
        The last lines of a run.
    """
    shown = overview.astype(object).fillna("").astype(str)
    links = []
    for row in shown.to_dict("records"):
        path = str(PurePosixPath(row["recording"]).with_suffix(".html"))
        text = row["summary"] or row["problem"]
        links.append((f"mismatch/{path}" if path in pages else "", row["recording"], text))
    outcome = [_counted(shown)]
    if len(shown) <= _FEW:
        outcome += [f"{recording}: {text}" for _, recording, text in links]
    parts: list[Text | Table | Links] = [
        Text(outcome[:1], emphasis=True),
        Text([_KEPT]),
        Links(links, heading="Recordings"),
        _in_one_table(shown),
        Links([("tables/mismatch_overview.csv", "The table as a file", "with the summaries")]),
    ]
    return render_page("Recordings against their simulations", parts, pages=HOME), outcome


def _counted(shown: pd.DataFrame) -> str:
    counts = shown.loc[shown["verdict"] != "", "verdict"].value_counts()
    said = [f"{count} {verdict}" for verdict, count in counts.items()]
    failed = int((shown["verdict"] == "").sum())
    if failed:
        said.append(f"{failed} could not be used")
    recordings = "recording" if len(shown) == 1 else "recordings"
    return f"{len(shown)} {recordings}: {', '.join(said)}."


def _in_one_table(shown: pd.DataFrame) -> Table:
    table = shown[["recording", "verdict", "effects", "alternatives", "held_out", "problem"]]
    table = without_empty_columns(table, _ALWAYS)
    table = table.assign(
        **{name: table[name].map(in_words) for name in ("effects", "alternatives") if name in table}
    )
    return Table(
        table.rename(columns={"held_out": "held out"}),
        "Effects are what the model left out, by their names; alternatives cannot be told from them by "
        "these recordings.",
        heading="In one table",
        most_rows=1000,
    )
