"""Tables whose preview in kedro-viz is for a person: few digits, and every character is seen."""

from __future__ import annotations

import pandas as pd
from kedro_datasets._typing import TablePreview
from kedro_datasets.pandas import ParquetDataset

from tire_pipeline.pages.visible_text import visible_texts

_PREVIEWED_DIGITS = 4


def readable(shown: TablePreview) -> TablePreview:
    r"""Return a preview of Kedro's with four significant digits of each float, and every character shown.

    Examples
    --------
    >>> readable({"index": [0], "columns": ["file", "PKY1"], "data": [["\u202ea", -17.340312345]]})["data"]
    [['⟨U+202E⟩a', -17.34]]
    """
    table = pd.DataFrame(shown["data"], shown["index"], shown["columns"])
    floats = table.select_dtypes("float")
    rounded = table.assign(**floats.map(_rounded)).to_dict(orient="split")
    return TablePreview(visible_texts(rounded))


def _rounded(value: float) -> float:
    return float(f"{value:.{_PREVIEWED_DIGITS}g}")


class ParquetTableDataset(ParquetDataset):
    """``pandas.ParquetDataset`` with a preview for a person."""

    def preview(self, nrows: int = 5) -> TablePreview:
        """Return the first rows.

        Parameters
        ----------
        nrows : int
        """
        return readable(super().preview(nrows))
