"""A tire table as Parquet files of some thousand rows each, and an index that says which they are."""

from __future__ import annotations

import hashlib
import json
from functools import partial

import pandas as pd

from tire_pipeline.datasets.storage.files_at import files_at
from tire_pipeline.datasets.storage.versioned import VersionedDataset
from tire_pipeline.errors import DomainError
from tire_pipeline.files.packed import as_parquet, from_parquet
from tire_pipeline.tire_table.in_pieces import Piece, TableInPieces, numbers_of

RUN_AGAIN = "run again; what lies there is not used"


class TablePartsDataset(VersionedDataset[TableInPieces]):
    """Saves a tire table piece by piece, and loads it to be read piece by piece.

    ``part-*.parquet`` lie beside the index, which is written last: without it nothing there counts. Each part
    can be read by itself, for example with ``pandas.read_parquet``.

    Parameters
    ----------
    filepath : str
        Of the index: local path or address of an object.
    version : kedro.io.Version, optional
        Given by the catalog when ``versioned: true``.
    metadata : dict, optional
        For kedro-viz.

    Raises
    ------
    DomainError
        When a part is read that is gone or was changed.
    """

    def save(self, data: TableInPieces) -> None:
        """Write the parts, then the index."""
        files, index = self._files(self._get_save_path())
        parts = []
        for number, frame in enumerate(data.gathered()):
            name, content = f"part-{number:06d}.parquet", as_parquet(frame)
            files.write(name, content)
            numbers = numbers_of(frame.columns[frame.notna().any()])
            digest = hashlib.sha256(content).hexdigest()
            parts.append({"name": name, "sha256": digest, "rows": len(frame), "numbers": numbers})
        files.write(index, json.dumps({"parts": parts}).encode())

    def load(self) -> TableInPieces:
        """The index; a part is read when it is needed."""
        folder, index = self._place(self._get_load_path())
        parts = json.loads(files_at(folder).read(index))["parts"]
        return TableInPieces(
            tuple(
                Piece(
                    part["rows"],
                    tuple(part["numbers"]),
                    partial(read_part, folder, part["name"], part["sha256"], RUN_AGAIN),
                )
                for part in parts
            )
        )


def read_part(folder: str, name: str, sha256: str, todo: str) -> pd.DataFrame:
    """A part of a table.

    Raises
    ------
    DomainError
        It is gone, or not what was written.
    """
    try:
        content = files_at(folder).read(name)
    except FileNotFoundError as error:
        where = f"{folder}/{name}"
        raise DomainError("this part of the table is missing", where=where, todo=todo) from error
    if hashlib.sha256(content).hexdigest() != sha256:
        raise DomainError("this part of the table is damaged", where=f"{folder}/{name}", todo=todo)
    return from_parquet(content)
