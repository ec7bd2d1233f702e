"""A page or text at one fixed place, replaced in one step."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from kedro.io.core import AbstractDataset

from tire_pipeline.files.atomic import replaced_file
from tire_pipeline.files.objects import Objects, is_remote


class HtmlPageDataset(AbstractDataset[str, str]):
    """A self-contained HTML page.

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

    def save(self, data: str) -> None:
        """Replace the page in one step."""
        if is_remote(self._filepath):
            folder, name = _parted(self._filepath)
            folder.write(name, data.encode("utf-8"))
            return
        with replaced_file(self._filepath) as temporary:
            temporary.write_text(data, encoding="utf-8")

    def _exists(self) -> bool:
        if is_remote(self._filepath):
            folder, name = _parted(self._filepath)
            return folder.exists(name)
        return Path(self._filepath).exists()

    def _describe(self) -> dict[str, Any]:
        return {"filepath": self._filepath}


def _parted(address: str) -> tuple[Objects, str]:
    folder, _, name = address.rpartition("/")
    return Objects(folder), name
