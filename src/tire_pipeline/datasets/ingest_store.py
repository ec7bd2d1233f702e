"""The table of all files read so far and its manifest, replaced together in one step."""

from __future__ import annotations

import hashlib
import io
from dataclasses import replace
from pathlib import Path
from typing import Any

import pandas as pd
from kedro.io.core import AbstractDataset

from tire_pipeline.atomic import replaced_file, write_bytes
from tire_pipeline.datasets._one_at_a_time import locked, refuse_other_revision
from tire_pipeline.errors import DomainError
from tire_pipeline.retraining.ingest import Store
from tire_pipeline.retraining.manifest import Manifest

_TODO = "delete this folder: the next run reads all files again"


class IngestStoreDataset(AbstractDataset[Store, Store]):
    """A folder with ``manifest.json`` and the one ``table-*.parquet`` that it names.

    The table is written under a new name first; renaming the manifest is the single step that makes it
    count. Whatever is killed before that leaves the old state, and a stray table that the next save removes.

    Parameters
    ----------
    path : str
        The folder.
    metadata : dict, optional
        For kedro-viz.

    Raises
    ------
    DomainError
        On loading: manifest or table are damaged. On saving: another run was faster.
    """

    def __init__(self, *, path: str, metadata: dict[str, Any] | None = None) -> None:
        self._path = path
        self.metadata = metadata

    def load(self) -> Store:
        """Manifest and table; both empty if nothing was stored yet."""
        folder = Path(self._path)
        for _ in range(3):  # the table may be replaced between the two reads
            manifest, table = self._manifest()
            if table is None:
                return Store()
            path = folder / table["name"]
            try:
                content = path.read_bytes()
            except FileNotFoundError:
                continue
            if hashlib.sha256(content).hexdigest() != table["sha256"]:
                raise DomainError("the stored table is damaged", where=str(path), todo=_TODO)
            return Store(manifest, pd.read_parquet(io.BytesIO(content)))
        raise DomainError("the table that the manifest names is gone", where=str(folder), todo=_TODO)

    def manifest(self) -> Manifest:
        """The manifest alone."""
        return self._manifest()[0]

    def save(self, data: Store) -> None:
        """Store both, or neither."""
        folder = Path(self._path)
        with locked(folder):
            present, table = self._manifest()
            refuse_other_revision(present.revision, data.manifest.revision, folder)
            if table is not None and data.manifest == present:
                return
            if table is None or data.manifest.sequence != present.sequence:
                table = self._write_table(data)
            new = replace(data.manifest, revision=present.revision + 1)
            write_bytes(folder / "manifest.json", new.to_json(table=table))
            for stray in folder.glob("table-*.parquet"):
                if stray.name != table["name"]:
                    stray.unlink(missing_ok=True)

    def _write_table(self, data: Store) -> dict[str, str]:
        name = f"table-{data.manifest.sequence:06d}-{data.manifest.revision + 1}.parquet"
        with replaced_file(Path(self._path) / name) as temporary:
            data.table.to_parquet(temporary, index=False)
            with open(temporary, "rb") as file:
                digest = hashlib.file_digest(file, "sha256").hexdigest()
        return {"name": name, "sha256": digest}

    def _manifest(self) -> tuple[Manifest, dict[str, str] | None]:
        path = Path(self._path) / "manifest.json"
        try:
            content = path.read_bytes()
        except FileNotFoundError:
            return Manifest(), None
        manifest, more = Manifest.from_json(content, where=str(path))
        table = more.get("table")
        if not (isinstance(table, dict) and set(table) == {"name", "sha256"} and _plain(str(table["name"]))):
            raise DomainError("the manifest of files is damaged", where=str(path), todo=_TODO)
        return manifest, {str(key): str(value) for key, value in table.items()}

    def _exists(self) -> bool:
        return (Path(self._path) / "manifest.json").exists()

    def _describe(self) -> dict[str, Any]:
        return {"path": self._path}


def _plain(name: str) -> bool:
    return Path(name).name == name and name.startswith("table-") and name.endswith(".parquet")
