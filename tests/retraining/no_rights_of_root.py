"""Root may read everything; a block in which that does not hold, with no other user and no other process."""

from __future__ import annotations

import contextlib
import ctypes
import os
from collections.abc import Iterator

_VERSION_3 = 0x20080522  # of the kernel's structures, in linux/capability.h
_CAP_DAC_OVERRIDE, _CAP_DAC_READ_SEARCH = 1, 2
_LIBC = ctypes.CDLL(None, use_errno=True)


class _Header(ctypes.Structure):
    _fields_ = (("version", ctypes.c_uint32), ("pid", ctypes.c_int))


class _Data(ctypes.Structure):
    _fields_ = (
        ("effective", ctypes.c_uint32),
        ("permitted", ctypes.c_uint32),
        ("inheritable", ctypes.c_uint32),
    )


@contextlib.contextmanager
def rights(*, of_root: bool) -> Iterator[None]:
    """Let this thread pass over the permissions of files, or not; whoever is not root never may.

    Parameters
    ----------
    of_root : bool
    """
    if os.geteuid() != 0:
        yield
        return
    header, data = _Header(_VERSION_3, 0), (_Data * 2)()
    _checked(_LIBC.capget(ctypes.byref(header), data))
    before = data[0].effective
    passing = 1 << _CAP_DAC_OVERRIDE | 1 << _CAP_DAC_READ_SEARCH
    data[0].effective = before | passing & data[0].permitted if of_root else before & ~passing
    _checked(_LIBC.capset(ctypes.byref(header), data))
    try:
        yield
    finally:
        data[0].effective = before
        _checked(_LIBC.capset(ctypes.byref(header), data))


def _checked(outcome: int) -> None:
    if outcome != 0:
        number = ctypes.get_errno()
        raise OSError(number, os.strerror(number))
