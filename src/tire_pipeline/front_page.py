"""The front page is made anew after every run."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from kedro.framework.hooks import hook_impl

from tire_pipeline.datasets import HtmlPageDataset
from tire_pipeline.reporting.front import FRONT, front_page


class FrontPageHooks:
    """Writes ``data/08_reporting/index.html``, which links all reports."""

    def __init__(self) -> None:
        self._folder: Path | None = None

    @hook_impl
    def after_context_created(self, context: Any) -> None:
        """Remember where the reports lie."""
        data = context.config_loader["globals"].get("data", "data")
        self._folder = Path(context.project_path) / data / "08_reporting"

    @hook_impl(trylast=True)
    def after_pipeline_run(self) -> None:
        """Link what is there now, and say where."""
        if self._folder is not None:
            self._folder.mkdir(parents=True, exist_ok=True)
            page = self._folder / FRONT
            HtmlPageDataset(filepath=str(page)).save(front_page(self._folder))
            print(f"all reports: {page}")
