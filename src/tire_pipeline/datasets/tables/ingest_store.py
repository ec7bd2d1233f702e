"""The table of all files read so far, in parts, and the manifest that says which parts count."""

from __future__ import annotations

import hashlib
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from tire_pipeline.datasets.storage.at_path import DatasetAtPath
from tire_pipeline.datasets.storage.files_at import Files, files_at
from tire_pipeline.datasets.storage.one_at_a_time import held, refuse_other_revision, replace_unless_changed
from tire_pipeline.datasets.storage.sealed import json_as_sealed, sealed_json
from tire_pipeline.datasets.tables.indexed_frames import read_part
from tire_pipeline.errors import DomainError
from tire_pipeline.files.objects import Objects
from tire_pipeline.files.packed import as_parquet
from tire_pipeline.retraining.scan.manifest import Manifest
from tire_pipeline.retraining.stored_table.in_steps import Store
from tire_pipeline.retraining.stored_table.partition import Partition
from tire_pipeline.tire_table.in_pieces import Piece

_MANIFEST = "manifest.json"
_TODO = "delete this folder: the next run reads all files again"


class IngestStoreDataset(DatasetAtPath[Store, Store]):
    """A folder with ``manifest.json`` and the ``part-*.parquet`` that it names.

    Parts that are new are written first, under names that no other content has; renaming the manifest is the
    single step that makes them count. In an object store the manifest is replaced only if it is still the
    one that was read. Whatever is killed before that leaves the old state, and stray parts that the next
    save removes. Loading reads the manifest; a part is read when it is needed.

    Parameters
    ----------
    path : str
        The folder.
    metadata : dict, optional
        For kedro-viz.

    Raises
    ------
    DomainError
        On loading: the manifest is damaged, or a part when it is read. On saving: another run was faster.
    """

    def load(self) -> Store:
        """Manifest and table; both empty if nothing was stored yet."""
        return self._read()

    def manifest(self) -> Manifest:
        """The manifest alone."""
        return self._read().manifest

    def save(self, data: Store) -> None:
        """Store both, or neither."""
        folder = files_at(self._path)
        with held(folder):
            content, stamp = self._stamped(folder)
            present = Manifest() if content is None else Manifest.without_files(content, self._manifest_path)
            refuse_other_revision(present.revision, data.manifest.revision, self._path)
            if content is not None and data.manifest.is_in(content):
                return
            del content  # as large as all that is stored below
            parts = {n: _stored(folder, n, piece) for n, piece in sorted(data.partition.parts.items())}
            new = replace(data.manifest, revision=present.revision + 1)
            table = {"count": data.partition.count, "parts": parts}
            replace_unless_changed(folder, _MANIFEST, sealed_json(new.to_json(table=table)), stamp)
            named = {part[0] for part in parts.values()}
            folder.delete(name for name in folder.names() if _is_part(name) and name not in named)

    @property
    def _manifest_path(self) -> str:
        return f"{self._path}/{_MANIFEST}"

    def _stamped(self, folder: Files | Objects) -> tuple[bytes | None, str | None]:
        """The manifest as it is stored, and the stamp of its file; None if there is none."""
        try:
            content, stamp = folder.read_stamped(_MANIFEST)
        except FileNotFoundError:
            return None, None
        return json_as_sealed(content, self._manifest_path, _TODO), stamp

    def _read(self) -> Store:
        content, _ = self._stamped(files_at(self._path))
        if content is None:
            return Store()
        manifest, more = Manifest.from_json(content, where=self._manifest_path)
        try:
            return Store(manifest, self._partition(more.get("table")))
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            if isinstance(error, DomainError):
                raise
            raise DomainError(
                "the manifest of files is damaged", where=self._manifest_path, todo=_TODO
            ) from error

    def _partition(self, table: Any) -> Partition:
        if "name" in table:  # of before there were parts: one file
            piece = self._piece(table["name"], table["sha256"], 0, ())
            frame = piece.load()
            return Partition(1, {0: replace(Piece.of(frame), stored=piece.stored)} if len(frame) else {})
        parts = {int(number): self._piece(*part) for number, part in table["parts"].items()}
        return Partition(int(table["count"]), parts)

    def _piece(self, name: str, sha256: str, rows: int, numbers: list[str] | tuple[str, ...]) -> Piece:
        if not _is_part(name):
            raise ValueError(name)
        load = partial(read_part, self._path, name, sha256, _TODO)
        return Piece(int(rows), tuple(map(str, numbers)), load, (name, sha256))

    def _exists(self) -> bool:
        return files_at(self._path).exists(_MANIFEST)


def _stored(folder: Files | Objects, number: int, piece: Piece) -> tuple[str, str, int, tuple[str, ...]]:
    """Name, SHA-256, rows and number columns of a part; it is written unless it is there already."""
    if piece.stored is None:
        content = as_parquet(piece.load())
        digest = hashlib.sha256(content).hexdigest()
        name = f"part-{number:06d}-{digest[:16]}.parquet"
        folder.write(name, content)
        return name, digest, piece.rows, piece.numbers
    return *piece.stored, piece.rows, piece.numbers


def _is_part(name: str) -> bool:
    plain = Path(name).name == name and name.startswith(("part-", "table-"))
    return plain and name.endswith(".parquet")
