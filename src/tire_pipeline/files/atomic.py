"""Writing so that a reader sees the old content or the new, never a part."""

from __future__ import annotations

import contextlib
import os
import shutil
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

_CHECKS: list[Callable[[], None]] = []


def check_before_replacing(check: Callable[[], None]) -> Callable[[], None]:
    """Have ``check`` called before any file or folder takes its place; if it raises, nothing changes.

    Parameters
    ----------
    check : callable

    Returns
    -------
    callable
        Ends it.
    """
    _CHECKS.append(check)

    def stop() -> None:
        with contextlib.suppress(ValueError):
            _CHECKS.remove(check)

    return stop


def check_now() -> None:
    """Call what was given to :func:`check_before_replacing`."""
    for check in list(_CHECKS):
        check()


def write_bytes(path: str | os.PathLike[str], data: bytes) -> None:
    """Replace a file, or make it, in one step.

    Parameters
    ----------
    path : path
        Its folder must exist.
    data : bytes

    Raises
    ------
    OSError
        The disk is full, the folder is absent or may not be written... Nothing is left behind then.
    """
    with replaced_file(path, parents=False) as temporary:
        temporary.write_bytes(data)


@contextlib.contextmanager
def replaced_file(path: str | os.PathLike[str], *, parents: bool = True) -> Iterator[Path]:
    """Return a temporary file beside ``path`` that takes its place if the block ends well.

    It is on the disk before it takes that place: a power cut leaves the old content or the new.

    Parameters
    ----------
    path : path
    parents : bool
        Make the folders above it.
    """
    path = Path(path)
    check_now()
    if parents:
        path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(prefix=".", suffix=".part", dir=path.parent)
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        with temporary.open("rb") as stream:
            os.fsync(stream.fileno())
        temporary.chmod(0o644)
        check_now()
        temporary.replace(path)
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink()


@contextlib.contextmanager
def replaced_folder(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Return a temporary folder beside ``path`` that takes its place if the block ends well.

    Between two renamings ``path`` is absent; if the second fails the first is undone.
    """
    path = Path(path)
    check_now()
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = Path(tempfile.mkdtemp(prefix=f".{path.name}.", suffix=".part", dir=path.parent))
    old = temporary.with_suffix(".old")
    try:
        yield temporary
        temporary.chmod(0o755)
        check_now()
        if path.exists():
            path.rename(old)
        temporary.rename(path)
    except BaseException:
        if old.exists() and not path.exists():
            old.rename(path)
        raise
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
        shutil.rmtree(old, ignore_errors=True)
