"""A folder of text files that is written whole or not at all."""

from __future__ import annotations

import contextlib
import hashlib
import os
import shutil
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import Any

from tire_pipeline.datasets.storage.at_path import DatasetAtPath
from tire_pipeline.datasets.text_files import text_objects
from tire_pipeline.datasets.text_files.text_objects import (
    MARKER,
    MARKER_HEAD,
    NEVER_DELETED,
    Content,
    StoredTexts,
    as_bytes,
    parted,
)
from tire_pipeline.errors import DomainError
from tire_pipeline.files.added_files import AddedFiles
from tire_pipeline.files.atomic import replaced_folder
from tire_pipeline.files.folder_walk import holds_anything
from tire_pipeline.files.objects import Objects, is_remote
from tire_pipeline.progress import track

_LONGEST_NAME = 255


class TextFolderDataset(DatasetAtPath[Mapping[str, Content | None], Mapping[str, bytes]]):
    """Saves ``{relative path: text, or a function that gives it}`` as files; loads them one by one.

    The folder is replaced whole. With ``keep``, or if the texts are :class:`.AddedFiles`, what earlier runs
    made stays beside what is new; ``None`` instead of a text then takes the file of an earlier run away. A
    folder that holds anything this project did not make is never touched.

    Parameters
    ----------
    path : str
        The folder.
    suffix : str
        Only files with this ending are loaded.
    keep : bool
        Keep files of earlier runs until the user removes them.
    metadata : dict, optional
        For kedro-viz.
    """

    def __init__(
        self, *, path: str, suffix: str = "", keep: bool = False, metadata: dict[str, Any] | None = None
    ) -> None:
        super().__init__(path=path, metadata=metadata)
        self._suffix = suffix
        self._keep = keep

    def load(self) -> Mapping[str, bytes]:
        """Every file as bytes, read when it is asked for; an absent folder has none."""
        if is_remote(self._path):
            return text_objects.load(Objects(self._path), self._suffix, keep=self._keep)
        folder = Path(self._path)
        files = sorted(p for p in folder.rglob(f"*{self._suffix}") if p.is_file())
        return StoredTexts(
            {p.relative_to(folder).as_posix(): p.read_bytes for p in files if p.name != MARKER}
        )

    @property
    def empty(self) -> bool:
        """Whether this project has put nothing there."""
        return not made_at(self._path)

    def check(self) -> None:
        """Refuse, before any work is done, a folder that belongs to the user."""
        if is_remote(self._path):
            objects = Objects(self._path)
            where, foreign = str(objects), text_objects.belongs_to_user(objects)
        else:
            folder = Path(self._path)
            where, foreign = str(folder), _belongs_to_user(folder)
        if foreign:
            raise DomainError(
                "this folder holds files that were not made by this project",
                where=where,
                todo="move them elsewhere (or set another folder); they are never overwritten",
            )

    def save(self, data: Mapping[str, Content | None]) -> None:
        """Write all files, or none."""
        self.check()
        keep = self._keep or isinstance(data, AddedFiles)
        if is_remote(self._path):
            texts, gone = parted({str(inside(name)): text for name, text in data.items()}, keep=keep)
            text_objects.save(Objects(self._path), texts, gone=gone, keep=keep)
            return
        folder = Path(self._path)
        with replaced_folder(folder) as temporary:
            made = _NamesOnDisk()
            if keep and folder.exists():
                shutil.copytree(folder, temporary, copy_function=_linked, dirs_exist_ok=True)
                made.add_all(_names_of_marker(folder))
            for name, text in track(data.items(), f"writing {folder.name}", total=len(data)):
                _write_or_remove(temporary, str(inside(name)), text, made, keep=keep)
            for name in NEVER_DELETED:
                if (folder / name).exists() and not (temporary / name).exists():
                    shutil.copy2(folder / name, temporary / name)
            (temporary / MARKER).unlink(missing_ok=True)
            with (temporary / MARKER).open("w", encoding="utf-8", newline="\n") as marker:
                marker.write(f"{MARKER_HEAD}\n")
                marker.writelines(f"{name}\n" for name in made)

    def _describe(self) -> dict[str, Any]:
        return {"path": self._path, "suffix": self._suffix}


def _belongs_to_user(folder: Path) -> bool:
    return not (folder / MARKER).exists() and holds_anything(folder, but=NEVER_DELETED)


def made_here(folder: Path) -> set[str]:
    """Paths, relative to a folder, of the files that this project has put there; read from its marker."""
    return set(_names_of_marker(folder))


def _names_of_marker(folder: Path) -> Iterator[str]:
    marker = folder / MARKER
    if marker.is_file():
        with marker.open(encoding="utf-8", errors="replace", newline="\n") as lines:
            next(lines, None)
            yield from (line.removesuffix("\n") for line in lines)


def _linked(source: str, target: str) -> None:
    """Put a file of an earlier run at another place, too; a copy where the file system has no hard links."""
    if not os.path.islink(source):
        with contextlib.suppress(OSError):
            os.link(source, target)
            return
    shutil.copy2(source, target)


def _write_or_remove(
    folder: Path, name: str, text: Content | None, made: _NamesOnDisk, *, keep: bool
) -> None:
    """Write a text; where it is None, take the file of an earlier run away, if there is one."""
    target = folder / name
    if text is not None:
        target.parent.mkdir(parents=True, exist_ok=True)
        target.unlink(missing_ok=True)  # never into the file of the old folder, which this one may be
        target.write_bytes(as_bytes(text))
        made.add_all([name])
        return
    if not keep:
        raise TypeError(f"there is nothing to encode for {name!r}")
    if made.removed(name):
        target.unlink(missing_ok=True)


class _NamesOnDisk:
    """Names of files, each once: those of a million files are not in memory."""

    def __init__(self) -> None:
        from tire_pipeline.files.rows_on_disk import RowsOnDisk  # loads pandas, which no run starts with

        self._rows = RowsOnDisk(["name"])
        self._rows.do("create unique index by_name on rows (name)")

    def add_all(self, names: Iterable[str]) -> None:
        for name in names:
            self._rows.do("insert or ignore into rows values (?)", (name,))

    def removed(self, name: str) -> bool:
        """Take a name out; whether it was there."""
        return self._rows.do("delete from rows where name = ?", (name,)).rowcount > 0

    def __iter__(self) -> Iterator[str]:
        """Sorted."""
        return (name for (name,) in self._rows.do("select name from rows order by name"))


def made_at(path: str) -> set[str]:
    """Return the same of a folder or an object store, by its address."""
    return text_objects.made_there(Objects(path)) if is_remote(path) else made_here(Path(path))


def inside(name: str) -> PurePosixPath:
    """The place below a folder for a file of this name, as the file system takes it.

    Raises
    ------
    DomainError
        It lies outside of the folder.
    """
    path = PurePosixPath(name)
    if path.is_absolute() or ".." in path.parts:
        raise DomainError(f"{name!r} would be written outside of its folder")
    return PurePosixPath(*map(_fitting, path.parts))


def _fitting(name: str) -> str:
    """A name that a file system takes: one over 255 bytes (an escaped one can be) ends in its hash."""
    if len(name.encode()) <= _LONGEST_NAME:
        return name
    suffix = "".join(PurePosixPath(name).suffixes)[-40:]
    digest = hashlib.sha256(name.encode()).hexdigest()[:16]
    kept = name.encode()[: _LONGEST_NAME - len(digest) - 1 - len(suffix.encode())].decode(errors="ignore")
    return f"{kept}-{digest}{suffix}"
