"""The page of the translated files, and what a run says last."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import pandas as pd

from tire_pipeline.classifiers.open_set import LEAST_PROBABILITY, LEAST_TYPICALITY
from tire_pipeline.pages.visible_text import visible
from tire_pipeline.progress import track
from tire_pipeline.reporting import Table
from tire_pipeline.reporting.translation.drawn_files import DrawnFiles
from tire_pipeline.reporting.translation.translated_files_page import translated_page
from tire_pipeline.translation.parameters import TranslateParameters
from tire_pipeline.translation.result import EDGE, REFUSED, TRANSLATED, UNKNOWN
from tire_pipeline.translation.translated_block import curves_in, has_tables, table_in

_PROTOCOLS = (
    "Categories that changed how they measure, as their files show: the day with its 90% range, the "
    "probability of a change, and how far it moved the curves of the mean tire (90% intervals). A file "
    "counts by its date; one without a date counts as the mean of both protocols. Of the target, the "
    "newest protocol counts."
)
_MOST_REASONS = 5


def translate_page(
    report: pd.DataFrame,
    parts: Mapping[str, Callable[[], bytes]],
    protocols: pd.DataFrame,
    demonstration_files: list[str],
    parameters: TranslateParameters,
    target: str,
) -> tuple[str, list[str]]:
    """Draw every file on one page, and say how many were translated.

    Parameters
    ----------
    report : DataFrame
    parts : mapping
        What was translated (:func:`.translation.translated_folder.translate_each`); read one after the other.
    protocols : DataFrame
    demonstration_files : list of str
        Files that are not the user's own.
    parameters : TranslateParameters
    target : str

    Returns
    -------
    page : str
        HTML.
    outcome : list of str
        The last lines of a run.
    """
    own = set(report["file"].astype(str)) - set(demonstration_files)
    outcome = _outcome(report, own, target, parameters)
    tables = []
    if len(protocols):
        shown = protocols.rename(columns=lambda name: name.replace("_", " "))
        tables.append(Table(shown, _PROTOCOLS, heading="Changes of protocol"))
    drawn, tires = _drawn(parts)
    page = translated_page(
        f"Translated to {target}",
        [*outcome, *_explained(report, parameters)],
        report,
        drawn,
        own=own,
        tires=tires,
        tables=tables,
    )
    return page, outcome


def _drawn(parts: Mapping[str, Callable[[], bytes]]) -> tuple[DrawnFiles, dict[str, str]]:
    """What is drawn of every file, and the tire of each, read one part after the other."""
    drawn, tires = DrawnFiles(), dict[str, str]()
    for load in track(parts.values(), "reading what was translated", total=len(parts)):
        part = load()
        if has_tables(part):
            drawn.add(curves_in(part), table_in(part, "coefficients"))
            names = table_in(part, "sources")[["file", "tire_id"]]
            tires |= dict(names.itertuples(index=False, name=None))
    return drawn, tires


def _outcome(report: pd.DataFrame, own: set[str], target: str, parameters: TranslateParameters) -> list[str]:
    asked = _asked_for(parameters)
    lines = []
    mine = report["file"].isin(own)
    for rows, whose in ((mine, "Your own"), (~mine, "The demonstration fleet's")):
        if count := int(rows.sum()):
            files = f"{count:,} {'file' if count == 1 else 'files'}{' asked for' if asked else ''}"
            lines.append(f"{whose} {files}: {_counted(report[rows], target)}.")
    if asked:
        lines.append(
            f"This run was restricted: {asked}. This page shows these files only. Other files that earlier "
            "runs translated stay in 07_model_output/translated until a run without the restriction."
        )
    if why := _why_refused(report):
        lines.append(f"Refused: {why}. The page gives the whole reason for each file.")
    translated = report[report["verdict"] == TRANSLATED]
    if len(translated):
        middle = translated["expected_rms_ratio"].median()
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


def _counted(report: pd.DataFrame, target: str) -> str:
    targets = (report["source"] == target).to_numpy()
    counts = report.loc[~targets, "verdict"].value_counts().to_dict()
    first = [f"{counts.pop(TRANSLATED, 0):,} translated to {target}", f"{counts.pop(REFUSED, 0):,} refused"]
    if unknown := counts.pop(UNKNOWN, 0):
        first.append(f"{unknown:,} of an unknown supplier")
    others = [f"{count:,} {verdict}" for verdict, count in counts.items()]
    if measured := int(targets.sum()):
        others.append(f"{measured:,} measured by {target} itself")
    return ", ".join([*first, *others])


def _why_refused(report: pd.DataFrame) -> str:
    """The reasons without their details, the most frequent first, with how many files each holds for."""
    reasons = report.loc[report["verdict"] == REFUSED, "reason"].astype(str)
    counts = reasons.map(lambda reason: reason.partition(": ")[0]).value_counts()
    shown = [f"{visible(str(why))} ({count:,})" for why, count in counts.iloc[:_MOST_REASONS].items()]
    others = int(counts.iloc[_MOST_REASONS:].sum())
    return "; ".join([*shown, *([f"other reasons ({others:,})"] if others else [])])


def _explained(report: pd.DataFrame, parameters: TranslateParameters) -> list[str]:
    reach = "distance 1, the edge of the training data"
    if parameters.farthest != EDGE:
        reach = f"distance {parameters.farthest:g}, as asked for (1 is the edge of the training data)"
    lines = [
        "Translated: the error is expected to shrink.",
        "Already unbiased: the target measured it, or the 90% bands of the supplier's bias contain zero and "
        "nothing beyond 5%.",
        "Left alone: too little would be gained, or the bias cannot be told from chance, as with few "
        "training files.",
        "Refused: the file cannot be read or is of version 6.x, no physical tire was found, or its tire is "
        "too far from those learned from.",
        "Unknown supplier: too few files of this folder were learned from to know its bias.",
        f"Only translated files are written, none beyond {reach}. Errors are RMS of side and longitudinal "
        "force; the aligning torque is translated, but is not among them.",
        f"Method: {parameters.translator.replace('_', ' ')}. Tires that several organisations measured were "
        + ("used." if parameters.pairs else "not used."),
    ]
    if parameters.classify:
        lines.append(
            "Files of unknown suppliers were classified, as asked for: a file is assigned to a category if "
            f"its calibrated probability is at least {LEAST_PROBABILITY:g} and at least "
            f"{LEAST_TYPICALITY:.0%} of the category's own files lie as far from its mean. A laboratory that "
            "copies the rig, the ranges and the fits of a known one cannot be told from it."
        )
    if "taught" in report and report["taught"].max() > 0:
        lines.append(
            "The model also learned from the files to translate: each was translated with what the files of "
            "other tires say about their categories. Among other files the result would differ a little."
        )
    return lines
