"""Archives in a folder in which the user's files are looked for."""

from __future__ import annotations

from itertools import islice

from tire_pipeline.files.folder_walk import walk
from tire_pipeline.files.objects import is_remote

_ARCHIVES = (".zip", ".7z", ".rar", ".gz", ".tgz", ".tar", ".bz2", ".xz")
_MOST_ARCHIVES = 3


def to_unpack(folder: str) -> str:
    """What to do first where nothing is found but archives; empty where there are none."""
    if is_remote(folder):
        return ""
    found = list(
        islice(walk(folder, lambda name: name.lower().endswith(_ARCHIVES)).files, _MOST_ARCHIVES + 1)
    )
    some = ", ".join([*found[:_MOST_ARCHIVES], *(["..."] if found[_MOST_ARCHIVES:] else [])])
    return f"unpack {some}; or " if some else ""
