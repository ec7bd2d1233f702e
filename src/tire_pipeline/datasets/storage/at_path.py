"""What datasets of a folder, or of all below an address of an object store, have in common."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Generic, TypeVar

from kedro.io.core import AbstractDataset

from tire_pipeline.files.objects import Objects, is_remote

Saved = TypeVar("Saved")
Loaded = TypeVar("Loaded")


class DatasetAtPath(AbstractDataset[Saved, Loaded], Generic[Saved, Loaded]):
    """A dataset of the files below a local path or an address. Subclasses load and save.

    Parameters
    ----------
    path : str
        The folder, or the address.
    metadata : dict, optional
        For kedro-viz.
    """

    def __init__(self, *, path: str, metadata: dict[str, Any] | None = None) -> None:
        self._path = path
        self.metadata = metadata

    def _exists(self) -> bool:
        if is_remote(self._path):
            return bool(Objects(self._path).names())
        return Path(self._path).exists()

    def _describe(self) -> dict[str, Any]:
        return {"path": self._path}
