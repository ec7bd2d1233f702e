"""A tire table as Parquet files of some thousand rows each, and an index that says which they are."""

from __future__ import annotations

from typing import Any

import pandas as pd
from kedro.io.core import VersionNotFoundError

from tire_pipeline.datasets.storage.versioned import VersionedDataset
from tire_pipeline.datasets.tables.indexed_frames import parts_of, write_parts
from tire_pipeline.errors import DomainError
from tire_pipeline.tire_table.in_pieces import Piece, TableInPieces, numbers_of


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
        When a part is read that is gone or was changed; or a former version of this project has stored the
        table, as one Parquet file.
    """

    def save(self, data: TableInPieces) -> None:
        """Write the parts, then the index."""
        write_parts(*self._place(self._get_save_path()), data.gathered(), _numbers)

    def load(self) -> TableInPieces:
        """The index; a part is read when it is needed."""
        try:
            place = self._place(self._get_load_path())
        except VersionNotFoundError:
            if self._former(".parquet"):
                raise DomainError(
                    "a former version stored this table in another form",
                    where=f"{self._address}{self._filepath.with_suffix('.parquet')}",
                    todo="run `kedro run --pipeline ingest_tir` once: it reads the files again",
                ) from None
            raise
        parts = parts_of(*place)
        return TableInPieces(tuple(Piece(part["rows"], tuple(part["numbers"]), load) for part, load in parts))


def _numbers(frame: pd.DataFrame) -> dict[str, Any]:
    return {"numbers": numbers_of(frame.columns[frame.notna().any()])}
