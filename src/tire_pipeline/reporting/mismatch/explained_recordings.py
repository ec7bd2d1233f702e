"""Recordings -> what the model left out, as data, pages and corrected .tir files."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from fnmatch import fnmatch
from functools import partial
from pathlib import Path, PurePosixPath
from typing import Any, Literal

import pandas as pd
from pydantic import Field

from tire_pipeline.code_hash import code_hash
from tire_pipeline.errors import RecordingError, did_you_mean
from tire_pipeline.files.packed import SEAL, is_as_sealed, member, unpack
from tire_pipeline.files.read_later import Read
from tire_pipeline.files.rows_on_disk import FramesOfRows, RowsOnDisk
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.learnt.sizes import LearntSizes, learnt
from tire_pipeline.parameters import Parameters, Several
from tire_pipeline.progress import track
from tire_pipeline.recordings.groups import by_folder, matching
from tire_pipeline.reporting.mismatch.explain_task import (
    COLUMNS,
    PAGE,
    ExplainTask,
    LoadPair,
    corrected_files,
)
from tire_pipeline.reporting.mismatch.result_names import result_place

_REPORT = "report.json"
_MOST_TOLD = 3
"""Recordings whose problem an error names."""

Pairs = Mapping[str, LoadPair]


class RecordingRule(Parameters):
    """What is known of some recordings.

    Attributes
    ----------
    match : str
        Pattern of their paths or file names, such as ``rig_b/*.csv``.
    axes : {"ISO", "SAE", "adapted SAE"}, optional
        Axes of their channels.
    units : dict of str to str
        By the file's channel name: its unit.
    names : dict of str to str or float
        By the file's channel name: the canonical channel that it is. By a channel that the file lacks: the
        number that it was.
    tir : str
        The tire's file, relative to the recording's folder or to that of all recordings.
    without : list of str
        Effects of the catalogue that are not looked for.
    """

    match: str = Field("*", min_length=1)
    axes: Literal["ISO", "SAE", "adapted SAE"] | None = None
    units: dict[str, str] = {}
    names: dict[str, str | float] = {}
    tir: str = ""
    without: Several = []

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
    axes : {"ISO", "SAE", "adapted SAE"}, optional
        Axes of all recordings, unless a rule of ``recordings`` says otherwise.
    without : list of str
        Effects of the catalogue that are looked for in no recording.
    recordings : list of RecordingRule
        What is known of some recordings, by pattern.
    learnt : str
        File of learnt sizes that ``calibrate_mismatch`` wrote; those of the package if empty.
    """

    together: bool = False
    hold_out: str = ""
    only: Several = []
    axes: Literal["ISO", "SAE", "adapted SAE"] | None = None
    without: Several = []
    recordings: list[RecordingRule] = []
    learnt: str = ""

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

    def left_out(self, names: Iterable[str]) -> tuple[str, ...]:
        """Effects that are not looked for in recordings that are explained together."""
        rules = [rule for rule in self.recordings if any(rule.fits(name) for name in names)]
        return tuple(sorted({*self.without, *(effect for rule in rules for effect in rule.without)}))


def explain_each(recordings: Pairs, parameters: ExplainParameters) -> dict[str, ExplainTask]:
    """Explain each recording; what is stored and has not changed is not explained again.

    Parameters
    ----------
    recordings : mapping
        Relative path to the function that reads the recording and its tire.
    parameters : ExplainParameters

    Raises
    ------
    RecordingError
        None matches ``only``, ``hold_out`` or a rule, or the catalogue has no such effect.
    """
    excluded = [*parameters.without, *(each for rule in parameters.recordings for each in rule.without)]
    check_effects(excluded, "explain_mismatch: without")
    recordings = _chosen(recordings, parameters)
    groups = by_folder(recordings) if parameters.together else {name: [name] for name in recordings}
    held_out = _held_out(groups, parameters)
    code = code_hash("mismatch", "magic_formula", "tir", "recordings", "reporting")
    sizes, tasks = _learnt_as_sealed(parameters.learnt), {}
    for name, members in groups.items():
        loads = {each: recordings[each] for each in members}
        how = {each: parameters.how(each) for each in members}
        task = ExplainTask(name, loads, how, held_out.get(name), sizes, parameters.left_out(members))
        tasks[f"{code}/{task.key}.zip"] = task
    return tasks


def _learnt_as_sealed(path: str) -> LearntSizes:
    """Sizes of a file; if its hash lies beside it, as ``calibrate_mismatch`` writes both, it must be that."""
    seal = Path(path + SEAL)
    if path and seal.is_file() and not is_as_sealed(Path(path).read_bytes(), seal.read_bytes()):
        raise RecordingError(
            "these learnt sizes are damaged",
            where=path,
            todo=f"run calibrate_mismatch again, or remove {seal.name} if you changed them yourself",
        )
    return learnt(path)


def collect_explained(
    explained: Mapping[str, Read],
) -> tuple[ReportsByName, FramesOfRows, dict[str, Read], dict[str, Read | None]]:
    """Collect what was found in each recording.

    Parameters
    ----------
    explained : mapping
        What :func:`explain_each` gave, done.

    Returns
    -------
    reports : mapping
        ``MismatchReport.to_dict()`` by recording, or ``folder/together``; read when it is asked for.
    overview : iterable of DataFrame
        ``recording, verdict, summary, effects, alternatives, held_out, problem``; read from the disk some
        thousand rows at a time.
    pages : dict
        One HTML page a report, by the function that reads it: they are never in memory together.
    corrected : dict
        In the same way, ``.tir`` files with the missing physics added, and sidecars for what the format
        cannot hold. None in place of a file that a recording no longer has, because no physics is missing or
        a question is open on which all of it rests (its axes): that of an earlier run would be wrong.
    """
    reports, rows = ReportsByName(), RowsOnDisk(COLUMNS)
    pages, corrected = dict[str, Read](), dict[str, Read | None]()
    for read in track(explained.values(), "collecting reports", total=len(explained)):
        members = unpack(read())
        row, report = json.loads(members.pop("row.json")), members.pop(_REPORT)
        rows.add([tuple(row.get(name, "") for name in COLUMNS)])
        if json.loads(report) is None:
            continue
        reports.read[row["recording"]] = read
        del members[PAGE]
        pages[result_place(row["recording"], ".html")] = partial(_member, read, PAGE)
        corrected |= dict.fromkeys(corrected_files(row["recording"]))
        corrected |= {name: partial(_member, read, name) for name in members}
    overview = FramesOfRows(rows, "select * from rows order by rowid", dict.fromkeys(COLUMNS, "str"))
    return reports, overview, pages, corrected


@dataclass(frozen=True)
class ReportsByName(Mapping[str, Any]):
    """Reports, each read when it is asked for: they are never in memory together.

    Attributes
    ----------
    read : dict
        Name -> the function that reads what was found.
    """

    read: dict[str, Read] = field(default_factory=dict)

    def __getitem__(self, name: str) -> Any:
        """The report of a recording."""
        return json.loads(_member(self.read[name], _REPORT))

    def __iter__(self) -> Iterator[str]:
        """Names, in the order of the recordings."""
        return iter(self.read)

    def __len__(self) -> int:
        return len(self.read)


def refuse_none_explained(overview: Iterable[pd.DataFrame], outcome: list[str]) -> None:
    """End the run with an error if not one recording could be explained; its page is drawn by then.

    Parameters
    ----------
    overview : iterable of DataFrame
        Of :func:`collect_explained`.
    outcome : list of str
        What the page says, so that it is drawn first: that of an earlier run would be taken for this one's.

    Raises
    ------
    RecordingError
        With the first problems.
    """
    count, told = 0, list[str]()
    for frame in overview:
        if frame["verdict"].fillna("").astype(bool).any():
            return
        count += len(frame)
        first = frame[["recording", "problem"]].head(_MOST_TOLD - len(told))
        told += [f"{recording}: {problem}" for recording, problem in first.itertuples(index=False)]
    more = [f"and {count - len(told)} more"] if count > len(told) else []
    raise RecordingError(
        f"none of {count} recordings could be explained; {'; '.join(told + more)}",
        todo="correct that, then run again",
    )


def _member(read: Read, name: str) -> bytes:
    return member(read(), name)


def check_effects(names: Iterable[str], where: str) -> None:
    """Refuse a name that is not in the catalogue of effects.

    Parameters
    ----------
    names : iterable of str
    where : str
        Who names them, for the message.

    Raises
    ------
    RecordingError
        With the nearest name, or else all of them.
    """
    known = catalogue()
    for effect in names:
        if effect not in known:
            raise RecordingError(
                f"the catalogue has no effect {effect!r}",
                where=where,
                todo=did_you_mean(effect, known, f"there are {', '.join(known)}"),
            )


def _chosen(recordings: Pairs, parameters: ExplainParameters) -> Pairs:
    """The recordings that were asked for; a pattern that matches none is an error."""
    patterns = [*parameters.only, *(rule.match for rule in parameters.recordings)]
    for pattern in patterns:
        if not any(_matches(name, pattern) for name in recordings):
            raise RecordingError(
                f"{pattern!r} matches none of {len(recordings)} recordings",
                where="explain_mismatch",
                todo=did_you_mean(pattern, recordings, f"there is {next(iter(recordings))}"),
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
