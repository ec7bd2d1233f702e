"""Tables whose preview in kedro-viz has the digits that a person reads."""

from __future__ import annotations

import pandas as pd
from kedro_datasets._typing import TablePreview
from kedro_datasets.pandas import ParquetDataset

_PREVIEWED_DIGITS = 4


def preview_of(table: pd.DataFrame) -> TablePreview:
    """Return a table as kedro-viz shows it: floats with four significant digits.

    Examples
    --------
    >>> preview_of(pd.DataFrame({"PKY1": [-17.340312345], "files": [3648]}))["data"]
    [[-17.34, 3648]]
    """
    floats = table.select_dtypes("float")
    return TablePreview(table.assign(**floats.map(_rounded)).to_dict(orient="split"))


def _rounded(value: float) -> float:
    return float(f"{value:.{_PREVIEWED_DIGITS}g}")


class ParquetTableDataset(ParquetDataset):
    """``pandas.ParquetDataset`` with a preview of few digits."""

    def preview(self, nrows: int = 5) -> TablePreview:
        """Return the first rows.

        Parameters
        ----------
        nrows : int
        """
        shown = super().preview(nrows)
        return preview_of(pd.DataFrame(shown["data"], shown["index"], shown["columns"]))
