"""A versioned file of a format that holds no hash of itself: the hash lies in a file beside it."""

from __future__ import annotations

from typing import Any, ClassVar, Generic

from kedro.io.core import Version

from tire_pipeline.datasets.storage.files_at import files_at
from tire_pipeline.datasets.storage.sealed import made_again
from tire_pipeline.datasets.storage.versioned import Kept, VersionedDataset
from tire_pipeline.errors import DomainError
from tire_pipeline.files.packed import SEAL, is_as_sealed, seal_of


class SealedBesideDataset(VersionedDataset[Kept], Generic[Kept]):
    """Writes and reads all bytes of a file, and refuses those that were not written. Subclasses make them.

    The hash is written first: a version without its file is none. A file without a hash is of a former
    version of this project, or has no versions because it is not written by a run; it is read as it is.

    Parameters
    ----------
    filepath : str
        Local path or address of an object.
    version : kedro.io.Version, optional
        Given by the catalog when ``versioned: true``.
    save_args : dict, optional
        Over ``DEFAULT_SAVE_ARGS``, for what writes the format.
    metadata : dict, optional
        For kedro-viz.
    """

    DEFAULT_SAVE_ARGS: ClassVar[dict[str, Any]] = {}

    def __init__(
        self,
        *,
        filepath: str,
        version: Version | None = None,
        save_args: dict[str, Any] | None = None,
        metadata: dict[str, Any] | None = None,
    ) -> None:
        super().__init__(filepath=filepath, version=version, metadata=metadata)
        self._save_args = {**self.DEFAULT_SAVE_ARGS, **(save_args or {})}

    def _write_sealed(self, content: bytes) -> None:
        files, name = self._files(self._get_save_path())
        if self._version is not None:
            files.write(name + SEAL, seal_of(content))
        files.write(name, content)

    def _read_sealed(self) -> bytes:
        folder, name = self._place(self._get_load_path())
        files = files_at(folder)
        content = files.read(name)
        try:
            seal = files.read(name + SEAL) if self._version is not None else None
        except FileNotFoundError:
            seal = None
        if seal is not None and not is_as_sealed(content, seal):
            raise DomainError("this stored file is damaged", where=f"{folder}/{name}", todo=made_again(name))
        return content
