"""The table of all files read so far and its manifest, replaced together in one step."""

from __future__ import annotations

import hashlib
import io
from dataclasses import replace
from pathlib import Path
from typing import Any

import pandas as pd
from kedro.io.core import AbstractDataset

from tire_pipeline.datasets._one_at_a_time import held, refuse_other_revision, replace_unless_changed
from tire_pipeline.datasets.files_at import Files, files_at
from tire_pipeline.errors import DomainError
from tire_pipeline.objects import Objects
from tire_pipeline.retraining.ingest import Store
from tire_pipeline.retraining.manifest import Manifest

_MANIFEST = "manifest.json"
_TODO = "delete this folder: the next run reads all files again"


class IngestStoreDataset(AbstractDataset[Store, Store]):
    """A folder with ``manifest.json`` and the one ``table-*.parquet`` that it names.

    The table is written under a new name first; renaming the manifest is the single step that makes it
    count. In an object store the manifest is replaced only if it is still the one that was read. Whatever is
    killed before that leaves the old state, and a stray table that the next save removes.

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
        folder = files_at(self._path)
        for _ in range(3):  # the table may be replaced between the two reads
            manifest, table, _ = self._manifest()
            if table is None:
                return Store()
            path = f"{self._path}/{table['name']}"
            try:
                content = folder.read(table["name"])
            except FileNotFoundError:
                continue
            if hashlib.sha256(content).hexdigest() != table["sha256"]:
                raise DomainError("the stored table is damaged", where=path, todo=_TODO)
            return Store(manifest, pd.read_parquet(io.BytesIO(content)))
        raise DomainError("the table that the manifest names is gone", where=self._path, todo=_TODO)

    def manifest(self) -> Manifest:
        """The manifest alone."""
        return self._manifest()[0]

    def save(self, data: Store) -> None:
        """Store both, or neither."""
        folder = files_at(self._path)
        with held(folder):
            present, table, stamp = self._manifest()
            refuse_other_revision(present.revision, data.manifest.revision, self._path)
            if table is not None and data.manifest == present:
                return
            if table is None or data.manifest.sequence != present.sequence:
                table = self._write_table(folder, data)
            new = replace(data.manifest, revision=present.revision + 1)
            content = new.to_json(table=table)
            replace_unless_changed(folder, _MANIFEST, content, stamp)
            strays = (n for n in folder.names() if _is_table(n) and n != table["name"])
            folder.delete(strays)

    def _write_table(self, folder: Files | Objects, data: Store) -> dict[str, str]:
        buffer = io.BytesIO()
        data.table.to_parquet(buffer, index=False)
        content = buffer.getvalue()
        digest = hashlib.sha256(content).hexdigest()
        name = f"table-{data.manifest.sequence:06d}-{data.manifest.revision + 1}.parquet"
        if isinstance(folder, Objects):  # two writers at once must not have one name
            name = f"table-{data.manifest.sequence:06d}-{digest[:16]}.parquet"
        folder.write(name, content)
        return {"name": name, "sha256": digest}

    def _manifest(self) -> tuple[Manifest, dict[str, str] | None, str | None]:
        folder, path = files_at(self._path), f"{self._path}/{_MANIFEST}"
        try:
            content, stamp = folder.read_stamped(_MANIFEST)
        except FileNotFoundError:
            return Manifest(), None, None
        manifest, more = Manifest.from_json(content, where=path)
        table = more.get("table")
        if not (isinstance(table, dict) and set(table) == {"name", "sha256"} and _plain(str(table["name"]))):
            raise DomainError("the manifest of files is damaged", where=path, todo=_TODO)
        return manifest, {str(key): str(value) for key, value in table.items()}, stamp

    def _exists(self) -> bool:
        return files_at(self._path).exists(_MANIFEST)

    def _describe(self) -> dict[str, Any]:
        return {"path": self._path}


def _is_table(name: str) -> bool:
    return name.startswith("table-") and name.endswith(".parquet") and "/" not in name


def _plain(name: str) -> bool:
    return Path(name).name == name and name.startswith("table-") and name.endswith(".parquet")
