"""A lock that ends with the process that held it, however that process ended."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path

from tire_pipeline.datasets.storage.files_at import Files
from tire_pipeline.errors import DomainError
from tire_pipeline.files.objects import ConflictError, Objects
from tire_pipeline.runs.system_lock import system_lock


def held(folder: Files | Objects) -> contextlib.AbstractContextManager[None]:
    """Hold a folder while what counts in it is replaced; objects are replaced under a condition instead."""
    return locked(folder.root) if isinstance(folder, Files) else contextlib.nullcontext()


@contextlib.contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Hold ``<folder>/.lock``; the system releases it when the process ends, even if it is killed.

    Where the file system has no locks, the run's ticket (:mod:`tire_pipeline.runs`) keeps others away.
    """
    folder.mkdir(parents=True, exist_ok=True)
    lock = system_lock(folder / ".lock", wait_seconds=-1.0)
    try:
        yield
    finally:
        if lock is not None:
            lock.release()


def replace_unless_changed(folder: Files | Objects, name: str, content: bytes, stamp: str | None) -> None:
    """Replace the file or object that says what counts, if it is still the one that was read.

    Raises
    ------
    DomainError
        Another run has stored its results in the meantime.
    """
    try:
        folder.replace(name, content, stamp)
    except ConflictError as error:
        raise DomainError(
            "another run has stored its results in the meantime",
            where=f"{folder}/{name}",
            todo="nothing was changed: run again",
        ) from error


def refuse_other_revision(found: int, expected: int, where: Path | str) -> None:
    """Stop before writing over what another run stored meanwhile.

    Raises
    ------
    DomainError
        The revisions differ.
    """
    if found != expected:
        raise DomainError(
            f"another run has stored revision {found} in the meantime; this one began at {expected}",
            where=str(where),
            todo="nothing was changed: run again",
        )
