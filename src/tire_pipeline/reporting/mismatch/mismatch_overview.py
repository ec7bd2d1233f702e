"""All recordings that have a report on one page, and what a run says last."""

from __future__ import annotations

import datetime
import json
from collections.abc import Iterable, Mapping

import pandas as pd

from tire_pipeline.mismatch.report.words import in_words
from tire_pipeline.reporting import HOME, Links, Part, Table, Text, render_page
from tire_pipeline.reporting.mismatch.result_names import result_place
from tire_pipeline.reporting.page_parts import without_empty_columns

_HEADS = {
    "recording": "Recording",
    "run": "Run",
    "verdict": "Verdict",
    "effects": "Effects",
    "alternatives": "Alternatives",
    "held_out": "Held out",
    "problem": "Problem",
}
_ALWAYS_SHOWN = ("recording", "run", "verdict", "effects")
_EARLIER_REPORTS = (
    "Reports of earlier runs stay in the folder mismatch beside this page until you delete them, and so do "
    "the corrected files that belong to them."
)
_NO_ROW = "Open it to see what was found."
_ALTERNATIVES = " Alternatives: what the recording cannot distinguish from them."
_FEW_RECORDINGS = 5
"""Up to this many recordings, a run says what was found in each."""
_CSV = ("tables/mismatch_overview.csv", "Table of the last run (CSV)", "with every recording's summary")


def rows_to_keep(overview: pd.DataFrame) -> dict[str, str]:
    """Note what each report of a run says, for the overview of later runs.

    Parameters
    ----------
    overview : DataFrame
        As :func:`draw_overview` takes it.

    Returns
    -------
    dict of str to str
        JSON by path: the report's path with another ending. ``run`` is the time of the run.
    """
    now = f"{datetime.datetime.now():%Y-%m-%d %H:%M}"
    return {
        result_place(row["recording"], ".json"): json.dumps({**row, "run": now})
        for row in _texts(overview)
        if row["verdict"]
    }


def draw_overview(
    overview: pd.DataFrame, pages: Iterable[str], rows: Mapping[str, bytes | str]
) -> tuple[str, list[str]]:
    """Sum up all recordings that have a report on one page.

    Parameters
    ----------
    overview : DataFrame
        ``recording, verdict, summary, effects, alternatives, held_out, problem`` of the last run.
    pages : iterable of str
        Paths of the recordings' pages that are there, those of earlier runs among them.
    rows : mapping
        What :func:`rows_to_keep` has given, of this run and of earlier ones.

    Returns
    -------
    page : str
        HTML; it links the recordings' pages.
    outcome : list of str
        The last lines of a run.
    """
    last = [
        {**row, "run": "last", "page": result_place(row["recording"], ".html") if row["verdict"] else ""}
        for row in _texts(overview)
    ]
    earlier = _earlier(last, pages, rows)
    outcome = [_counted(overview)]
    if len(last) <= _FEW_RECORDINGS:
        outcome += [f"{row['recording']}: {_said(row)}" for row in last]
    parts: list[Part] = [
        Text(outcome[:1], emphasis=True),
        Text([_EARLIER_REPORTS]),
        Links([_link(row) for row in last], heading="Recordings of the last run"),
    ]
    if earlier:
        parts.append(Links([_link(row) for row in earlier], heading="Reports of earlier runs"))
    parts += [
        _in_one_table([*last, *earlier]),
        Links([_CSV]),
    ]
    return render_page("Recordings against their simulations", parts, pages=HOME), outcome


def _texts(overview: pd.DataFrame) -> list[dict[str, str]]:
    return overview.astype(object).fillna("").astype(str).to_dict("records")


def _earlier(
    last: list[dict[str, str]], pages: Iterable[str], rows: Mapping[str, bytes | str]
) -> list[dict[str, str]]:
    """What the pages say that the last run has not made, the newest first."""
    found = []
    for page in sorted(set(pages) - {row["page"] for row in last}):
        unknown = {"recording": page.removesuffix(".html"), "run": "earlier", "summary": _NO_ROW}
        kept = rows.get(f"{page.removesuffix('.html')}.json")
        row = unknown if kept is None else json.loads(kept)
        found.append({**dict.fromkeys(_HEADS, ""), **row, "page": page})
    return sorted(found, key=_date, reverse=True)


def _link(row: Mapping[str, str]) -> tuple[str, str, str]:
    date = _date(row)
    path = f"mismatch/{row['page']}" if row["page"] else ""
    return path, row["recording"], f"{date}. {_said(row)}" if date else _said(row)


def _date(row: Mapping[str, str]) -> str:
    """When an earlier run made a report; empty for the last run, and where it was not noted."""
    return row["run"] if row["run"][:1].isdigit() else ""


def _said(row: Mapping[str, str]) -> str:
    return row["summary"] or row["problem"]


def _counted(overview: pd.DataFrame) -> str:
    verdicts = overview["verdict"].fillna("").astype(str)
    counts = verdicts[verdicts != ""].value_counts()
    said = [f"{count} {_as_verb(str(verdict), count)}" for verdict, count in counts.items()]
    failed = int((verdicts == "").sum())
    if failed:
        said.append(f"{failed} could not be used")
    recordings = "recording" if len(verdicts) == 1 else "recordings"
    return f"{len(verdicts)} {recordings}: {', '.join(said)}."


def _as_verb(verdict: str, count: int) -> str:
    """The verdict as it follows a number of recordings."""
    one = count == 1
    verbs = {
        "agrees": "agrees" if one else "agree",
        "another tire": f"{'seems' if one else 'seem'} to be of another tire",
    }
    return verbs.get(verdict, verdict)


def _in_one_table(rows: list[dict[str, str]]) -> Table:
    table = without_empty_columns(pd.DataFrame(rows, columns=list(_HEADS)), _ALWAYS_SHOWN)
    table = table.assign(
        **{name: table[name].map(in_words) for name in ("effects", "alternatives") if name in table}
    )
    return Table(
        table.rename(columns=_HEADS),
        "Run: when the report was made, for earlier runs. Effects: what the model left out, or the fault of "
        f"the recording.{_ALTERNATIVES if 'alternatives' in table else ''}",
        heading="In one table",
        most_rows=1000,
    )
