"""CSV tables that a person may open in a spreadsheet, whatever their texts are."""

from __future__ import annotations

import pandas as pd
from kedro_datasets._typing import TablePreview
from kedro_datasets.pandas import CSVDataset

from tire_pipeline.datasets.tables.previewed import readable
from tire_pipeline.pages.safe_csv import original_table, safe_table


class CsvTableDataset(CSVDataset):
    """``pandas.CSVDataset`` whose texts begin no formula in a spreadsheet; a load gives them as they were.

    See :mod:`tire_pipeline.pages.safe_csv`.
    """

    def load(self) -> pd.DataFrame:
        """The table as it was saved."""
        return original_table(super().load())

    def save(self, data: pd.DataFrame) -> None:
        """Write the table."""
        super().save(safe_table(data))

    def preview(self, nrows: int = 5) -> TablePreview:
        """Return the first rows, for a person.

        Parameters
        ----------
        nrows : int
        """
        return readable(super().preview(nrows))
