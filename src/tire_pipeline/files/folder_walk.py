"""All files below a folder, each once, and what else is in it."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Callable, Collection
from dataclasses import dataclass, field

from tire_pipeline.errors import DomainError
from tire_pipeline.file_names import shown_name
from tire_pipeline.files.regular_file import LINK_TO_ITSELF, other_kind


@dataclass
class Found:
    """What lies below a folder. Names are relative to it, with ``/``, as :func:`shown_name` gives them.

    Attributes
    ----------
    files : dict
        Name -> path to open.
    aside : dict
        Name -> why it is not among the files.
    again : dict
        Links to what is among the files already -> to what.
    unseen : list of str
        Names of folders (ending in ``/``) and files that could not be looked at: whether what lay there
        is still there cannot be told.
    """

    files: dict[str, str] = field(default_factory=dict)
    aside: dict[str, str] = field(default_factory=dict)
    again: dict[str, str] = field(default_factory=dict)
    unseen: list[str] = field(default_factory=list)

    def may_be_there(self, name: str) -> bool:
        """Whether a file that is not among the files may still be there."""
        return any(name == each or (each.endswith("/") and name.startswith(each)) for each in self.unseen)


def walk(folder: str | os.PathLike[str], wanted: Callable[[str], bool]) -> Found:
    """Find the regular files below a folder by their real paths, each once.

    Hidden files and folders are left out. A file that is reached in several ways has the name without
    links, else the first of those by links. Nothing is opened.

    Parameters
    ----------
    folder : path
    wanted : callable
        Of a file's name. Entries that are no regular files are named only if it wants them, folders and
        links that lead nowhere always.

    Returns
    -------
    Found
        ``files`` sorted by name.

    Raises
    ------
    DomainError
        The folder itself does not exist or may not be read.
    """
    search = _Search(os.path.abspath(folder), wanted)
    search.go_into(search.root)
    while search.folder_links:  # links found below links come after them
        search.follow(search.folder_links.pop(min(search.folder_links)))
    search.add_linked_files()
    found = search.found
    search.real_files.clear()
    found.files = dict(sorted(found.files.items()))
    return found


def holds_anything(folder: str | os.PathLike[str], *, but: Collection[str] = ()) -> bool:
    """Whether anything but folders lies below a folder: files, links, FIFOs..., or what may not be looked at.

    Parameters
    ----------
    folder : path
        It may be absent.
    but : collection of str
        Names of files that do not count.
    """
    left = [os.fspath(folder)]
    while left:
        try:
            with os.scandir(left.pop()) as entries:
                for entry in entries:
                    if entry.is_dir(follow_symlinks=False):
                        left.append(entry.path)
                    elif entry.name not in but:
                        return True
        except FileNotFoundError:
            continue
        except OSError:
            return True
    return False


class _Search:
    def __init__(self, root: str, wanted: Callable[[str], bool]) -> None:
        real = os.path.realpath(root)
        self.root = _WalkedEntry("", root, real)
        self.above = {real[: at or 1] for at, letter in enumerate(real) if letter == os.sep}
        self.wanted = wanted
        self.found = Found()
        self.entered: dict[str, str] = {}  # real path of a folder -> its name
        self.folder_links: dict[str, _WalkedEntry] = {}
        self.file_links: dict[str, str] = {}  # name -> path
        self.real_files: dict[str, str] = {}  # real path -> name

    def go_into(self, place: _WalkedEntry) -> None:
        """Take a folder and all below it that is reached without links."""
        left = [place]
        while left:
            here = left.pop()
            if here.real in self.entered:
                continue
            self.entered[here.real] = here.name
            try:
                with os.scandir(here.path) as listing:
                    entries = list(listing)
            except OSError as error:
                self._closed(here, error)
                continue
            for entry in entries:
                if not entry.name.startswith("."):
                    left += self._entry(here, entry)

    def _entry(self, here: _WalkedEntry, entry: os.DirEntry[str]) -> list[_WalkedEntry]:
        inner = here.inner(entry.name)
        try:
            if entry.is_symlink():
                self._link(inner, entry.name)
            elif entry.is_dir(follow_symlinks=False):
                return [inner.as_folder()]
            elif self.wanted(entry.name):
                if entry.is_file(follow_symlinks=False):
                    self.found.files[inner.name] = inner.path
                    self.real_files[inner.real] = inner.name
                else:
                    self._not_regular(inner, entry.stat(follow_symlinks=False).st_mode)
        except FileNotFoundError:  # gone since the folder was listed
            pass
        except OSError as error:
            self._unknown(inner, error)
        return []

    def _link(self, inner: _WalkedEntry, name: str) -> None:
        try:
            mode = os.stat(inner.path).st_mode
        except FileNotFoundError:
            self.found.aside[inner.name] = "a link that leads nowhere"
        except OSError as error:
            if error.errno != errno.ELOOP:
                raise
            self.found.aside[inner.name] = LINK_TO_ITSELF
        else:
            if stat.S_ISDIR(mode):
                self.folder_links[inner.name] = inner
            elif self.wanted(name):
                if not other_kind(mode):
                    self.file_links[inner.name] = inner.path
                else:
                    self._not_regular(inner, mode)

    def follow(self, link: _WalkedEntry) -> None:
        """Take what lies behind a link to a folder, unless it is taken already."""
        real = os.path.realpath(link.path)
        if real in self.entered:
            self.found.again[link.name] = self.entered[real] or "./"
        elif real in self.above:
            self.found.aside[link.name] = "a link to a folder above this one"
        elif own := self._unlisted(real):
            self.found.again[link.name] = own + "/"
            self.go_into(_WalkedEntry(own + "/", real, real))
        else:
            self.go_into(_WalkedEntry(link.name + "/", link.path, real))

    def add_linked_files(self) -> None:
        """Take files that are reached by a link alone."""
        for name in sorted(self.file_links):
            path = self.file_links[name]
            real = os.path.realpath(path)
            own = self._unlisted(real)
            other = self.real_files.setdefault(real, own or name)
            if other == name:
                self.found.files[name] = path
            else:
                self.found.again[name] = other
                if own:
                    self.found.files[own] = real

    def _unlisted(self, real: str) -> str:
        """The name without links of what lies below in a folder that could not be listed; else none.

        It was found by that name when the folder could be, and is no other file now.
        """
        above = self.root.real.rstrip(os.sep) + os.sep
        name = shown_name(real.removeprefix(above))
        return name if real.startswith(above) and self.found.may_be_there(name) else ""

    def _not_regular(self, inner: _WalkedEntry, mode: int) -> None:
        self.found.aside[inner.name] = f"{other_kind(mode)}, not a regular file"

    def _unknown(self, inner: _WalkedEntry, error: OSError) -> None:
        self.found.aside[inner.name] = f"cannot be looked at ({error.strerror})"
        self.found.unseen += [inner.name, inner.name + "/"]

    def _closed(self, here: _WalkedEntry, error: OSError) -> None:
        if not here.name:
            if isinstance(error, FileNotFoundError):
                raise DomainError(
                    "there is no such folder",
                    where=shown_name(here.path),
                    todo="make it and put your files into it, or choose another folder",
                ) from error
            if isinstance(error, NotADirectoryError):
                raise DomainError(
                    "this is no folder",
                    where=shown_name(here.path),
                    todo="name the folder that holds your files",
                ) from error
            raise DomainError(
                f"this folder may not be read ({error.strerror})",
                where=shown_name(here.path),
                todo="allow reading it, or choose another folder",
            ) from error
        if not isinstance(error, FileNotFoundError):  # else gone since the folder above was listed
            self.found.aside[here.name] = f"this folder may not be read ({error.strerror})"
            self.found.unseen.append(here.name)


@dataclass(frozen=True)
class _WalkedEntry:
    name: str
    path: str
    real: str

    def inner(self, name: str) -> _WalkedEntry:
        path = os.path.join(self.path, name)
        real = path if self.path == self.real else os.path.join(self.real, name)  # one text for both
        return _WalkedEntry(self.name + shown_name(name), path, real)

    def as_folder(self) -> _WalkedEntry:
        return _WalkedEntry(self.name + "/", self.path, self.real)
