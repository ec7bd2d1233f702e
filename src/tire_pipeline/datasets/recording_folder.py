"""A folder of recordings, each with the .tir file that should have predicted it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any, NoReturn

import pandas as pd
from kedro.io.core import AbstractDataset

from tire_pipeline.errors import DomainError, RecordingError
from tire_pipeline.folder_walk import walk
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.recordings import read_recording
from tire_pipeline.recordings.read import SUFFIXES
from tire_pipeline.tir import read_tir

Pair = tuple[TireModel | None, pd.DataFrame]


class RecordingFolderDataset(AbstractDataset[None, dict[str, Callable[[], Pair]]]):
    """Gives every recording below a folder, with its tire; it never writes.

    The tire is the ``.tir`` of the same name, else the only one in the same folder; the function takes
    another one, and ``axes``, ``units`` and ``names`` as :func:`tire_pipeline.recordings.read_recording`. A
    recording with a ``simulated_fy`` (or ``simulated_fx``) column needs no tire.

    Parameters
    ----------
    path : str
        The folder.
    metadata : dict, optional
        For kedro-viz.

    Raises
    ------
    DomainError
        If there is no recording below the folder.
    """

    def __init__(self, *, path: str, metadata: dict[str, Any] | None = None) -> None:
        self._path = path
        self.metadata = metadata

    def load(self) -> dict[str, Callable[[], Pair]]:
        """Relative path of each recording to the function that reads it and its tire."""
        found = walk(self._path, lambda name: Path(name).suffix.lower() in SUFFIXES)
        recordings: dict[str, Callable[[], Pair]] = {
            name: partial(read_pair, Path(path), root=Path(self._path)) for name, path in found.files.items()
        }
        for name, reason in found.aside.items():
            recordings[name] = partial(_refuse, str(Path(self._path, name)), reason)
        if not recordings:
            raise DomainError(
                "there are no recordings below this folder",
                where=self._path,
                todo="put <name>/recording.csv and <name>/model.tir there; its README says what is read",
            )
        return dict(sorted(recordings.items()))

    def save(self, data: None) -> None:
        """Refuse: the recordings are the user's."""
        raise DomainError("recordings of the user are never changed", where=self._path)

    def _exists(self) -> bool:
        return Path(self._path).exists()

    def _describe(self) -> dict[str, Any]:
        return {"path": self._path}


def read_pair(
    path: Path,
    *,
    root: Path | None = None,
    tir: str = "",
    axes: str | None = None,
    units: Mapping[str, str] | None = None,
    names: Mapping[str, str] | None = None,
) -> Pair:
    """Read a recording and the tire that belongs to it.

    Parameters
    ----------
    path : Path
        The recording.
    root : Path, optional
        The folder of all recordings.
    tir : str
        The tire's file, relative to the recording's folder or to ``root``; by the rule above if empty.
    axes, units, names
        As for :func:`tire_pipeline.recordings.read_recording`.

    Returns
    -------
    tire : TireModel or None
    recording : DataFrame

    Raises
    ------
    RecordingError, TirError
        If one of them cannot be read, or it is not clear which tire belongs to the recording.
    """
    recording = read_recording(path, axes=axes, units=units, names=names)
    if tir:
        places = [path.parent / tir, (root or path.parent) / tir]
        stated = next((place for place in places if place.is_file()), None)
        if stated is None:
            raise RecordingError(
                f"the .tir file that belongs to it is not there: {tir}",
                where=str(path),
                todo="give it relative to the recording's folder, or to that of all recordings",
            )
        return read_tir(stated), recording
    tirs = sorted(p for p in path.parent.iterdir() if p.suffix.lower() == ".tir" and p.is_file())
    same = [p for p in tirs if p.stem == path.stem]
    chosen = same or tirs
    if len(chosen) == 1:
        return read_tir(chosen[0]), recording
    if not chosen and {"simulated_fx", "simulated_fy"} & set(recording.columns):
        return None, recording
    raise RecordingError(
        f"{len(chosen)} .tir files could belong to this recording",
        where=str(path),
        todo=f"put one .tir beside it, or name it {path.stem}.tir",
    )


def _refuse(path: str, reason: str, **_: object) -> NoReturn:
    raise RecordingError(reason, where=path, todo="take it out, or put a recording there")
