"""A folder of tire property files, one sub-folder a category."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from kedro_datasets.partitions import PartitionedDataset

from tire_pipeline.datasets.tir_file import TirDataset
from tire_pipeline.errors import DomainError


class TirFolderDataset(PartitionedDataset):
    """A ``PartitionedDataset`` of :class:`TirDataset` that says clearly when there is nothing to read.

    Files are found at any depth, ``.tir`` in any case; hidden files are left out. It never writes.

    Parameters
    ----------
    path : str
        The folder.
    may_be_absent : bool
        An absent or empty folder loads as an empty dictionary instead of an error.
    metadata : dict, optional
        For kedro-viz.

    Raises
    ------
    DomainError
        The folder is absent, empty, or a part of it may not be read.
    """

    def __init__(
        self, *, path: str, may_be_absent: bool = False, metadata: dict[str, Any] | None = None
    ) -> None:
        super().__init__(path=path, dataset={"type": TirDataset}, metadata=metadata)
        self._may_be_absent = may_be_absent

    def _list_partitions(self) -> list[str]:
        if self._cached_partitions is None:
            if self._protocol == "file":
                found = _walk(Path(self._path))
            else:
                found = self._filesystem.find(self._normalized_path)
            self._cached_partitions = sorted(p for p in found if p.lower().endswith(".tir"))
        return self._cached_partitions

    def load(self) -> dict[str, Callable[[], Any]]:
        """Partition name (``category/file.tir``) to a function that reads it."""
        self._invalidate_caches()
        partitions: dict[str, Callable[[], Any]] = {}
        for path in self._list_partitions():
            dataset = TirDataset(filepath=self._join_protocol(path))
            partitions[self._path_to_partition(path)] = dataset.load
        if not partitions and not self._may_be_absent:
            raise DomainError(
                "there are no .tir files below this folder",
                where=self._path,
                todo="put files into <folder>/<category>/*.tir, set tir_folder, or make a "
                "demonstration fleet with `kedro run --pipeline make_fleet`",
            )
        return partitions

    def save(self, data: dict[str, Any]) -> None:
        """Refuse: the files are the user's."""
        raise DomainError("files of the user are never changed", where=self._path)

    def _describe(self) -> dict[str, Any]:
        return {"path": self._path, "may_be_absent": self._may_be_absent}

    def __repr__(self) -> str:
        return f"TirFolderDataset(path={self._path!r})"


def _walk(folder: Path) -> list[str]:
    def stop(error: OSError) -> None:
        if isinstance(error, FileNotFoundError):
            return
        raise DomainError(
            f"this folder may not be read ({error.strerror})",
            where=str(error.filename),
            todo="allow reading it, or take it out of the folder of .tir files",
        ) from error

    found = []
    for root, folders, files in os.walk(folder.absolute(), onerror=stop, followlinks=True):
        folders[:] = sorted(each for each in folders if not each.startswith("."))
        found += [os.path.join(root, file) for file in files if not file.startswith(".")]
    return found
