"""A page or text at one fixed place, replaced in one step."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from kedro.io.core import AbstractDataset

from tire_pipeline.atomic import replaced_file


class HtmlPageDataset(AbstractDataset[str, str]):
    """A self-contained HTML page.

    Parameters
    ----------
    filepath : str
        Where it lies.
    metadata : dict, optional
        For kedro-viz.
    """

    def __init__(self, *, filepath: str, metadata: dict[str, Any] | None = None) -> None:
        self._filepath = filepath
        self.metadata = metadata

    def load(self) -> str:
        """The page's text."""
        return Path(self._filepath).read_text(encoding="utf-8")

    def save(self, data: str) -> None:
        """Replace the page in one step."""
        with replaced_file(self._filepath) as temporary:
            temporary.write_text(data, encoding="utf-8")

    def _exists(self) -> bool:
        return Path(self._filepath).exists()

    def _describe(self) -> dict[str, Any]:
        return {"filepath": self._filepath}
