"""A page or text at one fixed place, replaced in one step."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from kedro.io.core import AbstractDataset

from tire_pipeline.files.atomic import replaced_file
from tire_pipeline.files.objects import Objects, is_remote


class HtmlPageDataset(AbstractDataset[str | Iterable[str], str]):
    """A self-contained HTML page, saved as one text or in pieces that are written as they come.

    Parameters
    ----------
    filepath : str
        Where it lies: a path, or the address of an object.
    metadata : dict, optional
        For kedro-viz.
    """

    def __init__(self, *, filepath: str, metadata: dict[str, Any] | None = None) -> None:
        self._filepath = filepath
        self.metadata = metadata

    def load(self) -> str:
        """The page's text."""
        if is_remote(self._filepath):
            folder, name = _parted(self._filepath)
            return folder.read(name).decode("utf-8")
        return Path(self._filepath).read_text(encoding="utf-8")

    def save(self, data: str | Iterable[str]) -> None:
        """Replace the page in one step."""
        pieces = [data] if isinstance(data, str) else data
        if is_remote(self._filepath):
            folder, name = _parted(self._filepath)
            with tempfile.TemporaryDirectory() as scratch:
                written = Path(scratch, "page.html")
                _write(written, pieces)
                folder.write_file(name, written)
            return
        with replaced_file(self._filepath) as temporary:
            _write(temporary, pieces)

    def _exists(self) -> bool:
        if is_remote(self._filepath):
            folder, name = _parted(self._filepath)
            return folder.exists(name)
        return Path(self._filepath).exists()

    def _describe(self) -> dict[str, Any]:
        return {"filepath": self._filepath}


def _write(path: Path, pieces: Iterable[str]) -> None:
    with path.open("w", encoding="utf-8") as stream:
        stream.writelines(pieces)


def _parted(address: str) -> tuple[Objects, str]:
    folder, _, name = address.rpartition("/")
    return Objects(folder), name
