"""Where ``.tir`` files arrive: a folder, or below an address of an object store."""

from __future__ import annotations

import errno
import hashlib
import os
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Protocol

from tire_pipeline.file_names import name_on_disk, path_of, shown_name
from tire_pipeline.files.folder_walk import Found, walk
from tire_pipeline.files.objects import Objects, no_place
from tire_pipeline.files.regular_file import open_regular
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.tasks import Task
from tire_pipeline.tir import read_tir
from tire_pipeline.tir.sidecar import SUFFIX
from tire_pipeline.tir.text.decode import MOST_FILE_BYTES
from tire_pipeline.tire_table.object_files import MOST_BYTES, model_of

UNREADABLE = "cannot be read: "
"""How the fingerprint of a file begins that could not be opened: it says nothing of the content."""
_HASHED_TOGETHER = 100
"""So many objects are read at once to hash them."""


@dataclass(frozen=True, slots=True)
class Look:
    """What is told of a file and its sidecar together without reading them.

    Attributes
    ----------
    size, mtime_ns, ctime_ns : int
    stamp : str
        Of an object; files on a disk have none.
    """

    size: int
    mtime_ns: int
    ctime_ns: int
    stamp: str = ""


class Place(Protocol):
    """Where files arrive. Names are relative to it, with ``/``, escaped (:mod:`tire_pipeline.file_names`)."""

    @property
    def grows(self) -> bool:
        """Whether a file may be seen before it is whole."""
        ...

    def look(self) -> tuple[dict[str, Look], Found]:
        """Look at all ``.tir`` files, each once; and what else lies there."""
        ...

    def fingerprints(self, names: Iterable[str]) -> Iterator[tuple[str, str]]:
        """Each name and the SHA-256 of its content and its sidecar's; empty if it is gone."""
        ...

    def reading(self, name: str, digest: str) -> Task[TireModel | None]:
        """The task that reads a file; nothing if its content has another SHA-256 by then."""
        ...


def place_at(folder: str | Path | Objects, read: Callable[[str | Path], TireModel] = read_tir) -> Place:
    """The place of a path or an address.

    Parameters
    ----------
    folder : path or Objects
    read : callable
        Reads one file of a disk.
    """
    return ObjectPlace(folder) if isinstance(folder, Objects) else FolderPlace(Path(folder), read)


@dataclass(frozen=True)
class FolderPlace:
    """A folder of a local or mounted disk.

    Attributes
    ----------
    root : Path
    read : callable
        Reads one file.
    """

    root: Path
    read: Callable[[str | Path], TireModel] = read_tir
    grows = True

    def look(self) -> tuple[dict[str, Look], Found]:
        """As :meth:`Place.look`; what cannot be looked at is added to what was not seen.

        Raises
        ------
        DomainError
            The folder itself may not be read.
        """
        found = walk(self.root, _wanted)
        looks: dict[str, Look] = {}
        for name, path in found.files.items():
            if name.endswith(SUFFIX):
                continue
            try:
                stats = [os.stat(path)]
                if name + SUFFIX in found.files:
                    stats.append(os.stat(path + SUFFIX))
            except FileNotFoundError:  # gone since the folder was listed
                continue
            except OSError as error:
                found.aside[name] = f"cannot be looked at ({error.strerror})"
                found.unseen.append(name)
                continue
            looks[name] = Look(
                sum(s.st_size for s in stats),
                max(s.st_mtime_ns for s in stats),
                max(s.st_ctime_ns for s in stats),
            )
        return looks, found

    def fingerprints(self, names: Iterable[str]) -> Iterator[tuple[str, str]]:
        """As :meth:`Place.fingerprints`."""
        for name in names:
            yield name, fingerprint(path_of(self.root, name))

    def reading(self, name: str, digest: str) -> Task[TireModel | None]:
        """As :meth:`Place.reading`."""
        return partial(_read_file, self.read, path_of(self.root, name), digest)


