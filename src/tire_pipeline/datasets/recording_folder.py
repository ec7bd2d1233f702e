"""A folder of recordings, each with the .tir file that should have predicted it."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import pandas as pd
from kedro.io.core import AbstractDataset

from tire_pipeline.errors import DomainError, RecordingError
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.recordings import read_recording
from tire_pipeline.recordings.read import SUFFIXES
from tire_pipeline.tir import read_tir

Pair = tuple[TireModel | None, pd.DataFrame]


class RecordingFolderDataset(AbstractDataset[None, dict[str, Callable[[], Pair]]]):
    """Gives every recording below a folder, with its tire; it never writes.

    The tire is the ``.tir`` of the same name, else the only one in the same folder. A recording with a
    ``simulated_fy`` (or ``simulated_fx``) column needs none.

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
        folder = Path(self._path)
        found = sorted(p for p in folder.rglob("*") if p.is_file() and p.suffix.lower() in SUFFIXES)
        if not found:
            raise DomainError(
                "there are no recordings below this folder",
                where=self._path,
                todo="put <name>/recording.csv and <name>/model.tir there; its README says what is read",
            )
        return {str(p.relative_to(folder).as_posix()): partial(read_pair, p) for p in found}

    def save(self, data: None) -> None:
        """Refuse: the recordings are the user's."""
        raise DomainError("recordings of the user are never changed", where=self._path)

    def _exists(self) -> bool:
        return Path(self._path).exists()

    def _describe(self) -> dict[str, Any]:
        return {"path": self._path}


def read_pair(path: Path) -> Pair:
    """Read a recording and the tire that belongs to it.

    Parameters
    ----------
    path : Path
        The recording.

    Returns
    -------
    tire : TireModel or None
    recording : DataFrame

    Raises
    ------
    RecordingError, TirError
        If one of them cannot be read, or it is not clear which tire belongs to the recording.
    """
    recording = read_recording(path)
    tirs = sorted(p for p in path.parent.iterdir() if p.suffix.lower() == ".tir")
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
