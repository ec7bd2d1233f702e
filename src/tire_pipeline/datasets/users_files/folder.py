"""A folder by its path, for nodes that look at dates and contents themselves."""

from __future__ import annotations

from pathlib import Path
from typing import NoReturn

from tire_pipeline.datasets.storage.at_path import DatasetAtPath
from tire_pipeline.errors import DomainError
from tire_pipeline.files.objects import Objects, is_remote


class FolderDataset(DatasetAtPath[NoReturn, Path | Objects]):
    """Loads as the path of a folder that is there, or as the objects below an address; never written.

    Parameters
    ----------
    path : str
    metadata : dict, optional
        For kedro-viz.

    Raises
    ------
    DomainError
        The folder is absent, or there is nothing below the address.
    """

    def load(self) -> Path | Objects:
        """The path, or the objects."""
        if is_remote(self._path):
            objects = Objects(self._path)
            if objects.is_empty():
                raise DomainError(
                    "there is nothing below this address", where=self._path, todo="correct tir_folder"
                )
            return objects
        path = Path(self._path)
        if not path.is_dir():
            raise DomainError(
                "this folder does not exist", where=str(path), todo="set tir_folder, or restore the folder"
            )
        return path

    def save(self, data: NoReturn) -> None:
        """Refuse: the files are the user's."""
        raise DomainError("files of the user are never changed", where=self._path)

    def _exists(self) -> bool:
        return not Objects(self._path).is_empty() if is_remote(self._path) else Path(self._path).is_dir()
