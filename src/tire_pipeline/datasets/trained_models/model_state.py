"""Trained models as plain numbers: NPZ with a JSON part and a checksum, never pickle."""

from __future__ import annotations

from typing import Any

from tire_pipeline.datasets.storage.files_at import files_at
from tire_pipeline.datasets.storage.versioned import VersionedDataset
from tire_pipeline.files.state_files import pack_state, unpack_state

__all__ = ["StateDataset", "pack_state", "unpack_state"]


class StateDataset(VersionedDataset[dict[str, Any]]):
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

    def save(self, data: dict[str, Any]) -> None:
        """Write the state in one step."""
        files, name = self._files(self._get_save_path())
        files.write(name, pack_state(data))

    def load(self) -> dict[str, Any]:
        """Read the state back, arrays and all."""
        folder, name = self._place(self._get_load_path())
        return unpack_state(files_at(folder).read(name), where=f"{folder}/{name}")
