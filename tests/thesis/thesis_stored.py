"""What the pipeline has stored: content and date."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Stored:
    """Content and date of a file."""

    sha256: str
    changed: int


def stored_results(folder: Path) -> dict[str, Stored]:
    """Every computed result of the pipeline, by path."""
    data = folder / "data"
    return {
        str(path.relative_to(data)): Stored(
            hashlib.sha256(path.read_bytes()).hexdigest(), path.stat().st_mtime_ns
        )
        for path in data.glob("*/thesis/**/*.npz")
    }
