"""A folder of files that are computed one by one; existing files are not computed again."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

from tire_pipeline.cluster import work_map
from tire_pipeline.datasets.storage.at_path import DatasetAtPath
from tire_pipeline.datasets.storage.files_at import Files, files_at
from tire_pipeline.datasets.text_files.text_folder import inside
from tire_pipeline.datasets.text_files.text_objects import NEVER_DELETED
from tire_pipeline.errors import DomainError
from tire_pipeline.files.added_files import AddedFiles
from tire_pipeline.files.objects import Objects
from tire_pipeline.files.packed import stored
from tire_pipeline.tasks import LostTaskError

Compute = Callable[[], bytes]


class ComputedFolderDataset(DatasetAtPath[Mapping[str, Compute], dict[str, Compute]]):
    """Saves ``{name: function that gives bytes}``: each file whole, several at a time, resumable.

    A file that exists is right, because its name must say all that it depends on (seed, settings, content,
    version of the code): put :func:`.code_hash.code_hash` into them. So a long computation that
    was interrupted, or killed, goes on where it stopped. Functions are done by the run's workers
    (:mod:`tire_pipeline.cluster`); only this process writes. Files of other names are left alone on saving
    and on loading: only those of the last save are loaded.

    Parameters
    ----------
    path : str
        The folder.
    what : str, optional
        Is said while they are computed.
    only_the_last : bool
        Delete files of other names: for results that are no longer wanted when what they depend on changes.
        :class:`.AddedFiles` functions delete none.
    metadata : dict, optional
        For kedro-viz.
    """

    _INDEX = "index.txt"
    _AGAIN = "again.txt"

    def __init__(
        self,
        *,
        path: str,
        what: str | None = None,
        only_the_last: bool = False,
        metadata: dict[str, Any] | None = None,
    ) -> None:
        super().__init__(path=path, metadata=metadata)
        self._what = what or f"computing {Path(path).name}"
        self._only_the_last = only_the_last

    def save(self, data: Mapping[str, Compute]) -> None:
        """Compute and write what is not there yet."""
        folder = files_at(self._path)
        places = {name: str(inside(name)) for name in data}
        self._forget(folder)
        there = set(folder.names())
        missing = {name: data[name] for name, place in places.items() if place not in there}
        what = self._what
        if len(missing) < len(places):
            what += f" ({len(places) - len(missing)} of {len(places)} are there already)"
        self._compute(folder, missing, places, what)
        folder.write(self._INDEX, "\n".join(data).encode("utf-8"))
        if self._only_the_last and not isinstance(data, AddedFiles):
            kept = {*places.values(), self._INDEX, self._AGAIN}
            folder.delete(name for name in there - kept if name.rsplit("/", 1)[-1] not in NEVER_DELETED)

    def _compute(
        self, folder: Files | Objects, missing: Mapping[str, Compute], places: Mapping[str, str], what: str
    ) -> None:
        lost: list[str] = []
        for done in work_map()(missing, what):
            if isinstance(done.error, LostTaskError):
                lost.append(f"{done.name}: {done.error}")
                continue
            content = done.result()
            if getattr(content, "passing", False):
                self._note(folder, done.name)
            folder.write(places[done.name], bytes(content))
        if lost:
            raise DomainError(
                f"{len(lost)} of {len(places)} could not be computed; the first: {lost[0]}",
                where=self._path,
                todo="all others are stored; run again when that is fixed",
            )

    def _forget(self, folder: Files | Objects) -> None:
        """The index goes before anything changes, and with it what counted for the last run only."""
        folder.delete([self._INDEX])
        if folder.exists(self._AGAIN):
            names = folder.read(self._AGAIN).decode("utf-8").splitlines()
            folder.delete([*(str(inside(name)) for name in names), self._AGAIN])

    def _note(self, folder: Files | Objects, name: str) -> None:
        """Before the file is there: a kill in between leaves a name too many, not one too few."""
        before = folder.read(self._AGAIN) if folder.exists(self._AGAIN) else b""
        folder.write(self._AGAIN, before + f"{name}\n".encode())

    def load(self) -> dict[str, Compute]:
        """Name to the function that reads the file, for the files of the last save."""
        folder = files_at(self._path)
        names = folder.read(self._INDEX).decode("utf-8").splitlines()
        return {name: partial(_read, folder, str(inside(name)), self._path) for name in names}

    def _exists(self) -> bool:
        return files_at(self._path).exists(self._INDEX)


def _read(folder: Files | Objects, name: str, path: str) -> bytes:
    return stored(folder.read(name), f"{path}/{name}")
