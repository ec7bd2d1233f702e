"""Files of a folder as functions: what is large is read, or made, one file at a time."""

from __future__ import annotations

from collections.abc import Callable, Mapping

Read = Callable[[], bytes]
"""Reads the content of a stored file."""

StoredFiles = Mapping[str, Read]
"""Name of a stored file -> what reads it."""

FilesToMake = dict[str, Callable[[], bytes]]
"""Name of a file -> what makes its content."""
