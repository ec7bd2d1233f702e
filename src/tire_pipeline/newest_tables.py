"""The newest of each table that a person reads, as a plain file."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

from kedro.framework.hooks import hook_impl
from kedro.io.core import AbstractVersionedDataset

from tire_pipeline.atomic import replaced_file

FOLDER = "tables"


class NewestTablesHooks:
    """Copies the CSV tables that a run made to ``data/08_reporting/tables``."""

    def __init__(self) -> None:
        self._folder: Path | None = None

    @hook_impl
    def after_context_created(self, context: Any) -> None:
        """Remember where the reports lie."""
        data = context.config_loader["globals"].get("data", "data")
        self._folder = Path(context.project_path) / data / "08_reporting" / FOLDER

    @hook_impl
    def after_pipeline_run(self, pipeline: Any, catalog: Any) -> None:
        """Copy them; the versions stay where they are."""
        if self._folder is None:
            return
        for name in sorted(pipeline.all_outputs()):
            newest = _newest_csv(catalog.get(name)) if name in catalog else None
            if newest is not None:
                self._folder.mkdir(parents=True, exist_ok=True)
                with replaced_file(str(self._folder / newest.name)) as temporary:
                    shutil.copyfile(newest, temporary)


def _newest_csv(dataset: Any) -> Path | None:
    if not isinstance(dataset, AbstractVersionedDataset) or dataset._version is None:
        return None
    path = Path(str(dataset._filepath))
    if path.suffix != ".csv" or getattr(dataset, "_protocol", "file") != "file":
        return None
    return max(path.glob(f"*/{path.name}"), default=None)
