"""Files that arrived since the last run, found with the catalog's folders and the rules of the retraining."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Protocol

from kedro.framework.session import KedroSession
from kedro.framework.startup import bootstrap_project

from tire_pipeline.datasets import FolderDataset, IngestStoreDataset
from tire_pipeline.retraining import FolderDifference, settled_difference
from tire_pipeline.retraining.train_and_release import RetrainParameters


class ArrivalSession(Protocol):
    """What is needed to open the catalog."""

    env: str | None
    conf_source: str | None
    parameters: dict[str, Any]


def new_files_of(root: Path, config: ArrivalSession) -> FolderDifference:
    """Compare the folder with the manifest; hashes only what looks different.

    Parameters
    ----------
    root : Path
        Of the project.
    config
        Environment and parameters, as for the run.
    """
    bootstrap_project(root)
    session = KedroSession.create(
        project_path=root,
        env=config.env,
        conf_source=config.conf_source,
        runtime_params=dict(config.parameters),
    )
    with session:
        context = session.load_context()
        parameters = RetrainParameters(**context.config_loader["parameters"]["retrain"])
        folder, store = context.catalog.get("tir_folder"), context.catalog.get("ingested")
    if not (isinstance(folder, FolderDataset) and isinstance(store, IngestStoreDataset)):
        raise TypeError("the catalog's `tir_folder` and `ingested` have other types")
    return settled_difference(
        folder.load(),
        store.manifest(),
        settle_seconds=parameters.settle_seconds,
        most_wait_seconds=parameters.settle_seconds,
    )
