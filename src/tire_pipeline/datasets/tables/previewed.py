"""Tables whose preview in kedro-viz has the digits that a person reads."""

from __future__ import annotations

import pandas as pd
from kedro_datasets._typing import TablePreview
from kedro_datasets.pandas import ParquetDataset

_PREVIEWED_DIGITS = 4


def few_digits(shown: TablePreview) -> TablePreview:
    """Return a preview of Kedro's with four significant digits of each float.

    Examples
    --------
    >>> few_digits({"index": [0], "columns": ["PKY1", "files"], "data": [[-17.340312345, 3648]]})["data"]
    [[-17.34, 3648]]
    """
    table = pd.DataFrame(shown["data"], shown["index"], shown["columns"])
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
        return few_digits(super().preview(nrows))
