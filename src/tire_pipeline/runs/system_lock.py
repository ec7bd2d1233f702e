"""A lock that the system gives back when its process ends, where the file system has such locks."""

from __future__ import annotations

import errno
from pathlib import Path

from filelock import FileLock, Timeout

_NO_LOCKS = {errno.ENOSYS, errno.ENOTSUP, errno.EOPNOTSUPP, errno.ENOLCK, errno.EINVAL}
_LOCK_SECONDS = 0.3


class Held(Exception):
    """Another process holds the lock."""


def system_lock(path: Path, *, wait_seconds: float = 0.0) -> FileLock | None:
    """Take the lock of a file.

    Parameters
    ----------
    path : Path
        Made if it is absent, and left there: a lock file that is deleted would let two processes in.
    wait_seconds : float
        Negative: as long as it takes.

    Returns
    -------
    FileLock or None
        None where the file system has no locks.

    Raises
    ------
    Held
        Another process has it.
    """
    lock = FileLock(path, fallback_to_soft=False, thread_local=False, poll_interval=0.02)
    try:
        lock.acquire(timeout=wait_seconds)
    except Timeout as error:
        raise Held(str(path)) from error
    except OSError as error:
        if error.errno in _NO_LOCKS:
            return None
        raise
    return lock


def is_held(path: Path) -> bool | None:
    """Whether another process holds the lock of a file; None where the file system has no locks.

    Asking takes the lock for a moment, so a lock counts as held only if it stays so for longer than that.
    """
    try:
        lock = system_lock(path, wait_seconds=_LOCK_SECONDS)
    except Held:
        return True
    if lock is None:
        return None
    lock.release()
    return False
