"""A folder of recordings, each with the .tir file that should have predicted it."""

from __future__ import annotations

import hashlib
import json
import os
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path, PurePosixPath
from typing import Any, NoReturn

import pandas as pd

from tire_pipeline.datasets.storage.at_path import DatasetAtPath
from tire_pipeline.datasets.users_files.archives import to_unpack
from tire_pipeline.errors import DomainError, RecordingError, TirePipelineError
from tire_pipeline.file_names import shown_name
from tire_pipeline.files.folder_walk import walk
from tire_pipeline.files.growing import set_growing_aside, todo_of
from tire_pipeline.files.objects import Objects, is_remote, no_place
from tire_pipeline.files.regular_file import no_regular_file, open_regular
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.recordings import read_recording
from tire_pipeline.recordings.read import SUFFIXES
from tire_pipeline.recordings.readers.limits import most_bytes, too_large
from tire_pipeline.tir import read_tir
from tire_pipeline.tir.text.decode import MOST_FILE_BYTES

_PART_BYTES = 1 << 20
Pair = tuple[TireModel | None, pd.DataFrame]


class RecordingFolderDataset(DatasetAtPath[None, dict[str, Callable[[], Pair]]]):
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

    def load(self) -> dict[str, Callable[[], Pair]]:
        """Relative path of each recording to the function that reads it and its tire."""
        if is_remote(self._path):
            return self._checked(_on_objects(Objects(self._path)))
        found = walk(self._path, lambda name: Path(name).suffix.lower() in SUFFIXES)
        set_growing_aside(found)
        recordings: dict[str, Callable[[], Pair]] = {
            name: RecordingLoader(Path(path), Path(self._path)) for name, path in found.files.items()
        }
        for name, reason in found.aside.items():
            recordings[name] = partial(_refuse, str(Path(self._path, name)), reason)
        return self._checked(recordings)

    def _checked(self, recordings: dict[str, Callable[..., Pair]]) -> dict[str, Callable[..., Pair]]:
        if not recordings:
            raise DomainError(
                "there are no recordings below this folder",
                where=self._path,
                todo=f"{to_unpack(self._path)}put <name>/recording.csv and <name>/model.tir there; "
                "docs/reference/recordings.md says what is read",
            )
        return dict(sorted(recordings.items()))

    def save(self, data: None) -> None:
        """Refuse: the recordings are the user's."""
        raise DomainError("recordings of the user are never changed", where=self._path)


@dataclass(frozen=True)
class RecordingLoader:
    """Reads one recording and its tire.

    Attributes
    ----------
    path, root : Path
        The recording, and the folder of all recordings.
    """

    path: Path
    root: Path

    def __call__(self, **how: Any) -> Pair:
        """As :func:`read_pair`."""
        return read_pair(self.path, root=self.root, **how)

    def fingerprint(self, tir: str = "") -> str:
        """A hash of the contents of the recording and of all models that could belong to it.

        Parameters
        ----------
        tir : str
            As for :func:`read_pair`.
        """
        stated = [self.path.parent / tir, self.root / tir] if tir else []
        total = hashlib.sha256()
        try:
            beside = _named_tir(self.path.parent)
        except OSError as error:  # reading the recording says so, and stops no other one
            beside = []
            total.update(f"errno {error.errno}".encode())
        total.update(_content_hash(self.path, most_bytes()).encode())
        for path in (*stated, *beside):
            for each in (path, Path(f"{path}.sidecar.json")):
                content = _content_hash(each, MOST_FILE_BYTES)
                total.update(f"{each.name}\0{content}\0".encode(errors="surrogateescape"))
        return total.hexdigest()


