"""Recordings -> what the model left out, as data, pages and corrected .tir files."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping
from difflib import get_close_matches
from fnmatch import fnmatch
from functools import partial
from pathlib import Path, PurePosixPath
from typing import Any, Literal

import pandas as pd
from pydantic import Field

from tire_pipeline.errors import RecordingError, TirePipelineError
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch import MismatchReport, explain_recordings
from tire_pipeline.parameters import Parameters, Several
from tire_pipeline.progress import track
from tire_pipeline.recordings.groups import by_folder, matching

_COLUMNS = ("recording", "verdict", "summary", "effects", "alternatives", "held_out", "problem")
Pairs = Mapping[str, Callable[[], tuple[TireModel | None, pd.DataFrame]]]


class RecordingRule(Parameters):
    """What is known of some recordings.

    Attributes
    ----------
    match : str
        Pattern of their paths or file names, such as ``rig_b/*.csv``.
    axes : {"ISO", "SAE"}, optional
        Axes of their channels.
    units, names : dict of str to str
        By the file's channel name: its unit, and the canonical channel that it is.
    tir : str
        The tire's file, relative to the recording's folder or to that of all recordings.
    """

    match: str = Field("*", min_length=1)
    axes: Literal["ISO", "SAE"] | None = None
    units: dict[str, str] = {}
    names: dict[str, str] = {}
    tir: str = ""

    def fits(self, name: str) -> bool:
        """Whether the rule is about a recording."""
        return _matches(name, self.match)


class ExplainParameters(Parameters):
    """Parameters of ``explain_mismatch``.

    Attributes
    ----------
    together : bool
        Whether the recordings of one folder are of one tire and explained together.
    hold_out : str
        With ``together``: pattern of the recording of each folder that takes no part and is predicted.
    only : list of str
        Recordings, folders or patterns; empty is all. On the command line several are separated by ``;``.
    axes : {"ISO", "SAE"}, optional
        Axes of all recordings, unless a rule of ``recordings`` says otherwise.
    recordings : list of RecordingRule
        What is known of some recordings, by pattern.
    """

    together: bool = False
    hold_out: str = ""
    only: Several = []
    axes: Literal["ISO", "SAE"] | None = None
    recordings: list[RecordingRule] = []

    def how(self, name: str) -> dict[str, Any]:
        """What is stated of a recording; a later rule counts more than an earlier one."""
        found: dict[str, Any] = {"axes": self.axes, "units": {}, "names": {}, "tir": ""}
        for rule in self.recordings:
            if rule.fits(name):
                found["axes"] = rule.axes or found["axes"]
                found["tir"] = rule.tir or found["tir"]
                found["units"] |= rule.units
                found["names"] |= rule.names
        return {key: value for key, value in found.items() if value}


def explain_all(
    recordings: Pairs, parameters: ExplainParameters
) -> tuple[dict[str, Any], pd.DataFrame, dict[str, str], dict[str, bytes]]:
    """Explain every recording.

    Parameters
    ----------
    recordings : mapping
        Relative path to the function that reads the recording and its tire.
    parameters : ExplainParameters

    Returns
    -------
    reports : dict
        ``MismatchReport.to_dict()`` by recording, or ``folder/together``.
    overview : DataFrame
        ``recording, verdict, summary, effects, alternatives, held_out, problem``.
    pages : dict of str to str
        One HTML page a report.
    corrected : dict of str to bytes
        ``.tir`` files with the missing physics put in, and sidecars for what the format cannot hold. None
        for a recording that leaves a question open on which all of it rests (its axes).

    Raises
    ------
    RecordingError
        If not one recording could be explained, or none matches ``hold_out``.
    """
    recordings = _chosen(recordings, parameters)
    groups = by_folder(recordings) if parameters.together else {name: [name] for name in recordings}
    held_out = _held_out(groups, parameters)
    reports, rows = dict[str, Any](), list[dict[str, str]]()
    pages, corrected = dict[str, str](), dict[str, bytes]()
    for name, members in track(groups.items(), "explaining recordings", total=len(groups)):
        loaders = {each: partial(recordings[each], **parameters.how(each)) for each in members}
        try:
            tire, runs = _read(loaders)
            report = explain_recordings(tire, runs, held_out=held_out.get(name))
        except TirePipelineError as error:
            rows.append({**dict.fromkeys(_COLUMNS, ""), "recording": name, "problem": str(error)})
            continue
        reports[name] = report.to_dict()
        rows.append(_row(name, report))
        page, files = _files(report, PurePosixPath(name), tire)
        pages |= page
        corrected |= files
    _check_any(reports, rows)
    return reports, pd.DataFrame(rows), pages, corrected


def _check_any(reports: Mapping[str, Any], rows: list[dict[str, str]]) -> None:
    if not reports:
        raise RecordingError(
            f"not one of {len(rows)} recordings could be explained; the first: {rows[0]['problem']}",
            todo="correct that, then run again",
        )


def _row(name: str, report: MismatchReport) -> dict[str, str]:
    """One recording's row of the overview."""
    return {
        "recording": name,
        "verdict": report.verdict,
        "summary": report.summary,
        "effects": ", ".join(effect.name for effect in report.effects),
        "alternatives": ", ".join(a for effect in report.effects for a in effect.alternatives),
        "held_out": report.held_out.recording if report.held_out else "",
        "problem": "",
    }


def _chosen(recordings: Pairs, parameters: ExplainParameters) -> Pairs:
    """The recordings that were asked for; a pattern that matches none is an error."""
    patterns = [*parameters.only, *(rule.match for rule in parameters.recordings)]
    for pattern in patterns:
        if not any(_matches(name, pattern) for name in recordings):
            near = get_close_matches(pattern, recordings, n=1)
            raise RecordingError(
                f"{pattern!r} matches none of {len(recordings)} recordings",
                where="explain_mismatch",
                todo=f"did you mean {near[0]!r}?" if near else f"there is {next(iter(recordings))}",
            )
    if not parameters.only:
        return recordings
    return {
        name: load
        for name, load in recordings.items()
        if any(_matches(name, pattern) for pattern in parameters.only)
    }


def _matches(name: str, pattern: str) -> bool:
    place = PurePosixPath(name)
    return pattern in place.parts[:-1] or fnmatch(name, pattern) or fnmatch(place.name, pattern)


def _held_out(groups: Mapping[str, list[str]], parameters: ExplainParameters) -> dict[str, str]:
    """The recording of each group that takes no part."""
    if not parameters.hold_out:
        return {}
    found = {
        name: matching(members, parameters.hold_out) for name, members in groups.items() if len(members) > 1
    }
    held_out = {name: member for name, member in found.items() if member is not None}
    if not held_out:
        raise RecordingError(
            f"hold_out = {parameters.hold_out!r} matches no recording of a folder with several",
            where="explain_mismatch",
            todo="correct the pattern, and set explain_mismatch.together to true",
        )
    return held_out


def _read(
    loaders: Mapping[str, Callable[[], tuple[TireModel | None, pd.DataFrame]]],
) -> tuple[TireModel | None, dict[str, pd.DataFrame]]:
    """The tire that all recordings belong to, and the recordings."""
    pairs = {name: load() for name, load in loaders.items()}
    tires = {None if tire is None else tire.path: tire for tire, _ in pairs.values()}
    if len(tires) > 1:
        raise RecordingError(
            f"the recordings belong to several tires ({', '.join(map(str, tires))})",
            where=", ".join(loaders),
            todo="keep the recordings of each tire in a folder of their own",
        )
    return next(iter(tires.values())), {name: recording for name, (_, recording) in pairs.items()}


def _files(
    report: MismatchReport, place: PurePosixPath, tire: TireModel | None
) -> tuple[dict[str, str], dict[str, bytes]]:
    """The page, and the corrected .tir with its sidecar where there is something to correct."""
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder) / "page.html"
        up = "../" * len(place.parts)
        pages = [(f"{up}index.html", "All reports"), (f"{up}mismatch.html", "All recordings")]
        report.to_html(page, pages=pages)
        text = page.read_text(encoding="utf-8")
        files: dict[str, bytes] = {}
        physics = [effect for effect in report.effects if effect.kind == "physics"]
        if tire is not None and physics and report.corrected.question is None:
            target = Path(folder) / "tir" / f"{place.stem}_corrected.tir"
            target.parent.mkdir()
            report.corrected.to_tir(target)
            files = {str(place.parent / p.name): p.read_bytes() for p in target.parent.iterdir()}
    return {str(place.with_suffix(".html")): text}, files
