"""A large table as Parquet files, and an index that says which they are."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from functools import partial

import pandas as pd

from tire_pipeline.datasets.storage.versioned import VersionedDataset
from tire_pipeline.datasets.tables.table_parts import RUN_AGAIN, read_part
from tire_pipeline.files.packed import as_parquet

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
        files, index = self._files(self._get_save_path())
        parts = list[dict[str, str | int]]()
        for load in data:
            frame = load()
            if len(frame):
                name, content = f"part-{len(parts):06d}.parquet", as_parquet(frame)
                files.write(name, content)
                digest = hashlib.sha256(content).hexdigest()
                parts.append({"name": name, "sha256": digest, "rows": len(frame)})
        files.write(index, json.dumps({"parts": parts}).encode())

    def load(self) -> Loads:
        """A function a part, that reads it."""
        files, index = self._files(self._get_load_path())
        folder, _ = self._place(self._get_load_path())
        parts = json.loads(files.read(index))["parts"]
        return [partial(read_part, folder, part["name"], part["sha256"], RUN_AGAIN) for part in parts]
