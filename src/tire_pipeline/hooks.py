"""What happens around a run: half-written results go, and the user is told where to look."""

from __future__ import annotations

import contextlib
import json
import logging
import os
import shutil
from pathlib import Path
from typing import Any

from kedro.framework.hooks import hook_impl
from kedro.io.core import AbstractVersionedDataset

from tire_pipeline.datasets.text_folder import TextFolderDataset
from tire_pipeline.errors import DomainError

LOG = logging.getLogger(__name__)


def _local_versions(catalog: Any, pipeline: Any, version: str) -> list[Path]:
    """Folders into which this run writes versioned results, on the local disk."""
    folders = []
    for name in sorted(pipeline.outputs() | pipeline.all_inputs() | pipeline.all_outputs()):
        if name.startswith(("params:", "parameters")) or name not in catalog:
            continue
        dataset = catalog.get(name)
        inside = isinstance(dataset, AbstractVersionedDataset) and dataset._version is not None
        if inside and getattr(dataset, "_protocol", "file") == "file":
            folders.append(Path(str(dataset._filepath)) / version)
    return folders


class RunLedgerHooks:
    """Takes back what a run wrote when it fails or is killed.

    Before a run, its versions are noted in ``<data>/.runs/<version>.json``. A run that ends well
    deletes the note. A run that fails deletes its own versions and the note. A run that was killed
    leaves the note behind, and the next run deletes that run's versions before it reads anything:
    nothing half-written is ever loaded.
    """

    def __init__(self) -> None:
        self._ledger: Path | None = None

    @hook_impl
    def after_context_created(self, context: Any) -> None:
        """Remember where the data lies."""
        data = context.config_loader["globals"].get("data", "data")
        self._folder = Path(context.project_path) / data / ".runs"

    @hook_impl(tryfirst=True)
    def before_pipeline_run(self, run_params: dict[str, Any], pipeline: Any, catalog: Any) -> None:
        """Clear up after killed runs, then open this run's note."""
        self.clear_up()
        version = run_params["run_id"]
        folders = _local_versions(catalog, pipeline, version)
        note = {"pid": os.getpid(), "version": version, "folders": [str(f) for f in folders]}
        self._folder.mkdir(parents=True, exist_ok=True)
        self._ledger = self._folder / f"{version.replace(':', '.')}.json"
        self._ledger.write_text(json.dumps(note, indent=1), encoding="utf-8")

    @hook_impl
    def after_pipeline_run(self) -> None:
        """The run ended well: its results may be trusted."""
        if self._ledger is not None:
            self._ledger.unlink(missing_ok=True)

    @hook_impl
    def on_pipeline_error(self) -> None:
        """The run failed: what it wrote goes, so that no later run trusts it."""
        if self._ledger is not None:
            take_back(self._ledger)

    def clear_up(self) -> None:
        """Take back what killed runs left."""
        for ledger in sorted(self._folder.glob("*.json")):
            try:
                pid = int(json.loads(ledger.read_text(encoding="utf-8"))["pid"])
            except (ValueError, KeyError, TypeError):
                pid = -1
            if pid != os.getpid() and not _alive(pid):
                LOG.warning("An earlier run (%s) was killed; its results are taken back.", ledger.stem)
                take_back(ledger)


def take_back(ledger: Path) -> None:
    """Delete the versions that a run wrote, then its note."""
    try:
        folders = json.loads(ledger.read_text(encoding="utf-8"))["folders"]
    except (ValueError, KeyError, TypeError):
        folders = []
    for folder in map(Path, folders):
        shutil.rmtree(folder, ignore_errors=True)
        with contextlib.suppress(OSError):
            folder.parent.rmdir()  # only if no version is left
    ledger.unlink(missing_ok=True)


def _alive(pid: int) -> bool:
    if pid <= 0:
        return False
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        return True
    return True


class FolderHooks:
    """Names the node in every error, and checks that the data folder can be written before work begins."""

    @hook_impl
    def after_context_created(self, context: Any) -> None:
        """Make the data folder if need be; say so plainly if that is not possible."""
        data = Path(context.project_path) / context.config_loader["globals"].get("data", "data")
        try:
            data.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise DomainError(
                f"the data folder cannot be made ({error.strerror})",
                where=str(data),
                todo="make it writable, or set `data` in conf/local/globals.yml",
            ) from error

    @hook_impl
    def before_pipeline_run(self, pipeline: Any, catalog: Any) -> None:
        """Refuse to write into folders of the user before anything is written at all."""
        for name in sorted(pipeline.all_outputs()):
            dataset = catalog.get(name) if name in catalog else None
            if isinstance(dataset, TextFolderDataset):
                dataset.check()

    @hook_impl
    def on_node_error(self, error: Exception, node: Any) -> None:
        """Add the node's name to what the user reads."""
        error.add_note(f"node '{node.name}' failed")


class SignpostHooks:
    """After a run, says where its results are."""

    SIGNS = (
        ("evaluation_report", "report"),
        ("translated_tir", "translated .tir files"),
        ("ingest_report", "ingest report"),
        ("thesis_page", "page of the thesis"),
    )

    @hook_impl(trylast=True)
    def after_pipeline_run(self, pipeline: Any, catalog: Any) -> None:
        """Print the places of those results that this run made."""
        made = pipeline.all_outputs()
        for name, what in self.SIGNS:
            if name in made:
                dataset = catalog.get(name)
                place = getattr(dataset, "_filepath", None) or getattr(dataset, "_path", None)
                print(f"{what}: {place}")
