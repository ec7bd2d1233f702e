"""Writing so that a reader sees the old content or the new, never a part."""

from __future__ import annotations

import contextlib
import errno
import glob
import os
import re
import shutil
import tempfile
from collections.abc import Callable, Collection, Iterator
from pathlib import Path

from tire_pipeline.files.swapped_names import swapped

_NEW_SUFFIX, _OLD_SUFFIX = ".part", ".old"
_OURS_PREFIX = "tire_pipeline-"  # no file or folder of the user is called so
_OWNED = re.compile(
    rf"\.(?:(.*)\.)?{_OURS_PREFIX}([^-]+)-[^-.]+(?:{_NEW_SUFFIX}|{_OLD_SUFFIX})", re.DOTALL
).fullmatch
_OF_WRITING = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}
"""What a write into an open file can fail of: the system does not say which file it is."""
_CHECKS: list[tuple[Callable[[], None], str]] = []


def check_before_replacing(check: Callable[[], None], *, owner: str = "") -> Callable[[], None]:
    """Have ``check`` called before any file or folder takes its place; if it raises, nothing changes.

    Parameters
    ----------
    check : callable
    owner : str
        Stands in the names of what is temporary meanwhile, for :func:`remove_temporary`; without hyphens.

    Returns
    -------
    callable
        Ends it.
    """
    _CHECKS.append((check, owner))

    def stop() -> None:
        with contextlib.suppress(ValueError):
            _CHECKS.remove((check, owner))

    return stop


def check_now() -> None:
    """Call what was given to :func:`check_before_replacing`."""
    for check, _ in list(_CHECKS):
        check()


def remove_temporary(folder: str | os.PathLike[str], owners: Collection[str]) -> None:
    """Remove what processes that were killed in the middle of a write have left anywhere below a folder.

    Parameters
    ----------
    folder : path
    owners : collection of str
        Those given to :func:`check_before_replacing`; what is temporary to others stays.
    """
    for here, folders, files in os.walk(folder) if owners else ():
        for name in [*folders, *files]:
            found = _OWNED(name)
            if found and found[2] in owners:
                _remove(Path(here, name), Path(here, found[1]) if found[1] else None)
        folders[:] = [each for each in folders if not _OWNED(each)]


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
    try:
        handle, name = tempfile.mkstemp(
            prefix=f".{_OURS_PREFIX}{_owner()}", suffix=_NEW_SUFFIX, dir=path.parent
        )
    except OSError as error:  # the user knows the file, not the temporary one
        raise OSError(error.errno, error.strerror, str(path)) from error
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        with temporary.open("rb") as stream:
            os.fsync(stream.fileno())
        temporary.chmod(0o644)
        check_now()
        temporary.replace(path)
    except FileNotFoundError:
        check_now()  # another run may have taken the folder over, and what was temporary with it
        raise
    except OSError as error:
        if error.filename == name or (error.filename is None and error.errno in _OF_WRITING):
            raise OSError(error.errno, error.strerror, str(path)) from error  # the user knows that file
        raise
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
    temporary = Path(tempfile.mkdtemp(prefix=_beside(path) + _owner(), suffix=_NEW_SUFFIX, dir=path.parent))
    old = temporary.with_suffix(_OLD_SUFFIX)
    try:
        yield temporary
        temporary.chmod(0o755)
        check_now()
        if path.exists() and not swapped(temporary, path):
            path.rename(old)
        if old.exists() or not path.exists():
            temporary.rename(path)
    except BaseException as error:
        if old.exists() and not path.exists():
            old.rename(path)
        if isinstance(error, FileNotFoundError):
            check_now()  # another run may have taken the folder over, and what was temporary with it
        raise
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
        shutil.rmtree(old, ignore_errors=True)


def _tidy(path: Path) -> None:
    """What a process that was killed in :func:`replaced_folder` left beside ``path``."""
    left = path.parent.glob(f"{glob.escape(_beside(path))}*")
    for each in [each for each in left if each.suffix in (_NEW_SUFFIX, _OLD_SUFFIX)]:
        _remove(each, path)


def _remove(temporary: Path, path: Path | None) -> None:
    """Remove what is temporary, or put it back as ``path`` if it is all that is left of that."""
    if path and temporary.suffix == _OLD_SUFFIX and not path.exists():
        temporary.rename(path)
    elif temporary.is_dir():
        shutil.rmtree(temporary, ignore_errors=True)
    else:
        temporary.unlink(missing_ok=True)


def _beside(path: Path) -> str:
    """How the names of temporary folders begin."""
    return f".{path.name}.{_OURS_PREFIX}"


def _owner() -> str:
    return next((f"{owner}-" for _, owner in _CHECKS if owner), "")
