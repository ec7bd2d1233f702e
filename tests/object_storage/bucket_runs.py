"""Runs of Kedro whose data lie in a bucket."""

from __future__ import annotations

from pathlib import Path

from kedro.framework.session import KedroSession
from kedro.framework.startup import bootstrap_project

ROOT = Path(__file__).resolve().parents[2]


def run_here(conf: Path, *pipelines: str, **parameters: object) -> None:
    """A run in this process: one of its own takes long to start."""
    bootstrap_project(ROOT)
    with KedroSession.create(
        project_path=ROOT, env="small", conf_source=str(conf), runtime_params=parameters
    ) as session:
        session.run(pipeline_names=list(pipelines))
