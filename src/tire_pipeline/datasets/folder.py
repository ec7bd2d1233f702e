"""A folder by its path, for nodes that look at dates and contents themselves."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NoReturn

from kedro.io.core import AbstractDataset

from tire_pipeline.errors import DomainError
from tire_pipeline.objects import is_remote


class FolderDataset(AbstractDataset[NoReturn, Path]):
    """Loads as the path of a local folder that is there; never written.

    Parameters
    ----------
    path : str
    metadata : dict, optional
        For kedro-viz.

    Raises
    ------
    DomainError
        The folder is absent.
    """

    def __init__(self, *, path: str, metadata: dict[str, Any] | None = None) -> None:
        self._path = path
        self.metadata = metadata

    def load(self) -> Path:
        """The path."""
        if is_remote(self._path):
            raise DomainError(
                "new files are recognised by the dates of a local or mounted folder",
                where=self._path,
                todo="set tir_folder to one; the other pipelines read from an object store",
            )
        path = Path(self._path)
        if not path.is_dir():
            raise DomainError(
                "this folder is not there", where=str(path), todo="set tir_folder, or bring the folder back"
            )
        return path

    def save(self, data: NoReturn) -> None:
        """Refuse: the files are the user's."""
        raise DomainError("files of the user are never changed", where=self._path)

    def _exists(self) -> bool:
        return Path(self._path).is_dir()

    def _describe(self) -> dict[str, Any]:
        return {"path": self._path}
