"""All recordings that have a report on one page, and what a run says last."""

from __future__ import annotations

import datetime
import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, partial

import pandas as pd

from tire_pipeline.files.rows_on_disk import RowsOnDisk
from tire_pipeline.mismatch.report.words import in_words
from tire_pipeline.pages.numbers_in_words import how_many
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
MOST_LISTED = 5_000
"""So many recordings of the last run the page lists, and so many reports of earlier runs."""
_CSV = ("tables/mismatch_overview.csv", "Table of the last run (CSV)", "with every recording's summary")


def rows_to_keep(overview: Iterable[pd.DataFrame]) -> NotedRows:
    """Note what each report of a run says, for the overview of later runs.

    Parameters
    ----------
    overview : iterable of DataFrame
        As :func:`draw_overview` takes it.

    Returns
    -------
    NotedRows
        JSON by path: the report's path with another ending. ``run`` is the time of the run.
    """
    now = _now()
    said = (row for row in _texts(overview) if row["verdict"])
    return NotedRows(
        (result_place(row["recording"], ".json"), json.dumps({**row, "run": now})) for row in said
    )


def _now() -> str:
    return f"{datetime.datetime.now():%Y-%m-%d %H:%M}"


class NotedRows(Mapping[str, Callable[[], bytes]]):
    """What reports say, by path; names and texts are on the disk.

    Parameters
    ----------
    noted : iterable of (str, str)
        Path and text.
    """

    def __init__(self, noted: Iterable[tuple[str, str]]) -> None:
        self._rows = RowsOnDisk(["place", "text"])
        self._rows.do("create unique index by_place on rows (place)")
        self._rows.add(noted)

    def __getitem__(self, place: str) -> Callable[[], bytes]:
        """The function that reads a text."""
        found = self._rows.do("select text from rows where place = ?", (place,)).fetchone()
        if found is None:
            raise KeyError(place)
        return partial(str.encode, found[0])

    def __iter__(self) -> Iterator[str]:
        """Paths, sorted."""
        return (place for (place,) in self._rows.do("select place from rows order by place"))

    def __len__(self) -> int:
        return int(self._rows.do("select count(*) from rows").fetchone()[0])


