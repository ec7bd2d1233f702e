"""Tables whose preview in kedro-viz is for a person: few digits, and every character is seen."""

from __future__ import annotations

import pandas as pd
from kedro_datasets._typing import TablePreview

from tire_pipeline.datasets.storage.files_at import files_at
from tire_pipeline.datasets.storage.sealed import made_again, parquet_as_sealed, sealed_parquet
from tire_pipeline.datasets.storage.versioned import VersionedDataset
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


def first_rows(table: pd.DataFrame, nrows: int) -> TablePreview:
    """The first rows of a table as such a preview; what is missing is empty."""
    first = table.head(nrows).astype(object)
    shown = first.where(first.notna(), None)
    return readable(TablePreview(shown.to_dict(orient="split")))


def _rounded(value: float) -> float:
    return float(f"{value:.{_PREVIEWED_DIGITS}g}")


class ParquetTableDataset(VersionedDataset[pd.DataFrame]):
    """A table as one Parquet file that holds its own hash, with a preview for a person.

    Parameters
    ----------
    filepath : str
        Local path or address of an object.
    version : kedro.io.Version, optional
        Given by the catalog when ``versioned: true``.
    metadata : dict, optional
        For kedro-viz.

    Raises
    ------
    DomainError
        On loading: the file is not what was stored.
    """

    def save(self, data: pd.DataFrame) -> None:
        """Write the table."""
        files, name = self._files(self._get_save_path())
        files.write(name, sealed_parquet(data))

    def load(self) -> pd.DataFrame:
        """The table as it was saved; so far, what a former version of this project stored, too."""
        folder, name = self._place(self._get_load_path())
        return parquet_as_sealed(files_at(folder).read(name), f"{folder}/{name}", made_again(name))

    def preview(self, nrows: int = 5) -> TablePreview:
        """Return the first rows.

        Parameters
        ----------
        nrows : int
        """
        return first_rows(self.load(), nrows)
