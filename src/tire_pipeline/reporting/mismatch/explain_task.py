"""One recording, or several of one tire: explained, as the bytes of one stored file."""

from __future__ import annotations

import hashlib
import json
import tempfile
import uuid
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path, PurePosixPath
from typing import Any

import pandas as pd

from tire_pipeline.errors import RecordingError, cause_in_entry
from tire_pipeline.files.objects import UnreachableError
from tire_pipeline.files.packed import Passing, pack
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch import Explainer, MismatchReport, explain_recordings
from tire_pipeline.mismatch.inference.learnt.sizes import LearntSizes, learnt
from tire_pipeline.reporting.mismatch.result_names import result_place
from tire_pipeline.tir.sidecar import sidecar_path

COLUMNS = ("recording", "verdict", "summary", "effects", "alternatives", "held_out", "problem")
PAGE = "page.html"
LoadPair = Callable[..., tuple[TireModel | None, pd.DataFrame]]


@dataclass(frozen=True)
class ExplainTask:
    """Explains recordings together.

    Attributes
    ----------
    name : str
        Of the recording, or ``folder/together``.
    loads : mapping
        Recording -> the function that reads it and its tire.
    how : mapping
        Recording -> what is stated of it: ``axes``, ``units``, ``names``, ``tir``.
    held_out : str, optional
        The recording that takes no part and is predicted.
    learnt : LearntSizes
        What the posterior has learnt.
    without : tuple of str
        Effects that are not looked for.
    """

    name: str
    loads: Mapping[str, LoadPair]
    how: Mapping[str, Mapping[str, Any]]
    held_out: str | None
    learnt: LearntSizes = field(default_factory=learnt)
    without: tuple[str, ...] = ()

    @property
    def label(self) -> str:
        """What progress calls it."""
        return self.name

    @property
    def key(self) -> str:
        """A hash of all that the result depends on; another one each time where a reader cannot tell."""
        sizes = json.dumps(self.learnt.to_dict(), sort_keys=True)
        total = hashlib.sha256(f"{self.name}\0{self.held_out}\0{sizes}\0{self.without}\0".encode())
        for each, load in self.loads.items():
            own = getattr(load, "fingerprint", None)
            content = uuid.uuid4().hex if own is None else own(self.how[each].get("tir", ""))
            stated = json.dumps(self.how[each], sort_keys=True)
            total.update(f"{each}\0{content}\0{stated}\0".encode())
        return total.hexdigest()[:24]

    def __call__(self) -> bytes:
        """``row.json``, ``report.json`` (null: it could not be explained), ``page.html``, corrected files."""
        row = dict.fromkeys(COLUMNS, "") | {"recording": self.name}
        loads = {each: partial(load, **self.how[each]) for each, load in self.loads.items()}
        try:
            tire, runs = _read(loads)
            explainer = Explainer(without=self.without, learnt=self.learnt)
            report = explain_recordings(tire, runs, held_out=self.held_out, explainer=explainer)
        except Exception as error:
            cause = cause_in_entry(error)
            if isinstance(cause, UnreachableError):
                raise
            return self.lost(_reason(cause, self.name))
        row["verdict"] = report.stated_verdict
        row["summary"] = report.summary
        row["effects"] = ", ".join(effect.name for effect in report.effects)
        row["alternatives"] = ", ".join(a for effect in report.effects for a in effect.alternatives)
        row["held_out"] = report.held_out.recording if report.held_out else ""
        page, files = _files(report, PurePosixPath(self.name), tire)
        head = {"row.json": json.dumps(row), "report.json": json.dumps(report.to_dict()), PAGE: page}
        return pack({**{name: text.encode() for name, text in head.items()}, **files})

    def lost(self, reason: str) -> Passing:
        """What is stored of recordings that cannot be explained: until the next run, which tries again."""
        row = dict.fromkeys(COLUMNS, "") | {"recording": self.name, "problem": reason}
        return Passing(pack({"row.json": json.dumps(row).encode(), "report.json": b"null"}))


def _reason(error: Exception, recording: str) -> str:
    """What an error says, without the path of the recording, beside whose name it stands."""
    before, found, after = str(getattr(error, "where", None) or "").rpartition(recording)
    if not found or before[-1:] not in ("", "/", "\\"):
        return str(error)
    line = f"line {after[1:]}: " if after[:1] == ":" else ""
    return str(error).replace(f"{before}{found}{after}: ", line, 1)


def corrected_files(recording: str) -> tuple[str, str]:
    """The corrected ``.tir`` file of a recording, and the sidecar beside it, relative to their folder."""
    tir = result_place(recording, "_corrected.tir")
    return tir, sidecar_path(tir).as_posix()


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
) -> tuple[str, dict[str, bytes]]:
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
            target = Path(folder) / "corrected.tir"
            report.corrected.to_tir(target)
            written = (target, sidecar_path(target))
            named = zip(corrected_files(str(place)), written, strict=True)
            files = {name: path.read_bytes() for name, path in named if path.exists()}
    return text, files
