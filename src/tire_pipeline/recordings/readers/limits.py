"""How large a file may be, and how much it may grow when it is read."""

from __future__ import annotations

import os
from functools import cache
from pathlib import Path

from tire_pipeline.errors import RecordingError

# A compressed file of constant channels grows a hundredfold in earnest; only what is also large
# is refused.
_MOST_FACTOR = 200.0
_ALWAYS_ALLOWED = float(1 << 26)
_MEMORY_SHARE = 0.5  # for what is read, and for the table that is made of it
GROUP_LIMITS = ("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes")
"""Where the system says how much memory a container has."""


@cache
def most_bytes() -> float:
    """The largest file that could be read here: half as large as the memory of the machine or container."""
    most = float(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
    for place in map(Path, GROUP_LIMITS):
        try:
            most = min(most, float(place.read_text(encoding="ascii")))
        except (OSError, ValueError):  # another system, or no limit
            continue
    return _MEMORY_SHARE * most


def too_large(size: int) -> str:
    """Why a file of so many bytes is not read; empty if it is.

    It would fill the memory, and the system would end the process and all else that it does.
    """
    if size <= most_bytes():
        return ""
    return (
        f"the file has {size / 2**30:.1f} GiB, too many for the memory of this machine, "
        f"which takes {most_bytes() / 2**30:.1f} GiB"
    )


def check_size(path: Path) -> None:
    """Refuse a file that is :func:`too_large`.

    Parameters
    ----------
    path : Path

    Raises
    ------
    RecordingError
    """
    if reason := too_large(path.stat().st_size):
        raise RecordingError(reason, where=str(path), todo="cut it into parts, or use a larger machine")


def check_expansion(path: Path, size: float) -> None:
    """Refuse a file whose content is far larger than itself.

    Parameters
    ----------
    path : Path
    size : float
        Bytes that the content takes when it is read.

    Raises
    ------
    RecordingError
        More than 64 MiB and more than 200 times the file's size.
    """
    allowed = max(_ALWAYS_ALLOWED, _MOST_FACTOR * path.stat().st_size)
    if not size <= allowed:
        raise RecordingError(
            f"it says that it holds {size / 2**20:.0f} MiB, over {_MOST_FACTOR:.0f} times its size",
            where=str(path),
            todo="the file is damaged, or made to fill the memory",
        )
