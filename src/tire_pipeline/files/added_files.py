"""What a run adds to a folder, instead of replacing what it holds."""

from __future__ import annotations

from typing import TypeVar

T = TypeVar("T")


class AddedFiles(dict[str, T]):
    """Names and contents of files. A dataset that saves them keeps the other files of earlier runs.

    Examples
    --------
    >>> AddedFiles({"B/one.tir": b"..."})
    {'B/one.tir': b'...'}
    """
