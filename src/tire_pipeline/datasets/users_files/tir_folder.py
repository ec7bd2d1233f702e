"""A folder of tire property files, one sub-folder a category."""

from __future__ import annotations

import logging
import os
from collections.abc import Callable
from dataclasses import dataclass
from itertools import islice
from typing import Any, NoReturn

from kedro_datasets.partitions import PartitionedDataset

from tire_pipeline.datasets.users_files.archives import to_unpack
from tire_pipeline.datasets.users_files.tir_file import TirDataset
from tire_pipeline.errors import DomainError, TirError
from tire_pipeline.file_names import NAMED_ONCE, shown_name
from tire_pipeline.files.folder_walk import walk
from tire_pipeline.files.growing import set_growing_aside, todo_of
from tire_pipeline.files.objects import Objects, no_place, refuse_keys
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.tir import read_tir
from tire_pipeline.tir.sidecar import SUFFIX
from tire_pipeline.tire_table.object_files import read_object
from tire_pipeline.tire_table.read_files import NAMED_IN_LOG

_LOG = logging.getLogger(__name__)


class TirFolderDataset(PartitionedDataset):
    """A ``PartitionedDataset`` of :class:`TirDataset` that says clearly when there is nothing to read.

    Files are found at any depth, ``.tir`` in any case, each once by its real path; hidden files are left out.
    What is no regular file, may not be read or is being written is among the partitions and says so when it
    is loaded: one entry never stops the rest. Names that are not UTF-8 are escaped
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
        The folder is absent or empty, or may not be read itself; or keys stand in its address.
    """

    def __init__(
        self, *, path: str, may_be_absent: bool = False, metadata: dict[str, Any] | None = None
    ) -> None:
        refuse_keys(path)
        super().__init__(path=path, dataset={"type": TirDataset}, metadata=metadata)
        self._may_be_absent = may_be_absent

    def load(self) -> dict[str, Callable[[], Any]]:
        """Partition name (``category/file.tir``) to a function that reads it."""
        partitions = self._local() if self._protocol == "file" else self._remote()
        if not partitions and not self._may_be_absent:
            what, first = self._why_empty()
            raise DomainError(
                what,
                where=self._path,
                todo=f"{first}put files into <folder>/<category>/*.tir, set tir_folder, or make a "
                "demonstration fleet with `kedro run --pipeline make_fleet`",
            )
        return partitions

    def _why_empty(self) -> tuple[str, str]:
        """What is there in place of .tir files, and what to do about that."""
        if self._protocol != "file" or os.path.isdir(self._path):
            return "there are no .tir files below this folder", to_unpack(self._path)
        if os.path.lexists(self._path):
            return "there are no .tir files: this is no folder", "name the folder that holds your files; or "
        return "there are no .tir files: there is no such folder", ""

    def _local(self) -> dict[str, Callable[[], Any]]:
        if not os.path.isdir(self._path):
            return {}
        found = walk(self._path, _is_tir)
        set_growing_aside(found)
        for name, other in islice(found.again.items(), NAMED_IN_LOG):
            _LOG.info("%s is a link to %s, which is taken already.", name, other, extra={NAMED_ONCE: name})
        if (more := len(found.again) - NAMED_IN_LOG) > 0:
            about = {NAMED_ONCE: f"{self._path}: links"}
            _LOG.info("%d more links lead to what is taken already.", more, extra=about)
        partitions: dict[str, Callable[[], Any]] = {
            name: TirLoader(path) for name, path in found.files.items()
        }
        if not found.aside:
            return partitions
        for name, reason in found.aside.items():
            partitions[name] = Refused(os.path.join(self._path, name), reason)
        return dict(sorted(partitions.items()))

    def _remote(self) -> dict[str, Callable[[], Any]]:
        folder = Objects(self._path)
        stamps = folder.stamps()
        found: dict[str, Callable[[], Any]] = {}
        for name, stamp in stamps.items():
            if _is_tir(name) and not any(part.startswith(".") for part in name.split("/")):
                reason = no_place(name)
                sidecar = stamps.get(name + SUFFIX)
                load = ObjectLoader(folder, name, stamp, sidecar)
                found[shown_name(name)] = Refused(f"{folder}/{name}", reason) if reason else load
        return found

    def save(self, data: dict[str, Any]) -> None:
        """Refuse: the files are the user's."""
        raise DomainError("files of the user are never changed", where=self._path)

    def _describe(self) -> dict[str, Any]:
        return {"path": self._path, "may_be_absent": self._may_be_absent}

    def __repr__(self) -> str:
        return f"TirFolderDataset(path={self._path!r})"


def _is_tir(name: str) -> bool:
    return name.lower().endswith(".tir")


@dataclass(frozen=True, slots=True)
class TirLoader:
    """Reads one file; a run holds one for each of its files, so it is small.

    Attributes
    ----------
    path : str
    """

    path: str

    def __call__(self) -> TireModel:
        """The model."""
        return read_tir(self.path)

    def fingerprint(self) -> str:
        """Changes when the file or its sidecar does: size, dates and inode, without opening it."""
        return " ".join(map(_look, (self.path, f"{self.path}.sidecar.json")))


@dataclass(frozen=True)
class ObjectLoader:
    """Reads one file from an object store.

    Attributes
    ----------
    folder : Objects
    name, stamp : str
        Of the object.
    sidecar : str or None
        Stamp of its sidecar.
    """

    folder: Objects
    name: str
    stamp: str
    sidecar: str | None

    def __call__(self) -> TireModel:
        """The model."""
        return read_object(self.folder, self.name, sidecar=self.sidecar is not None)

    def fingerprint(self) -> str:
        """Changes when the object or its sidecar does."""
        return f"{self.stamp} {self.sidecar}"


@dataclass(frozen=True)
class Refused:
    """Stands for an entry that is no file to read.

    Attributes
    ----------
    path, reason : str
    """

    path: str
    reason: str

    def __call__(self) -> NoReturn:
        """Say why."""
        todo = todo_of(self.reason, "take it out, or put a .tir file there")
        raise TirError(self.reason, path=self.path, todo=todo)

    def fingerprint(self) -> str:
        """The reason."""
        return self.reason


def _look(path: str) -> str:
    try:
        found = os.stat(path)
    except OSError as error:
        return f"errno {error.errno}"
    return f"{found.st_size}/{found.st_mtime_ns}/{found.st_ctime_ns}/{found.st_ino}"
