"""A folder of tire property files, one sub-folder a category."""

from __future__ import annotations

import logging
import os
from collections.abc import Callable
from functools import partial
from typing import Any, NoReturn

from kedro_datasets.partitions import PartitionedDataset

from tire_pipeline.datasets.tir_file import TirDataset
from tire_pipeline.errors import DomainError, TirError
from tire_pipeline.folder_walk import walk
from tire_pipeline.tir import read_tir

_LOG = logging.getLogger(__name__)


class TirFolderDataset(PartitionedDataset):
    """A ``PartitionedDataset`` of :class:`TirDataset` that says clearly when there is nothing to read.

    Files are found at any depth, ``.tir`` in any case, each once by its real path; hidden files are left out.
    What is no regular file, or may not be read, is among the partitions and says so when it is loaded: one
    entry never stops the rest. Names that are not UTF-8 are escaped
    (:func:`tire_pipeline.file_names.shown_name`). It never writes.

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
        The folder is absent or empty, or may not be read itself.
    """

    def __init__(
        self, *, path: str, may_be_absent: bool = False, metadata: dict[str, Any] | None = None
    ) -> None:
        super().__init__(path=path, dataset={"type": TirDataset}, metadata=metadata)
        self._may_be_absent = may_be_absent

    def _list_partitions(self) -> list[str]:
        if self._cached_partitions is None:
            found = self._filesystem.find(self._normalized_path)
            self._cached_partitions = sorted(p for p in found if _is_tir(p))
        return self._cached_partitions

    def load(self) -> dict[str, Callable[[], Any]]:
        """Partition name (``category/file.tir``) to a function that reads it."""
        partitions = self._local() if self._protocol == "file" else self._remote()
        if not partitions and not self._may_be_absent:
            raise DomainError(
                "there are no .tir files below this folder",
                where=self._path,
                todo="put files into <folder>/<category>/*.tir, set tir_folder, or make a "
                "demonstration fleet with `kedro run --pipeline make_fleet`",
            )
        return partitions

    def _local(self) -> dict[str, Callable[[], Any]]:
        if not os.path.isdir(self._path):
            return {}
        found = walk(self._path, _is_tir)
        for name, other in found.again.items():
            _LOG.info("%s is a link to %s, which is taken already.", name, other)
        partitions: dict[str, Callable[[], Any]] = {
            name: partial(read_tir, path) for name, path in found.files.items()
        }
        for name, reason in found.aside.items():
            partitions[name] = partial(_refuse, os.path.join(self._path, name), reason)
        return dict(sorted(partitions.items()))

    def _remote(self) -> dict[str, Callable[[], Any]]:
        self._invalidate_caches()
        return {
            self._path_to_partition(path): TirDataset(filepath=self._join_protocol(path)).load
            for path in self._list_partitions()
        }

    def save(self, data: dict[str, Any]) -> None:
        """Refuse: the files are the user's."""
        raise DomainError("files of the user are never changed", where=self._path)

    def _describe(self) -> dict[str, Any]:
        return {"path": self._path, "may_be_absent": self._may_be_absent}

    def __repr__(self) -> str:
        return f"TirFolderDataset(path={self._path!r})"


def _is_tir(name: str) -> bool:
    return name.lower().endswith(".tir")


def _refuse(path: str, reason: str) -> NoReturn:
    raise TirError(reason, path=path, todo="take it out, or put a .tir file there")
