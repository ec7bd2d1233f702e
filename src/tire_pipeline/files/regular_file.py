"""Files of unknown folders: whether there is one, what it is, and opening it if regular, without a wait."""

from __future__ import annotations

import errno
import io
import os
import stat
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from _typeshed import WriteableBuffer as Buffer


A_FOLDER, LINK_TO_ITSELF = "a folder", "a link that leads to itself"
_OTHER_KINDS = {
    stat.S_IFIFO: "a FIFO",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
    stat.S_IFDIR: A_FOLDER,
}


_PACKED = {
    b"PK\x03\x04": "a ZIP archive",
    b"7z\xbc\xaf": "a 7z archive",
    b"Rar!": "a RAR archive",
    b"\x1f\x8b": "compressed by gzip",
    b"BZh": "compressed by bzip2",
    b"\xfd7zXZ\x00": "compressed by xz",
    b"\x28\xb5\x2f\xfd": "compressed by zstd",
}


def kind_of_archive(head: bytes) -> str:
    """What kind of archive or compressed file begins like this; empty if none does.

    Examples
    --------
    >>> kind_of_archive(b"PK\\x03\\x04..."), kind_of_archive(b"[MDI_HEADER]")
    ('a ZIP archive', '')
    """
    return next((kind for beginning, kind in _PACKED.items() if head.startswith(beginning)), "")


class NotRegularError(OSError):
    """A FIFO, socket, device or folder stands where a file should be."""

    def __init__(self, path: str) -> None:
        super().__init__(errno.EINVAL, "is not a regular file", path)

    def __reduce__(self) -> tuple[type[NotRegularError], tuple[str]]:
        """Pickled, it is made again from the path."""
        return NotRegularError, (str(self.filename),)


def other_kind(mode: int) -> str:
    """What an entry of a folder is instead of a regular file, in words; empty if it is one.

    Parameters
    ----------
    mode : int
        ``st_mode`` of what :func:`os.stat` gives.
    """
    return "" if stat.S_ISREG(mode) else _OTHER_KINDS.get(stat.S_IFMT(mode), "of an unknown kind")


def no_regular_file(path: str | os.PathLike[str]) -> str:
    """Why there is no regular file at a path; empty if there is one. Nothing is opened.

    Raises
    ------
    OSError
        It may not be looked at: there may be one.
    """
    try:
        kind = other_kind(os.stat(path).st_mode)
    except (FileNotFoundError, NotADirectoryError, ValueError):
        return "no such file"
    except OSError as error:
        if error.errno != errno.ELOOP:
            raise
        return LINK_TO_ITSELF
    if kind == A_FOLDER:
        return f"this is {kind}"
    return f"this is {kind}, not a regular file" if kind else ""


def open_regular(path: str | os.PathLike[str]) -> io.BufferedReader:
    """Open a file for reading; neither opening nor reading it waits for somebody to write.

    Raises
    ------
    NotRegularError
        Also by a read, where the system calls a file regular that has nothing to read now (``/proc/kmsg``).
    OSError
        It cannot be opened.
    """
    stream = _WithoutWaiting(os.fspath(path), "rb", opener=_without_waiting)
    if other_kind(os.fstat(stream.fileno()).st_mode):
        stream.close()
        raise NotRegularError(os.fspath(path))
    return io.BufferedReader(stream)


class _WithoutWaiting(io.FileIO):
    """Raises where a read would have to wait; by itself it gives None, which callers take for bytes."""

    def readinto(self, buffer: Buffer, /) -> int:
        count = super().readinto(buffer)
        if count is None:
            raise NotRegularError(os.fspath(self.name))
        return count

    def readall(self) -> bytes:
        content = super().readall()
        if content is None:
            raise NotRegularError(os.fspath(self.name))
        return content


def _without_waiting(name: str, flags: int) -> int:
    return os.open(name, flags | getattr(os, "O_NONBLOCK", 0))
