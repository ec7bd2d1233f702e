"""The page of the last retraining or rollback."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import pandas as pd

from tire_pipeline.files.rows_on_disk import REPORT_ROWS, joined
from tire_pipeline.reporting import HOME, Part, Table, Text, render_page
from tire_pipeline.reporting.page_parts import without_empty_columns
from tire_pipeline.retraining import ModelRegistry
from tire_pipeline.retraining.release.drift import DRIFT, FEWEST_FILES, NEW, PSI_LIMIT, RISK, TOO_FEW
from tire_pipeline.retraining.release.record import history_rows
from tire_pipeline.retraining.stored_table.in_steps import READ

_MOST_SHOWN = 20
_TITLE_OF_COLUMN = {
    "earlier": "earlier files",
    "incoming": "incoming files",
    "psi": "population stability index",
    "ks": "Kolmogorov-Smirnov distance",
    "p_adjusted": "adjusted p",
    "candidate": "balanced accuracy, candidate",
    "released": "balanced accuracy, released",
}
_HAPPENED = {
    "released": "The new model (candidate) was released",
    "refused": "The new model (candidate) was not released",
    "unchanged": "Nothing changed",
    "rolled back": "An earlier model was put back",
}


def build_retraining_report(
    files: Iterable[pd.DataFrame],
    drift: pd.DataFrame,
    comparison: pd.DataFrame,
    outcome: dict[str, Any],
    registry: ModelRegistry,
) -> str:
    """One page: what came, what drifted, how the candidate did, what was decided."""
    counts, unread = _counted(files)
    parts = [
        _decision(counts, outcome, registry),
        _comparison(comparison),
        *_drift(drift),
        _unread(counts, unread),
        _history(registry),
    ]
    return render_page("Retraining", parts, pages=HOME)


def build_rollback_report(registry: ModelRegistry) -> str:
    """The same page after a rollback: which model is in use now, and the history."""
    parts: list[Part] = [
        Text(list(_decided(registry.release.last_event, registry)), emphasis=True),
        Text(["What came and what drifted stands here after the next `kedro run --pipeline retrain`."]),
        _history(registry),
    ]
    return render_page("Retraining", parts, pages=HOME)


def _comparison(comparison: pd.DataFrame) -> Table:
    return Table(
        comparison,
        heading="Candidate and released model on the same held-out tires",
        caption="Accuracy: share of files whose category is predicted correctly. Balanced: its mean "
        "over the categories, which decides. No held-out tire was in the training of either model.",
        decimals=3,
    )


def _counted(files: Iterable[pd.DataFrame]) -> tuple[dict[str, int], pd.DataFrame]:
    """How many files have each status, by its name; the first of those that were not read."""
    counts, some, left = Counter[str](), list[pd.DataFrame](), REPORT_ROWS
    for frame in files:
        counts.update(frame["status"])
        some.append(frame[frame["status"] != READ].head(left))
        left -= len(some[-1])
    return dict(sorted(counts.items())), joined(some)


def _unread(counts: Mapping[str, int], unread: pd.DataFrame) -> Table:
    more = sum(counts.values()) - counts.get(READ, 0) - len(unread)
    return Table(
        without_empty_columns(_without_paths(unread).fillna(""), always=("file", "category", "status")),
        heading="Files that were not read",
        caption="Pending: it cannot be read, and is tried again when its content changes. Set aside: "
        "it is no regular file. Taken already: the same file was read under another name. Removed: "
        "it is gone from the folder."
        + (f" {more:,} more are in tables/retraining_files.csv." if more else ""),
    )


def _history(registry: ModelRegistry) -> Table:
    return Table(
        _to_the_minute(history_rows(registry.release)).rename(columns=_TITLE_OF_COLUMN),
        heading="History",
        caption="The newest first. A dash: there was no released model to compare with.",
        decimals=3,
    )


def _without_paths(files: pd.DataFrame) -> pd.DataFrame:
    """Reasons without the path of the file, which stands in the row."""
    reasons = [
        str(reason).rpartition(f"{file}: ")[2] if isinstance(reason, str) else reason
        for file, reason in zip(files["file"], files["reason"], strict=True)
    ]
    return files.assign(reason=reasons)


def _to_the_minute(history: Sequence[Mapping[str, Any]]) -> pd.DataFrame:
    """The last events with times that a person reads."""
    table = pd.DataFrame(history)
    if "time" in table:
        table["time"] = table["time"].str[:16].str.replace("T", " ") + " UTC"
    return table


def _decision(counts: Mapping[str, int], outcome: dict[str, Any], registry: ModelRegistry) -> Text:
    came = ", ".join(f"{count:,} {status}" for status, count in counts.items()) or "no change"
    happened, in_use = _decided(outcome, registry)
    return Text([happened, f"{in_use} Files since the last run: {came}."], emphasis=True)


def _decided(event: Mapping[str, Any], registry: ModelRegistry) -> tuple[str, str]:
    """What happened and why, and which model is in use now."""
    happened = _HAPPENED.get(event["event"], event["event"])
    return f"{happened}: {event['reason']}.", f"Model in use: {registry.release.current or 'none'}."


def _drift(drift: pd.DataFrame) -> list[Part]:
    heading = "Drift of incoming files, per category"
    if drift.empty:
        return [Text(["Nothing to compare: no incoming files, or none before them."], heading=heading)]
    tested = drift[drift["psi"].notna()]
    untold = _not_compared(drift[drift["psi"].isna()])
    if tested.empty:
        return [Text(["Nothing can be said.", *untold], heading=heading)]
    moved = tested[tested["verdict"] == DRIFT]
    said = Text(
        [
            f"{len(moved)} of {len(tested)} comparisons show drift. The values of each feature in the "
            "incoming files are compared with those in the earlier ones of the same category. Drift: p, "
            f"adjusted for the number of comparisons, is below {RISK:g}, and the population stability index "
            f"is above {PSI_LIMIT:g}. Features are Magic Formula coefficients at one nominal load unless "
            "another representation was chosen.",
            *untold,
        ],
        heading=heading,
    )
    shown = moved if len(moved) else tested.nlargest(_MOST_SHOWN, "psi")
    fewer = (
        ""
        if len(moved) or len(shown) == len(tested)
        else f"The {len(shown)} largest differences of {len(tested)}."
    )
    return [said, Table(shown.rename(columns=_TITLE_OF_COLUMN), caption=fewer)]


def _not_compared(drift: pd.DataFrame) -> list[str]:
    """Say of which categories drift cannot be told, and why."""
    first = drift.drop_duplicates("category")
    new = first[first["verdict"] == NEW]["category"]
    few = first[first["verdict"] == TOO_FEW]
    counts = [f"{row.category} ({row.incoming} beside {row.earlier:,} earlier)" for row in few.itertuples()]
    said = []
    if counts:
        said.append(f"Too few files to compare, {FEWEST_FILES} on each side are needed: {', '.join(counts)}.")
    if len(new):
        said.append(f"New, with nothing to compare: {', '.join(new)}.")
    return said
