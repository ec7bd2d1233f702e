"""Files that another program is writing while a run looks at its folder: half of one would be read."""

from __future__ import annotations

import os
import time

from tire_pipeline.files.folder_walk import Found

BEING_WRITTEN = "it is being written: it changed while the folder was looked at"
_RECENT_SECONDS = 2.0
"""Only what changed less long ago, or has a date in the future, is looked at twice."""
_SECONDS_BETWEEN_LOOKS = 0.3


def set_growing_aside(found: Found) -> None:
    """Take those files out that are being written; the next run takes them.

    Costs nothing if no file has changed within the last seconds.

    Parameters
    ----------
    found : Found
    """
    since = time.time() - _RECENT_SECONDS
    looks = ((name, _look(path)) for name, path in found.files.items())
    recent = {name: look for name, look in looks if look and look[1] / 1e9 > since}
    if recent:
        time.sleep(_SECONDS_BETWEEN_LOOKS)
    for name, before in recent.items():
        if _look(found.files[name]) != before:
            del found.files[name]
            found.aside[name] = BEING_WRITTEN


def todo_of(reason: str, otherwise: str) -> str:
    """What to do about an entry that is not among the files.

    Parameters
    ----------
    reason : str
        From :attr:`.Found.aside`.
    otherwise : str
        What to do about any other entry.
    """
    if reason == BEING_WRITTEN:
        return "run again when it is whole"
    return "allow reading it, or take it out" if "Permission denied" in reason else otherwise


def _look(path: str) -> tuple[int, int] | None:
    try:
        found = os.stat(path)
    except OSError:
        return None
    return found.st_size, found.st_mtime_ns
