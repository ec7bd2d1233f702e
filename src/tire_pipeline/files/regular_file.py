"""Opening files of unknown folders: regular ones only, without ever waiting."""

from __future__ import annotations

import errno
import io
import os
import stat
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from _typeshed import WriteableBuffer as Buffer


class NotRegularError(OSError):
    """A FIFO, socket, device or folder stands where a file should be."""

    def __init__(self, path: str) -> None:
        super().__init__(errno.EINVAL, "is not a regular file", path)

    def __reduce__(self) -> tuple[type[NotRegularError], tuple[str]]:
        """Pickled, it is made again from the path."""
        return NotRegularError, (str(self.filename),)


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
    if not stat.S_ISREG(os.fstat(stream.fileno()).st_mode):
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
