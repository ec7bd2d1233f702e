"""Two names of one folder that change places in one step, where the system can do that."""

from __future__ import annotations

import ctypes
import errno
import os

_HERE = -100  # AT_FDCWD: relative paths begin at the working folder
_EXCHANGE = 2  # RENAME_EXCHANGE
_CANNOT = {errno.ENOSYS, errno.EINVAL, errno.ENOTSUP, errno.EOPNOTSUPP}


def swapped(first: str | os.PathLike[str], second: str | os.PathLike[str]) -> bool:
    """Let two existing files or folders change their names; no reader ever finds one of the names absent.

    Returns
    -------
    bool
        False where system or file system have no such step; nothing has changed then.

    Raises
    ------
    OSError
        It could be done, but not with these two.
    """
    renameat2 = getattr(ctypes.CDLL(None, use_errno=True), "renameat2", None)  # Linux
    if renameat2 is None:
        return False
    if renameat2(_HERE, os.fsencode(first), _HERE, os.fsencode(second), _EXCHANGE) == 0:
        return True
    number = ctypes.get_errno()
    if number in _CANNOT:
        return False
    raise OSError(number, os.strerror(number), os.fspath(first), None, os.fspath(second))
