"""A lock that goes with the process that held it, however that ended."""

from __future__ import annotations

import contextlib
import fcntl
from collections.abc import Iterator
from pathlib import Path

from tire_pipeline.errors import DomainError


@contextlib.contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Hold ``<folder>/.lock``; the kernel lets go of it when the process ends, even when it is killed."""
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / ".lock", "a+b") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def refuse_other_revision(found: int, expected: int, where: Path) -> None:
    """Stop before writing over what another run stored meanwhile.

    Raises
    ------
    DomainError
        The revisions differ.
    """
    if found != expected:
        raise DomainError(
            f"another run has stored revision {found} meanwhile; this one began at {expected}",
            where=str(where),
            todo="nothing was changed: run again",
        )
