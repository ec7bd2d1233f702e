"""A large table as Parquet files, and an index that says which they are."""

from __future__ import annotations

from collections.abc import Callable

import pandas as pd

from tire_pipeline.datasets.storage.versioned import VersionedDataset
from tire_pipeline.datasets.tables.indexed_frames import parts_of, write_parts

Loads = list[Callable[[], pd.DataFrame]]


class FramePartsDataset(VersionedDataset[Loads]):
    """Saves a table part by part, each when it is asked for, and loads the functions that read the parts.

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

    def save(self, data: Loads) -> None:
        """Write the parts, then the index; a part without rows is left out."""
        write_parts(*self._place(self._get_save_path()), (frame for load in data if len(frame := load())))

    def load(self) -> Loads:
        """A function a part, that reads it."""
        return [load for _, load in parts_of(*self._place(self._get_load_path()))]
