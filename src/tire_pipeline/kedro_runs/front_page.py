"""The front page is made again after every run."""

from __future__ import annotations

import contextlib
import os
import tempfile
from pathlib import Path
from typing import Any

from kedro.framework.hooks import hook_impl

from tire_pipeline.datasets.text_files.html_page import HtmlPageDataset
from tire_pipeline.files.objects import Objects
from tire_pipeline.kedro_runs.data_place import data_place

_REPORT_FOLDER = "08_reporting"
_BEGINNING = 40_000


def _beginnings(reports: Objects, folder: Path) -> None:
    """The reports' names, and of pages as much as the front page quotes."""
    for name, listed in reports.listing().items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(reports.read(name, _BEGINNING) if name.endswith(".html") else b"")
        os.utime(path, (listed.written, listed.written))


def _has_reports(folder: Path | Objects) -> bool:
    return not folder.is_empty() if isinstance(folder, Objects) else folder.is_dir()


class FrontPageHooks:
    """Writes ``data/08_reporting/index.html``, which links all reports."""

    def __init__(self) -> None:
        self._folder: Path | Objects | None = None
        self._described: dict[str, str] = {}

    @hook_impl
    def after_catalog_created(self, conf_catalog: dict[str, Any]) -> None:
        """Remember what the catalog says of each dataset: tables are listed with it."""
        told = {
            name: (entry.get("metadata") or {}).get("description") for name, entry in conf_catalog.items()
        }
        self._described = {name: text for name, text in told.items() if text}

    @hook_impl
    def after_context_created(self, context: Any) -> None:
        """Remember where the reports lie."""
        data = data_place(context)
        self._folder = data.below(_REPORT_FOLDER) if isinstance(data, Objects) else data / _REPORT_FOLDER

    @hook_impl(trylast=True)
    def after_pipeline_run(self) -> None:
        """Link what is there now, and say where."""
        if self._folder is not None:
            print(f"all reports: {self._make(self._folder)}")

    @hook_impl(tryfirst=True)
    def on_pipeline_error(self) -> None:
        """A run may have drawn a page before it failed: what is quoted of that page is to be what it says.

        It comes before the run's ticket is returned: a run that has lost it writes nothing more.
        """
        with contextlib.suppress(Exception):  # what the run failed of is told
            if self._folder is not None and _has_reports(self._folder):
                self._make(self._folder)

    def _make(self, folder: Path | Objects) -> str:
        """Make the page; where it is."""
        from tire_pipeline.reporting.front import FRONT, front_page  # slow to import

        if isinstance(folder, Objects):
            with tempfile.TemporaryDirectory() as copy:
                _beginnings(folder, Path(copy))
                folder.write(FRONT, front_page(Path(copy), self._described).encode())
            return f"{folder.address}/{FRONT}"
        folder.mkdir(parents=True, exist_ok=True)
        page = str(folder / FRONT)
        HtmlPageDataset(filepath=page).save(front_page(folder, self._described))
        return page