@dataclass(frozen=True)
class ObjectPlace:
    """Objects below an address. Each is there whole or not at all, so none is waited for.

    Attributes
    ----------
    root : Objects
    """

    root: Objects
    grows = False

    def look(self) -> tuple[dict[str, Look], Found]:
        """As :meth:`Place.look`."""
        listing = self.root.listing()
        looks, aside = dict[str, Look](), dict[str, str]()
        for name, own in listing.items():
            hidden = any(part.startswith(".") for part in name.split("/"))
            if hidden or not name.lower().endswith(".tir"):
                continue
            if reason := no_place(name):
                aside[shown_name(name)] = reason
                continue
            both = [own, *([listing[name + SUFFIX]] if name + SUFFIX in listing else [])]
            written = max(round(each.written * 1e9) for each in both)
            stamp = " ".join(each.stamp for each in both)
            looks[shown_name(name)] = Look(sum(each.size for each in both), written, 0, stamp)
        return looks, Found(aside=aside)

    def fingerprints(self, names: Iterable[str]) -> Iterator[tuple[str, str]]:
        """As :meth:`Place.fingerprints`; many are read at once.

        Raises
        ------
        UnreachableError
            The store does not answer.
        """
        left = list(names)
        while left:
            some, left = left[:_HASHED_TOGETHER], left[_HASHED_TOGETHER:]
            content = self._contents([name_on_disk(name) for name in some])
            for name in some:
                yield name, _digest(*content[name_on_disk(name)])

    def _contents(self, names: list[str]) -> dict[str, list[bytes | OSError]]:
        """Content of each object and of its sidecar."""
        found = self.root.read_many([*names, *(name + SUFFIX for name in names)], MOST_BYTES)
        return {name: [found[name], found[name + SUFFIX]] for name in names}

    def reading(self, name: str, digest: str) -> Task[TireModel | None]:
        """As :meth:`Place.reading`."""
        return partial(_read_object, self, name_on_disk(name), digest)


def _wanted(name: str) -> bool:
    return name.lower().endswith((".tir", ".tir" + SUFFIX))


def fingerprint(path: str | Path) -> str:
    """SHA-256 of a file's content, and of its sidecar's where there is one; empty if it is gone.

    What cannot be opened gives no hash but a text that begins with ``UNREADABLE``. A file that grows is read
    to the size that it had when it was opened. Of a file that is too large to be a ``.tir`` file only the
    beginning and the size count.
    """
    total = hashlib.sha256()
    for each in (str(path), f"{path}{SUFFIX}"):
        try:
            with open_regular(each) as file:
                size = os.fstat(file.fileno()).st_size
                total.update(file.read(min(size, MOST_FILE_BYTES + 1)))
                if size > MOST_FILE_BYTES:
                    total.update(f"{size} bytes".encode())
        except FileNotFoundError:
            if not each.endswith(SUFFIX):
                return ""
            continue
        except OSError as error:
            if each.endswith(SUFFIX) and error.errno == errno.ENAMETOOLONG:
                continue  # no sidecar can have that name
            return f"{UNREADABLE}{error.errno} {Path(each).suffix}"
        total.update(b"\0")
    return total.hexdigest()


def _digest(content: bytes | OSError, sidecar: bytes | OSError) -> str:
    """The same hash as :func:`fingerprint`; of what is too large the beginning only counts."""
    if isinstance(content, FileNotFoundError):
        return ""
    total = hashlib.sha256()
    for each in (content, sidecar):
        if isinstance(each, FileNotFoundError):
            continue
        if isinstance(each, OSError):
            return f"{UNREADABLE}{type(each).__name__}"
        total.update(each + b"\0")
    return total.hexdigest()


def _read_file(read: Callable[[str | Path], TireModel], path: str, digest: str) -> TireModel | None:
    tire = read(path)
    return tire if fingerprint(path) == digest else None


def _read_object(place: ObjectPlace, name: str, digest: str) -> TireModel | None:
    """The model of the very bytes that have this hash."""
    content, sidecar = place._contents([name])[name]
    if _digest(content, sidecar) != digest:
        return None
    for each in (content, sidecar):
        if isinstance(each, OSError) and not isinstance(each, FileNotFoundError):
            raise each
    assert isinstance(content, bytes)
    return model_of(content, sidecar if isinstance(sidecar, bytes) else None, f"{place.root}/{name}")
