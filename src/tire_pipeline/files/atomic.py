"""Writing so that a reader sees the old content or the new, never a part."""

from __future__ import annotations

import contextlib
import glob
import os
import shutil
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

from tire_pipeline.files.swapped_names import swapped

_NEW_SUFFIX, _OLD_SUFFIX = ".part", ".old"
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

    Where the system can swap two names in one step, ``path`` is there at every moment. Elsewhere it is absent
    between two renamings; if the process is killed there, the next call puts the old folder back. That call
    also removes what a killed process left beside ``path``: two processes must not replace it at once.
    """
    path = Path(os.path.realpath(path))
    check_now()
    path.parent.mkdir(parents=True, exist_ok=True)
    _tidy(path)
    temporary = Path(tempfile.mkdtemp(prefix=_beside(path), suffix=_NEW_SUFFIX, dir=path.parent))
    old = temporary.with_suffix(_OLD_SUFFIX)
    try:
        yield temporary
        temporary.chmod(0o755)
        check_now()
        if path.exists() and not swapped(temporary, path):
            path.rename(old)
        if old.exists() or not path.exists():
            temporary.rename(path)
    except BaseException:
        if old.exists() and not path.exists():
            old.rename(path)
        raise
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
        shutil.rmtree(old, ignore_errors=True)


def _tidy(path: Path) -> None:
    """What a process that was killed in :func:`replaced_folder` left beside ``path``."""
    left = path.parent.glob(f"{glob.escape(_beside(path))}*")
    for each in [each for each in left if each.suffix in (_NEW_SUFFIX, _OLD_SUFFIX)]:
        if each.suffix == _OLD_SUFFIX and not path.exists():
            each.rename(path)
        else:
            shutil.rmtree(each, ignore_errors=True)


def _beside(path: Path) -> str:
    """How the names of temporary folders begin: no folder of the user is called so."""
    return f".{path.name}.tire_pipeline-"
