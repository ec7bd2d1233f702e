"""Trained models as plain numbers: NPZ with a JSON part and a checksum, never pickle."""

from __future__ import annotations

from pathlib import Path, PurePosixPath
from typing import Any

from kedro.io.core import AbstractVersionedDataset, Version, get_protocol_and_path

from tire_pipeline.atomic import replaced_file
from tire_pipeline.objects import Objects
from tire_pipeline.state_files import pack_state, unpack_state

__all__ = ["StateDataset", "pack_state", "unpack_state"]


class StateDataset(AbstractVersionedDataset[dict[str, Any], dict[str, Any]]):
    """Saves ``{name: array, number, text, list or dict}`` and refuses to load what was tampered with.

    Arrays go into ``.npy`` members (``allow_pickle=False``), everything else into one JSON member,
    and a SHA-256 over all of it into a third.

    Parameters
    ----------
    filepath : str
        Local path or address of an object.
    version : kedro.io.Version, optional
        Given by the catalog when ``versioned: true``.
    metadata : dict, optional
        For kedro-viz.

    Raises
    ------
    DomainError
        On loading a file that is damaged or was changed.
    """

    def __init__(
        self,
        *,
        filepath: str,
        version: Version | None = None,
        metadata: dict[str, Any] | None = None,
    ) -> None:
        self._protocol, path = get_protocol_and_path(filepath)
        if self._protocol == "file":
            super().__init__(PurePosixPath(path), version)
        else:
            self._objects = Objects(f"{self._protocol}://")
            super().__init__(
                PurePosixPath(path),
                version,
                exists_function=self._objects.exists,
                glob_function=self._objects.glob,
            )
        self.metadata = metadata

    def save(self, data: dict[str, Any]) -> None:
        """Write the state in one step."""
        if self._protocol != "file":
            self._objects.write(str(self._get_save_path()), pack_state(data))
            return
        path = Path(self._get_save_path())
        with replaced_file(path) as temporary:
            temporary.write_bytes(pack_state(data))

    def load(self) -> dict[str, Any]:
        """Read the state back, arrays and all."""
        if self._protocol != "file":
            place = str(self._get_load_path())
            return unpack_state(self._objects.read(place), where=f"{self._protocol}://{place}")
        path = Path(self._get_load_path())
        return unpack_state(path.read_bytes(), where=str(path))

    def _describe(self) -> dict[str, Any]:
        return {"filepath": self._filepath, "version": self._version}
