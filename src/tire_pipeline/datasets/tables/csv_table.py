"""CSV tables that a person may open in a spreadsheet, whatever their texts are."""

from __future__ import annotations

import io
from typing import Any, ClassVar

import pandas as pd
from kedro_datasets._typing import TablePreview

from tire_pipeline.datasets.storage.sealed_beside import SealedBesideDataset
from tire_pipeline.datasets.tables.previewed import first_rows
from tire_pipeline.pages.safe_csv import original_table, safe_table


class CsvTableDataset(SealedBesideDataset[pd.DataFrame]):
    """A table as a CSV whose texts begin no formula in a spreadsheet; a load gives them as they were.

    See :mod:`tire_pipeline.pages.safe_csv`. A version's hash lies beside it.

    Parameters
    ----------
    filepath : str
        Local path or address of an object.
    version : kedro.io.Version, optional
        Given by the catalog when ``versioned: true``.
    save_args : dict, optional
        For ``DataFrame.to_csv``; the index is not written unless they say so.
    metadata : dict, optional
        For kedro-viz.

    Raises
    ------
    DomainError
        On loading: the file is not what was stored.
    """

    DEFAULT_SAVE_ARGS: ClassVar[dict[str, Any]] = {"index": False}

    def load(self) -> pd.DataFrame:
        """The table as it was saved."""
        return original_table(pd.read_csv(io.BytesIO(self._read_sealed())))

    def save(self, data: pd.DataFrame) -> None:
        """Write the table."""
        text = safe_table(data).to_csv(**self._save_args)
        self._write_sealed(text.encode())

    def preview(self, nrows: int = 5) -> TablePreview:
        """Return the first rows, for a person.

        Parameters
        ----------
        nrows : int
        """
        return first_rows(self.load(), nrows)