def draw_overview(
    overview: Iterable[pd.DataFrame], pages: Iterable[str], rows: Mapping[str, bytes | str]
) -> tuple[str, list[str]]:
    """Sum up all recordings that have a report on one page.

    Only what the page lists is in memory.

    Parameters
    ----------
    overview : iterable of DataFrame
        ``recording, verdict, summary, effects, alternatives, held_out, problem`` of the last run, in parts.
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
    last = _last_run(overview)
    earlier = _earlier(last.rows, pages, rows)
    outcome = [_counted(last.rows)]
    if last.count <= _FEW_RECORDINGS:
        outcome += [f"{row['recording']}: {_said(row)}" for row in last.first]
    parts: list[Part] = [
        Text(outcome[:1], emphasis=True),
        Text([f"The last run was on {_now()}.", _EARLIER_REPORTS]),
        Links([_link(row) for row in last.first], heading="Recordings of the last run"),
        *last.more("All recordings of the last run are in the table (CSV) below."),
    ]
    if earlier.count:
        parts.append(Links([_link(row) for row in earlier.first], heading="Reports of earlier runs"))
        parts += earlier.more("The pages of all are in the folder mismatch beside this page.")
    parts += [_in_one_table(last, earlier), *([Links([_CSV])] if last.any_explained else [])]
    return render_page("Recordings against their simulations", parts, pages=HOME), outcome


@dataclass(frozen=True)
class _ListedReports:
    """Rows on the disk, and those of them that the page lists."""

    rows: RowsOnDisk
    order: str

    @cached_property
    def count(self) -> int:
        return int(self.rows.do("select count(*) from rows").fetchone()[0])

    @cached_property
    def first(self) -> list[dict[str, str]]:
        query = f"select text from rows order by {self.order} limit {MOST_LISTED}"
        return [json.loads(text) for (text,) in self.rows.do(query)]

    @cached_property
    def any_explained(self) -> bool:
        """Whether a recording has a page; a run without one ends in an error, and leaves no table."""
        return bool(self.rows.do("select exists (select 1 from rows where page != '')").fetchone()[0])

    def more(self, where: str) -> list[Part]:
        """What is said of those that are not listed."""
        left = self.count - len(self.first)
        are = "is" if left == 1 else "are"
        return [Text([f"{left:,} more {are} not listed here. {where}"])] if left else []


def _texts(overview: Iterable[pd.DataFrame]) -> Iterator[dict[str, str]]:
    for frame in overview:
        yield from frame.astype(object).fillna("").astype(str).to_dict("records")


def _last_run(overview: Iterable[pd.DataFrame]) -> _ListedReports:
    """What the last run found, in its order."""
    rows = RowsOnDisk(["page", "verdict", "text"])
    for row in _texts(overview):
        page = result_place(row["recording"], ".html") if row["verdict"] else ""
        rows.add([(page, row["verdict"], json.dumps({**row, "run": "last", "page": page}))])
    rows.do("create index by_page on rows (page)")
    return _ListedReports(rows, "rowid")


def _earlier(last: RowsOnDisk, pages: Iterable[str], rows: Mapping[str, bytes | str]) -> _ListedReports:
    """What the pages say that the last run has not made, the newest first."""
    found = RowsOnDisk(["page", "date", "text"])
    for page in pages:
        if last.do("select 1 from rows where page = ?", (page,)).fetchone():
            continue
        unknown = {"recording": page.removesuffix(".html"), "run": "earlier", "summary": _NO_ROW}
        kept = rows.get(f"{page.removesuffix('.html')}.json")
        row = unknown if kept is None else _noted(kept) or unknown
        row = {**dict.fromkeys(_HEADS, ""), **row, "page": page}
        found.add([(page, _date(row), json.dumps(row))])
    return _ListedReports(found, "date desc, page")


def _noted(text: bytes | str) -> dict[str, str]:
    """What an earlier run noted; nothing if the note is damaged."""
    try:
        row = json.loads(text)
    except ValueError:
        return {}
    return {str(name): str(value) for name, value in row.items()} if isinstance(row, dict) else {}


def _link(row: Mapping[str, str]) -> tuple[str, str, str]:
    date = _date(row)
    path = f"mismatch/{row['page']}" if row["page"] else ""
    return path, row["recording"], f"{date}. {_said(row)}" if date else _said(row)


def _date(row: Mapping[str, str]) -> str:
    """When an earlier run made a report; empty for the last run, and where it was not noted."""
    return row["run"] if row["run"][:1].isdigit() else ""


def _said(row: Mapping[str, str]) -> str:
    return row["summary"] or row["problem"]


def _counted(last: RowsOnDisk) -> str:
    found = last.do("select verdict, count(*) from rows group by verdict order by count(*) desc, min(rowid)")
    counts = dict(found.fetchall())
    failed, total = counts.pop("", 0), sum(counts.values())
    said = [f"{count:,} {_as_verb(verdict, count)}" for verdict, count in counts.items()]
    if failed:
        said.append(f"{failed:,} could not be used")
    return f"{how_many(total + failed, 'recording')}: {', '.join(said)}."


def _as_verb(verdict: str, count: int) -> str:
    """The verdict as it follows a number of recordings."""
    one = count == 1
    verbs = {
        "agrees": "agrees" if one else "agree",
        "another tire": f"{'seems' if one else 'seem'} to be of another tire",
    }
    return verbs.get(verdict, verdict)


def _in_one_table(last: _ListedReports, earlier: _ListedReports) -> Table:
    rows = [*last.first, *earlier.first]
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
        further=last.count + earlier.count - len(rows),
    )
