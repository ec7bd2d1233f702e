"""The newest of each table that a person reads, as a plain file."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path
from typing import Any

from kedro.framework.hooks import hook_impl
from kedro.io.core import AbstractVersionedDataset

from tire_pipeline.files.atomic import replaced_file
from tire_pipeline.files.objects import Objects
from tire_pipeline.kedro_runs.data_place import data_place

FOLDER = "tables"


def tables_place(context: Any) -> Path | Objects:
    """Where the newest tables of a project lie."""
    data = data_place(context)
    below = f"08_reporting/{FOLDER}"
    return data.below(below) if isinstance(data, Objects) else data / below


class NewestTablesHooks:
    """Copies the CSV tables that a run made to ``data/08_reporting/tables``."""

    def __init__(self) -> None:
        self._folder: Path | Objects | None = None

    @hook_impl
    def after_context_created(self, context: Any) -> None:
        """Remember where the reports lie."""
        self._folder = tables_place(context)

    @hook_impl
    def after_pipeline_run(self, pipeline: Any, catalog: Any) -> None:
        """Copy them; the versions stay where they are."""
        if self._folder is None:
            return
        for name in sorted(pipeline.all_outputs()):
            dataset = catalog.get(name) if name in catalog else None
            if hasattr(dataset, "write_plain"):
                _write_plain(dataset, self._folder)
                continue
            if isinstance(self._folder, Objects):
                _copy_object(dataset, self._folder)
                continue
            newest = _newest_csv(dataset)
            if newest is not None:
                self._folder.mkdir(parents=True, exist_ok=True)
                with replaced_file(str(self._folder / newest.name)) as temporary:
                    shutil.copyfile(newest, temporary)


def plain_name(dataset: Any) -> str | None:
    """The name that a table has among the newest; None of what is no table for a person."""
    place = str(getattr(dataset, "_filepath", ""))
    return getattr(dataset, "plain_name", place.rsplit("/", 1)[-1] if place.endswith(".csv") else None)


def _write_plain(dataset: Any, folder: Path | Objects) -> None:
    """Write a report that is stored in parts as one CSV, one part after the other."""
    if isinstance(folder, Path):
        with replaced_file(folder / dataset.plain_name) as temporary:
            _write_csv(dataset, temporary)
        return
    with tempfile.TemporaryDirectory() as scratch:
        written = Path(scratch, "plain.csv")
        _write_csv(dataset, written)
        folder.write_file(dataset.plain_name, written)


def _write_csv(dataset: Any, path: Path) -> None:
    with path.open("w", encoding="utf-8", newline="") as stream:
        dataset.write_plain(stream)


def _copy_object(dataset: Any, folder: Objects) -> None:
    if not isinstance(dataset, AbstractVersionedDataset) or dataset._version is None:
        return
    path = str(dataset._filepath)
    protocol = getattr(dataset, "_protocol", "file")
    if not path.endswith(".csv") or protocol == "file":
        return
    versions = Objects(f"{protocol}://{path}")
    name = path.rsplit("/", 1)[-1]
    newest = max((each for each in versions.names() if each.endswith(f"/{name}")), default=None)
    if newest is not None:
        folder.write(name, versions.read(newest))


def _newest_csv(dataset: Any) -> Path | None:
    if not isinstance(dataset, AbstractVersionedDataset) or dataset._version is None:
        return None
    path = Path(str(dataset._filepath))
    if path.suffix != ".csv" or getattr(dataset, "_protocol", "file") != "file":
        return None
    return max(path.glob(f"*/{path.name}"), default=None)
