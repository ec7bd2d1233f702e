"""Opening files of unknown folders: regular ones only, without ever waiting."""

from __future__ import annotations

import errno
import io
import os
import stat
from pathlib import Path


class NotRegularError(OSError):
    """A FIFO, socket, device or folder stands where a file should be."""

    def __init__(self, path: str) -> None:
        super().__init__(errno.EINVAL, "is not a regular file", path)

    def __reduce__(self) -> tuple[type[NotRegularError], tuple[str]]:
        """Pickled, it is made again from the path."""
        return NotRegularError, (str(self.filename),)


def open_regular(path: str | os.PathLike[str]) -> io.BufferedReader:
    """Open a file for reading; a FIFO that nobody writes into does not block.

    Raises
    ------
    NotRegularError
    OSError
        It cannot be opened.
    """
    stream = open(Path(path), "rb", opener=_without_waiting)  # noqa: SIM115
    if not stat.S_ISREG(os.fstat(stream.fileno()).st_mode):
        stream.close()
        raise NotRegularError(os.fspath(path))
    return stream


def _without_waiting(name: str, flags: int) -> int:
    return os.open(name, flags | getattr(os, "O_NONBLOCK", 0))
