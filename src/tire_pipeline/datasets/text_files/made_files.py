"""Which files of a folder this project has made itself."""

from __future__ import annotations

from pathlib import Path
from typing import NoReturn

from tire_pipeline.datasets.storage.at_path import DatasetAtPath
from tire_pipeline.datasets.text_files.text_folder import made_at
from tire_pipeline.errors import DomainError
from tire_pipeline.files.objects import is_remote


class MadeFilesDataset(DatasetAtPath[NoReturn, list[str]]):
    """Loads as the paths of those files in a folder that :class:`.TextFolderDataset` wrote; never written.

    Parameters
    ----------
    path : str
        The folder; it may be absent.
    metadata : dict, optional
        For kedro-viz.
    """

    def load(self) -> list[str]:
        """Paths relative to the folder."""
        return sorted(made_at(self._path))

    def save(self, data: NoReturn) -> None:
        """Refuse: the folder's own dataset writes it."""
        raise DomainError("this dataset only reads", where=self._path)

    def _exists(self) -> bool:
        if is_remote(self._path):
            return True
        return Path(self._path).exists()
