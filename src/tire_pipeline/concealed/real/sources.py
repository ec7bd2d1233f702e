"""Real recordings as sweeps: what one case is fitted to, shown and judged on.

A sweep is what the recording itself keeps apart: a sweep of the flat belt between two gaps, one drive, one
steady point. Sweeps that thresholds were set with are listed by hash in ``development.csv``; no sealed case
is made from them.
"""

from __future__ import annotations

import csv
import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Literal

import numpy as np
import pandas as pd

from tire_pipeline.errors import DomainError
from tire_pipeline.recordings import DART_CAR, axle_recording, read_dart, read_recording

Pool = Literal["development", "sealed"]
SOURCES = ("calspan", "dart", "tydex")
UNLOADED_RADIUS = {"calspan": 0.2, "dart": 0.023, "tydex": 0.3}
"""Of the wheel, m: every property file states it."""

LIST = "development.csv"
GAP = 0.05
"""Pause between two sweeps of the flat belt, s; its samples are 0.01 s apart."""

BETWEEN_DRIVES = 60.0
"""Pause that is put between two drives, s."""

_PRESSURE_STEP = 6894.757
"""About 1 psi, Pa. Cases were sealed with this number: the exact one would make others of the same seeds."""


@dataclass(frozen=True, eq=False)
class Sweep:
    """One sweep of a real recording, as it was recorded.

    Attributes
    ----------
    source, name : str
    load, camber, pressure : float
        Means, N, rad, Pa; NaN where the pressure was not recorded. Camber to a tenth of a degree and
        pressure to 1 psi, so that equal levels compare as equal.
    sha256 : str
        Of what was recorded: a drive's file, else time, slip angle, load and side force. What is computed
        from a recording differs in the last digits from one processor to the next, and would have another
        hash there.
    frame : pandas.DataFrame
        Canonical channels at the recording's own rate.
    """

    source: str
    name: str
    load: float
    camber: float
    pressure: float
    sha256: str
    frame: pd.DataFrame = field(repr=False)


def available(folder: Path) -> bool:
    """Whether the real recordings are there."""
    return all((folder / source).is_dir() for source in SOURCES)


@cache
def sweeps(folder: Path, source: str) -> tuple[Sweep, ...]:
    """All sweeps of one source, in its own order.

    Parameters
    ----------
    folder : Path
        Of ``recordings``.
    source : str
        One of ``SOURCES``.

    Raises
    ------
    DomainError
        The source is unknown or not there.
    """
    if source not in SOURCES or not (folder / source).is_dir():
        raise DomainError(
            f"no real recordings of {source!r} in {folder}",
            todo=f"give the folder that holds {', '.join(SOURCES)}",
        )
    return {"calspan": _calspan, "dart": _dart, "tydex": _tydex}[source](folder / source)


def pool(folder: Path, source: str, which: Pool) -> tuple[Sweep, ...]:
    """Sweeps of one source for development, or those that cases may be sealed from."""
    listed = development_list()
    found = sweeps(folder, source)
    return tuple(s for s in found if (s.sha256 in listed) == (which == "development"))


@cache
def development_list() -> Mapping[str, str]:
    """Hash to name of every sweep that thresholds were set with (``development.csv``)."""
    text = resources.files("tire_pipeline.concealed.real").joinpath(LIST).read_text(encoding="utf-8")
    return {row["sha256"]: f"{row['source']} {row['sweep']}" for row in csv.DictReader(text.splitlines())}


def fingerprint(folder: Path) -> str:
    """A hash of all sweeps that cases may be sealed from: other recordings, other cases."""
    total = hashlib.sha256()
    for source in SOURCES:
        for sweep in pool(folder, source, "sealed"):
            total.update(sweep.sha256.encode())
    return total.hexdigest()[:12]


def _sweep(source: str, name: str, frame: pd.DataFrame, recorded: bytes | None = None) -> Sweep:
    kept = frame.reset_index(drop=True)
    used = [c for c in ("time", "slip_angle", "normal_load", "fy") if c in kept]
    total = hashlib.sha256(f"{source} {name}".encode())
    if recorded is not None:
        total.update(recorded)
    else:
        for channel in used:
            total.update(np.ascontiguousarray(kept[channel], dtype="<f4").tobytes())
    pressure = float(kept["pressure"].mean()) if "pressure" in kept else float("nan")
    camber = float(kept["camber"].mean()) if "camber" in kept else 0.0
    return Sweep(
        source=source,
        name=name,
        load=float(kept["normal_load"].mean()),
        camber=float(np.radians(round(np.degrees(camber), 1))) + 0.0,
        pressure=round(pressure / _PRESSURE_STEP) * _PRESSURE_STEP if np.isfinite(pressure) else pressure,
        sha256=total.hexdigest(),
        frame=kept,
    )


def _calspan(folder: Path) -> tuple[Sweep, ...]:
    channels = [
        "time",
        "slip_angle",
        "camber",
        "normal_load",
        "speed",
        "pressure",
        "tread_temperature",
        "fy",
    ]
    out = []
    for path in sorted(folder.glob("*.mat")):
        frame = read_recording(path, axes="SAE")[channels]
        edges = np.flatnonzero(np.diff(frame["time"]) > GAP) + 1
        for number, piece in enumerate(np.split(np.arange(len(frame)), edges)):
            out.append(_sweep("calspan", f"{path.stem}:{number}", frame.iloc[piece]))
    return tuple(out)


def _dart(folder: Path) -> tuple[Sweep, ...]:
    out, end = [], 0.0
    for path in sorted(folder.rglob("*.csv"), key=lambda p: p.name):
        frame = axle_recording(read_dart(path), DART_CAR, rate=float("inf"))
        name = path.relative_to(folder).with_suffix("").as_posix()
        # Every drive has a clock of its own; on one clock they follow each other.
        frame["time"] += end - float(frame["time"].iloc[0])
        end = float(frame["time"].iloc[-1]) + BETWEEN_DRIVES
        kept = ["time", "slip_angle", "normal_load", "speed", "fy"]
        out.append(_sweep("dart", name, frame[kept], recorded=path.read_bytes()))
    return tuple(out)


def _tydex(folder: Path) -> tuple[Sweep, ...]:
    out = []
    for path in sorted(folder.glob("*.tdx")):
        frame = read_recording(path)[["slip_angle", "camber", "normal_load", "pressure", "fy"]]
        out += [
            _sweep("tydex", f"{path.stem}:{number}", frame.iloc[[number]]) for number in range(len(frame))
        ]
    return tuple(out)


__all__ = ["SOURCES", "Pool", "Sweep", "available", "development_list", "fingerprint", "pool", "sweeps"]
