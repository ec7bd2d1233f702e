"""A report with a row a file or recording: Parquet files of some thousand rows, and one CSV for a person."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, TextIO

import pandas as pd
from kedro.io.core import Version, VersionNotFoundError
from kedro_datasets._typing import TablePreview

from tire_pipeline.datasets.storage.files_at import files_at
from tire_pipeline.datasets.storage.versioned import VersionedDataset
from tire_pipeline.datasets.tables.indexed_frames import parts_of, write_parts
from tire_pipeline.datasets.tables.previewed import first_rows
from tire_pipeline.files.rows_on_disk import REPORT_ROWS
from tire_pipeline.pages.safe_csv import original_table, safe_table

Frames = Iterable[pd.DataFrame]


@dataclass(frozen=True)
class StoredFrames:
    """Tables that are read one after the other, as often as they are asked for.

    Attributes
    ----------
    read : callable
        Begins to read them.
    """

    read: Callable[[], Iterator[pd.DataFrame]]

    def __iter__(self) -> Iterator[pd.DataFrame]:
        """Each table."""
        return self.read()


class ReportPartsDataset(VersionedDataset[Frames]):
    """Saves a report table by table, each when it is asked for, and loads it to be read table by table.

    ``part-*.parquet`` lie beside the index, which is written last: without it nothing there counts. What a
    former version stored as one CSV is loaded, too.

    Parameters
    ----------
    filepath : str
        Of the index: local path or address of an object.
    version : kedro.io.Version, optional
        Given by the catalog when ``versioned: true``.
    float_format : str, optional
        How numbers stand in the CSV.
    metadata : dict, optional
        For kedro-viz.

    Raises
    ------
    DomainError
        When a part is read that is gone or was changed.
    """

    def __init__(
        self,
        *,
        filepath: str,
        version: Version | None = None,
        float_format: str | None = None,
        metadata: dict[str, Any] | None = None,
    ) -> None:
        super().__init__(filepath=filepath, version=version, metadata=metadata)
        self._float_format = float_format

    @property
    def plain_name(self) -> str:
        """Name of the CSV for a person."""
        return self._filepath.with_suffix(".csv").name

    def save(self, data: Frames) -> None:
        """Write the parts, then the index."""
        write_parts(*self._place(self._get_save_path()), data)

    def load(self) -> Frames:
        """The tables; each is read when it is needed."""
        try:
            place = self._place(self._get_load_path())
        except VersionNotFoundError:
            former = self._former(".csv")
            if former is None:
                raise
            return StoredFrames(lambda: _of_csv(*former))
        return StoredFrames(lambda: (load() for _, load in parts_of(*place)))

    def write_plain(self, stream: TextIO) -> None:
        """Write all of it as a CSV whose texts begin no formula in a spreadsheet, part by part."""
        for number, frame in enumerate(self.load()):
            head, digits = number == 0, self._float_format
            safe_table(frame).to_csv(stream, index=False, header=head, float_format=digits)

    def preview(self, nrows: int = 5) -> TablePreview:
        """Return the first rows, for a person.

        Parameters
        ----------
        nrows : int
        """
        return first_rows(next(iter(self.load())), nrows)


def _of_csv(folder: str, name: str) -> Iterator[pd.DataFrame]:
    content = io.BytesIO(files_at(folder).read(name))
    for frame in pd.read_csv(content, chunksize=REPORT_ROWS):
        yield original_table(frame)
