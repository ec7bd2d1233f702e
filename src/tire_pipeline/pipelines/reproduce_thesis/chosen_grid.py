"""Which grid the pipeline is built with: that of the run's configuration.

Kedro builds pipelines without looking at parameters, so a hook passes ``reproduce_thesis.grid`` on before it
does. Without a run (``kedro registry list``) the whole grid is shown.
"""

from __future__ import annotations

from typing import Any

from kedro.framework.project import pipelines

from tire_pipeline.thesis.parameters import GridParameters

_CHOSEN_GRID = {"grid": GridParameters()}


def chosen_grid() -> GridParameters:
    """The grid of the run."""
    return _CHOSEN_GRID["grid"]


def choose_grid(parameters: dict[str, Any]) -> None:
    """Take another grid; pipelines that were built with the one before are rebuilt."""
    grid = GridParameters.model_validate(parameters)
    if grid != _CHOSEN_GRID["grid"]:
        _CHOSEN_GRID["grid"] = grid
        if pipelines._is_data_loaded:
            pipelines.configure(pipelines._pipelines_module)
