"""What is kept in versions, in a folder or in an object store."""

from __future__ import annotations

from pathlib import Path, PurePosixPath
from typing import Any, Generic, TypeVar

from kedro.io.core import AbstractVersionedDataset, Version, get_protocol_and_path

from tire_pipeline.datasets.storage.files_at import Files, files_at
from tire_pipeline.files.objects import Objects

Kept = TypeVar("Kept")


class VersionedDataset(AbstractVersionedDataset[Kept, Kept], Generic[Kept]):
    """A dataset whose versions lie below a local path or an address. Subclasses load and save.

    Parameters
    ----------
    filepath : str
        Local path or address of an object.
    version : kedro.io.Version, optional
        Given by the catalog when ``versioned: true``.
    metadata : dict, optional
        For kedro-viz.
    """

    def __init__(
        self,
        *,
        filepath: str,
        version: Version | None = None,
        metadata: dict[str, Any] | None = None,
    ) -> None:
        self._protocol, path = get_protocol_and_path(filepath)
        self._address = "" if self._protocol == "file" else f"{self._protocol}://"
        if self._address:
            objects = Objects(self._address)
            super().__init__(
                PurePosixPath(path), version, exists_function=objects.exists, glob_function=objects.glob
            )
        else:
            super().__init__(PurePosixPath(path), version)
        self.metadata = metadata

    def _place(self, path: PurePosixPath | Path) -> tuple[str, str]:
        """Folder, as a path or an address, and name of a version's file."""
        return f"{self._address}{path.parent}", path.name

    def _files(self, path: PurePosixPath | Path) -> tuple[Files | Objects, str]:
        """The files beside a version's file, and its name."""
        folder, name = self._place(path)
        return files_at(folder), name

    def _former(self, suffix: str) -> tuple[str, str] | None:
        """Folder and name of the newest file that a former version of this project stored, if there is one.

        Its name differs in the suffix only.
        """
        former = self._filepath.with_suffix(suffix)
        found = max(map(str, self._glob_function(str(former / "*" / former.name))), default=None)
        return None if found is None else self._place(former / found.split("/")[-2] / former.name)

    def _describe(self) -> dict[str, Any]:
        return {"filepath": self._filepath, "version": self._version}
