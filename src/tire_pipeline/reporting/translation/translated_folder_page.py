"""The page of the translated files, and what a run says last."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import pandas as pd

from tire_pipeline.classifiers.open_set import LEAST_PROBABILITY, LEAST_TYPICALITY
from tire_pipeline.files.rows_on_disk import RowsOnDisk
from tire_pipeline.pages.numbers_in_words import how_many
from tire_pipeline.pages.page_in_pieces import PageInPieces
from tire_pipeline.pages.visible_text import visible
from tire_pipeline.progress import track
from tire_pipeline.reporting import Table
from tire_pipeline.reporting.translation.drawn_files import DrawnFiles
from tire_pipeline.reporting.translation.translated_files_page import translated_page
from tire_pipeline.reporting.translation.translated_rows import listed, median_expected
from tire_pipeline.translation.files.translated_block import curves_in, has_tables, table_in
from tire_pipeline.translation.parameters import TranslateParameters
from tire_pipeline.translation.population.category_spread import FEWEST_SHARED
from tire_pipeline.translation.population.model import POPULATION
from tire_pipeline.translation.result import EDGE, LEFT_ALONE, REFUSED, TRANSLATED, UNBIASED, UNKNOWN

_PROTOCOLS = (
    "Categories that changed how they measure, as their files show: the day with its 90% range, the "
    "probability of a change, and how far it moved the curves of the mean tire (90% intervals). A file "
    "counts by its date; one without a date counts as the mean of both protocols. Of the target, the "
    "newest protocol counts."
)
_MOST_REASONS = 5
_MOST_FIRST = "order by count(*) desc, min(rowid)"


def translate_page(
    report: Iterable[pd.DataFrame],
    parts: Mapping[str, Callable[[], bytes]],
    protocols: pd.DataFrame,
    demonstration_files: list[str],
    parameters: TranslateParameters,
    target: str,
    translator: Mapping[str, Any] | None = None,
) -> tuple[PageInPieces, list[str]]:
    """Draw every file on one page, and say how many were translated.

    Parameters
    ----------
    report : iterable of DataFrame
    parts : mapping
        What was translated (:func:`.translation.files.translated_folder.translate_each`); read one after
        the other.
    protocols : DataFrame
    demonstration_files : list of str
        Files that are not the user's own.
    parameters : TranslateParameters
    target : str
    translator : mapping, optional
        State of the fitted translator: tells what it knows from tires that several organisations measured.

    Returns
    -------
    page : PageInPieces
        HTML.
    outcome : list of str
        The last lines of a run.
    """
    drawn = _drawn(parts)
    rows = listed(report, frozenset(demonstration_files), drawn.tire)
    outcome = _outcome(rows, target, parameters)
    tables = []
    if len(protocols):
        shown = protocols.rename(columns=lambda name: name.replace("_", " "))
        tables.append(Table(shown, _PROTOCOLS, heading="Changes of protocol"))
    tables.insert(0, Table(_WHAT_VERDICTS_MEAN, "", heading="What the verdicts mean"))
    notes = [*_notes(rows, parameters), *_from_pairs(translator)]
    return translated_page(
        f"Translated to {target}", outcome, rows, drawn, tables=tables, notes=notes
    ), outcome


def _drawn(parts: Mapping[str, Callable[[], bytes]]) -> DrawnFiles:
    """What is drawn of every file, and the tire of each, read one part after the other."""
    drawn = DrawnFiles()
    for load in track(parts.values(), "reading what was translated", total=len(parts)):
        part = load()
        if has_tables(part):
            tires = table_in(part, "sources")[["file", "tire_id"]].itertuples(index=False, name=None)
            drawn.add(curves_in(part), table_in(part, "coefficients"), dict(tires))
    return drawn


def _outcome(rows: RowsOnDisk, target: str, parameters: TranslateParameters) -> list[str]:
    asked = _asked_for(parameters)
    lines = []
    for own, whose in ((True, "Your own"), (False, "The demonstration fleet's")):
        (count,) = rows.do("select count(*) from rows where own = ?", (own,)).fetchone()
        if count:
            files = how_many(count, "file") if count > 1 else "file"
            lines.append(f"{whose} {files}{' asked for' if asked else ''}: {_counted(rows, own, target)}.")
    if asked:
        lines.append(
            f"This run was restricted: {asked}. This page shows these files only. Other files that earlier "
            "runs translated stay in 07_model_output/translated until a run without the restriction."
        )
    if why := _why_refused(rows):
        lines.append(f"Refused: {why}. The page gives the whole reason for each file.")
    if (middle := median_expected(rows)) is not None:
        lines.append(
            f"The RMS error of the translated files is expected to shrink to {middle:.0%} of the unchanged "
            "files' (median, the translator's own estimate; it has not been checked on these files)."
        )
    return lines


def _asked_for(parameters: TranslateParameters) -> str:
    """What the run was restricted to, in words; "" for all files."""
    said = [f"only {', '.join(parameters.only)}"] if parameters.only else []
    if parameters.trials:
        said.append(f"at most {parameters.trials:,} files (trials)")
    return ", ".join(said)


def _counted(rows: RowsOnDisk, own: bool, target: str) -> str:
    each = "select verdict, count(*) from rows where own = ? and source <> ? group by verdict"
    counts = dict(rows.do(f"{each} {_MOST_FIRST}", (own, target)).fetchall())
    first = [f"{counts.pop(TRANSLATED, 0):,} translated to {target}", f"{counts.pop(REFUSED, 0):,} refused"]
    if unknown := counts.pop(UNKNOWN, 0):
        first.append(f"{unknown:,} of an unknown supplier")
    others = [f"{count:,} {verdict}" for verdict, count in counts.items()]
    of_target = "select count(*) from rows where own = ? and source = ?"
    (measured,) = rows.do(of_target, (own, target)).fetchone()
    if measured:
        others.append(f"{measured:,} measured by {target} itself")
    return ", ".join([*first, *others])


def _why_refused(rows: RowsOnDisk) -> str:
    """The reasons without their details, the most frequent first, with how many files each holds for."""
    end = "instr(reason || ': ', ': ') - 1"
    refused = f"from rows where verdict = '{REFUSED}'"
    each = f"select substr(reason, 1, {end}) as why, count(*) {refused} group by why {_MOST_FIRST}"
    counts = rows.do(f"{each} limit {_MOST_REASONS}").fetchall()
    (others,) = rows.do(f"select count(*) {refused}").fetchone()
    others -= sum(count for _, count in counts)
    shown = [f"{visible(why)} ({count:,})" for why, count in counts]
    return "; ".join([*shown, *([f"other reasons ({others:,})"] if others else [])])


_WHAT_VERDICTS_MEAN = pd.DataFrame(
    [
        (TRANSLATED, "The error is expected to shrink."),
        (
            UNBIASED,
            "The target measured it, or the 90% bands of the supplier's bias contain zero and nothing beyond "
            "5%.",
        ),
        (
            LEFT_ALONE,
            "Too little would be gained, or the bias cannot be distinguished from chance, as with few "
            "training files.",
        ),
        (
            REFUSED,
            "The file cannot be read or is of version 6.x, no physical tire was found, or its tire is too "
            "far from those learned from.",
        ),
        (UNKNOWN, "Too few files of this folder were learned from to know its bias."),
    ],
    columns=["verdict", "meaning"],
)


_TAKEN_FOR_BIAS = (
    "If a supplier's own tires are stiffer or have more grip than those of the target, that counts as bias, "
    "and no band contains it."
)


def _from_pairs(translator: Mapping[str, Any] | None) -> list[str]:
    """What tires that several organisations measured told, and what is assumed where they are few."""
    if translator is None or "variance_names" not in translator:
        return []
    if POPULATION in translator["variance_names"]:
        return [
            "Tires that several organisations measured were used. They also tell how a supplier measures "
            "from what its own tires have in common."
        ]
    if translator["pairs"]:
        return [
            "Tires that several organisations measured were used. They do not show clearly that suppliers' "
            f"own tires differ (fewer than {FEWEST_SHARED} never do). {_TAKEN_FOR_BIAS}"
        ]
    if not translator["option_pairs"]:
        return [f"Tires that several organisations measured were not used, as asked for. {_TAKEN_FOR_BIAS}"]
    return [
        "No tire was measured by several organisations, as far as the sizes, radii and masses in the files "
        f"tell. {_TAKEN_FOR_BIAS}"
    ]


def _notes(rows: RowsOnDisk, parameters: TranslateParameters) -> list[str]:
    """How it was done, for below the files."""
    reach = "distance 1, the edge of the training data"
    if parameters.farthest != EDGE:
        reach = f"distance {parameters.farthest:g}, as asked for (1 is the edge of the training data)"
    lines = [
        f"Method: {parameters.translator.replace('_', ' ')}.",
        f"Only translated files are written, none beyond {reach}. Errors are RMS of side and longitudinal "
        "force; the aligning torque is translated, but is not among them.",
    ]
    if parameters.classify:
        lines.append(
            "Files of unknown suppliers were classified, as asked for: a file is assigned to a category if "
            f"its calibrated probability is at least {LEAST_PROBABILITY:g} and at least "
            f"{LEAST_TYPICALITY:.0%} of the category's own files lie as far from its mean. A laboratory that "
            "copies the rig, the ranges and the fits of a known one cannot be distinguished from it."
        )
    if rows.do("select max(taught) > 0 from rows").fetchone()[0]:
        lines.append(
            "The model also learned from the files to translate: each was translated with what the files of "
            "other tires say about their categories. Among other files the result would differ a little."
        )
    return lines
