"""A hash of parts of this project's code, so that results of other code are never reused."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from pathlib import Path


def code_hash(*packages: str) -> str:
    """Return a hash of the source of parts of this project.

    Parameters
    ----------
    *packages : str
        Folders below ``tire_pipeline``; ``.`` is all of it.
    """
    root = Path(__file__).resolve().parent
    total = hashlib.sha256()
    for path in _sources(root, packages):
        total.update(path.relative_to(root).as_posix().encode() + b"\0" + path.read_bytes())
    return total.hexdigest()[:12]


def _sources(root: Path, packages: tuple[str, ...]) -> Iterator[Path]:
    for package in packages:
        for path in sorted((root / package).rglob("*")):
            if "__pycache__" in path.parts:  # code that is made at first use lies there
                continue
            if path.is_file() and path.suffix in (".py", ".json", ".html"):
                yield path
