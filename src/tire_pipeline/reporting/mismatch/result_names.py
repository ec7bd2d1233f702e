"""Names of the files that belong to a recording: its page, its row, its corrected model."""

from __future__ import annotations

import hashlib
from pathlib import PurePosixPath

_MOST_NAME_BYTES = 255 - len("_corrected.tir.sidecar.json")


def result_place(recording: str, ending: str) -> str:
    """The path of a recording's result, relative to the folder of all such results.

    Recordings that differ by their format alone (``run.csv``, ``run.mat``) have results of their own, and a
    name that would be too long with the longest ending ends in its hash.

    Parameters
    ----------
    recording : str
        Relative to the folder of recordings, or ``folder/together``.
    ending : str

    Examples
    --------
    >>> result_place("rig/run.csv", ".html"), result_place("rig/run.mat", "_corrected.tir")
    ('rig/run.html', 'rig/run.mat_corrected.tir')
    """
    place = PurePosixPath(recording)
    name = place.name.removesuffix(".csv")
    if len(name.encode()) > _MOST_NAME_BYTES:
        digest = hashlib.sha256(name.encode()).hexdigest()[:16]
        name = f"{name.encode()[: _MOST_NAME_BYTES - len(digest) - 1].decode(errors='ignore')}-{digest}"
    return str(place.parent / f"{name}{ending}")
