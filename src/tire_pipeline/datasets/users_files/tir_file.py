"""One tire property file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import fsspec
from kedro.io.core import AbstractDataset, get_protocol_and_path

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.tir import read_tir, write_tir


class TirDataset(AbstractDataset[TireModel, TireModel]):
    """Loads and saves a ``.tir`` file as a :class:`~tire_pipeline.magic_formula.TireModel`.

    Parameters
    ----------
    filepath : str
        Local path or fsspec address.
    metadata : dict, optional
        For kedro-viz.

    Raises
    ------
    kedro.io.DatasetError
        With a :class:`~tire_pipeline.errors.TirError` as cause, when the file cannot be read.
    """

    def __init__(self, *, filepath: str, metadata: dict[str, Any] | None = None) -> None:
        self._protocol, self._path = get_protocol_and_path(filepath)
        self.metadata = metadata

    def load(self) -> TireModel:
        """Read the file; units become SI here and nowhere else."""
        if self._protocol == "file":
            return read_tir(self._path)
        with fsspec.filesystem(self._protocol).open(self._path, "rb") as file:
            return read_tir(file.read(), path=self._path)

    def save(self, data: TireModel) -> None:
        """Write the file, all or nothing."""
        Path(self._path).parent.mkdir(parents=True, exist_ok=True)
        write_tir(data, self._path, overwrite=True)

    def _exists(self) -> bool:
        return bool(fsspec.filesystem(self._protocol).exists(self._path))

    def _describe(self) -> dict[str, Any]:
        return {"filepath": self._path, "protocol": self._protocol}