@dataclass(frozen=True)
class ObjectRecording:
    """Reads one recording and its tire from an object store: copied to this machine, read, deleted.

    Attributes
    ----------
    folder : Objects
        Of all recordings.
    name : str
        Of the recording.
    stamps : tuple of (str, str)
        Name and stamp of the recording and of all models that could belong to it.
    """

    folder: Objects
    name: str
    stamps: tuple[tuple[str, str], ...]

    def __call__(self, **how: Any) -> Pair:
        """As :func:`read_pair`."""
        with tempfile.TemporaryDirectory() as copy:
            root = Path(copy)
            for name, _ in self.stamps:
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_bytes(self.folder.read(name))
            try:
                tire, recording = read_pair(root / self.name, root=root, **how)
            except TirePipelineError as error:
                error.where = str(error.where or "").replace(copy, str(self.folder))
                raise
            if tire is not None:
                tire = replace(tire, path=str(tire.path).replace(copy, str(self.folder)))
        return tire, recording

    def fingerprint(self, tir: str = "") -> str:
        """Changes when the recording or a model does."""
        return json.dumps([*self.stamps, tir])


def _on_objects(folder: Objects) -> dict[str, Callable[..., Pair]]:
    listing = folder.listing()
    tirs = [name for name in listing if name.lower().endswith((".tir", ".tir.sidecar.json"))]
    found: dict[str, Callable[..., Pair]] = {}
    for name, own in listing.items():
        place = PurePosixPath(name)
        if place.suffix.lower() not in SUFFIXES or any(part.startswith(".") for part in place.parts):
            continue
        if reason := no_place(name) or too_large(own.size):
            found[shown_name(name)] = partial(_refuse, f"{folder}/{name}", reason)
            continue
        near = [each for each in tirs if PurePosixPath(each).parent in (place.parent, PurePosixPath("."))]
        near = [each for each in near if not no_place(each) and listing[each].size <= MOST_FILE_BYTES]
        stamps = tuple((each, listing[each].stamp) for each in [name, *near])
        found[shown_name(name)] = ObjectRecording(folder, name, stamps)
    return found


def _content_hash(path: Path, most: float) -> str:
    """Of a file as large as it was when it was opened; one that is too large to be read is not read here."""
    total = hashlib.sha256()
    try:
        with open_regular(path) as file:
            left = os.fstat(file.fileno()).st_size
            if left > most:
                return f"{left} bytes"
            while left > 0 and (part := file.read(min(left, _PART_BYTES))):
                total.update(part)
                left -= len(part)
    except OSError as error:
        return f"errno {error.errno}"
    return total.hexdigest()


def read_pair(
    path: Path,
    *,
    root: Path | None = None,
    tir: str = "",
    axes: str | None = None,
    units: Mapping[str, str] | None = None,
    names: Mapping[str, str | float] | None = None,
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
                f"the stated .tir file does not exist: {tir}",
                where=str(path),
                todo="state its path relative to the recording's folder or to the folder of all recordings",
            )
        return read_tir(stated), recording
    tirs = _tirs_beside(path)
    same = [p for p in tirs if p.stem == path.stem]
    chosen = same or tirs
    if len(chosen) == 1:
        return read_tir(chosen[0]), recording
    if not chosen and {"simulated_fx", "simulated_fy"} & set(recording.columns):
        return None, recording
    raise RecordingError(
        f"{len(chosen)} .tir files could belong to this recording"
        if chosen
        else "no .tir file lies beside this recording",
        where=str(path),
        todo=f"put one .tir beside it, or name it {path.stem}.tir",
    )


def _named_tir(folder: Path) -> list[Path]:
    """Entries of a folder that are called as a ``.tir`` file is."""
    return sorted(each for each in folder.iterdir() if each.suffix.lower() == ".tir")


def _tirs_beside(recording: Path) -> list[Path]:
    """Models beside a recording; also those that may not be looked at, which say so when they are read."""
    try:
        return [each for each in _named_tir(recording.parent) if _may_be_file(each)]
    except OSError as error:
        raise RecordingError(
            f"its folder may not be listed ({error.strerror}), so no .tir file is found",
            where=str(recording),
            todo="allow listing it, or state the recording's .tir file",
        ) from error


def _may_be_file(path: Path) -> bool:
    try:
        return not no_regular_file(path)
    except OSError:
        return True


def _refuse(path: str, reason: str, **_: object) -> NoReturn:
    todo = todo_of(reason, "take it out, or put a recording there")
    raise RecordingError(reason, where=path, todo=todo)
