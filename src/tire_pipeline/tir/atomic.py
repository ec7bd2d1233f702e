"""Writing a file so that a reader sees the old content or the new, never a part."""

from __future__ import annotations

import contextlib
import os
import tempfile
from pathlib import Path

from tire_pipeline.errors import TirError


def write_bytes(path: str | os.PathLike[str], data: bytes, *, overwrite: bool = False) -> None:
    """Write ``data`` to a temporary file in the same folder, sync it, and rename it.

    Parameters
    ----------
    path : path
    data : bytes
    overwrite : bool
        Replace a file that is there.

    Raises
    ------
    TirError
        A file is there and ``overwrite`` is False.
    OSError
        The disk is full, the folder may not be written... Nothing is left behind then.
    """
    target = Path(path)
    if not overwrite and target.exists():
        raise TirError(
            "there is a file of that name",
            path=str(target),
            todo="choose another name, or pass overwrite=True",
        )
    handle, name = tempfile.mkstemp(prefix=".", suffix=".part", dir=target.parent)
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
            stream.flush()
            os.fsync(stream.fileno())
        os.chmod(name, 0o644)
        os.replace(name, target)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(name)
        raise
