"""Recordings -> what the model left out, as data, pages and corrected .tir files."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path, PurePosixPath
from typing import Any

import pandas as pd

from tire_pipeline.errors import RecordingError, TirePipelineError
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch import MismatchReport, explain_mismatch
from tire_pipeline.progress import track

Pairs = Mapping[str, Callable[[], tuple[TireModel | None, pd.DataFrame]]]


def explain_all(
    recordings: Pairs,
) -> tuple[dict[str, Any], pd.DataFrame, dict[str, str], dict[str, bytes]]:
    """Explain every recording.

    Parameters
    ----------
    recordings : mapping
        Relative path to the function that reads the recording and its tire.

    Returns
    -------
    reports : dict
        ``MismatchReport.to_dict()`` by recording.
    overview : DataFrame
        ``recording, verdict, effects, alternatives, problem``.
    pages : dict of str to str
        One HTML page a recording.
    corrected : dict of str to bytes
        ``.tir`` files with the missing physics put in, and sidecars for what the format cannot hold.

    Raises
    ------
    RecordingError
        If not one recording could be explained.
    """
    reports: dict[str, Any] = {}
    rows: list[dict[str, str]] = []
    pages: dict[str, str] = {}
    corrected: dict[str, bytes] = {}
    for name, load in track(recordings.items(), "explaining recordings", total=len(recordings)):
        row = {"recording": name, "verdict": "", "effects": "", "alternatives": "", "problem": ""}
        rows.append(row)
        try:
            tire, recording = load()
            report = explain_mismatch(tire, recording)
        except TirePipelineError as error:
            row["problem"] = str(error)
            continue
        reports[name] = report.to_dict()
        row["verdict"] = report.verdict
        row["effects"] = ", ".join(effect.name for effect in report.effects)
        row["alternatives"] = ", ".join(a for effect in report.effects for a in effect.alternatives)
        place = PurePosixPath(name)
        pages[str(place.with_suffix(".html"))], files = _files(report, place, tire)
        corrected |= files
    if not reports:
        raise RecordingError(
            f"not one of {len(rows)} recordings could be explained; the first: {rows[0]['problem']}",
            todo="mend that, then run again",
        )
    return reports, pd.DataFrame(rows), pages, corrected


def _files(
    report: MismatchReport, place: PurePosixPath, tire: TireModel | None
) -> tuple[str, dict[str, bytes]]:
    """The page, and the corrected .tir with its sidecar where there is something to correct."""
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder) / "page.html"
        report.to_html(page)
        text = page.read_text(encoding="utf-8")
        files: dict[str, bytes] = {}
        physics = [effect for effect in report.effects if effect.kind == "physics"]
        if tire is not None and physics:
            target = Path(folder) / "tir" / f"{place.stem}_corrected.tir"
            target.parent.mkdir()
            report.corrected.to_tir(target)
            files = {str(place.parent / p.name): p.read_bytes() for p in target.parent.iterdir()}
    return text, files
