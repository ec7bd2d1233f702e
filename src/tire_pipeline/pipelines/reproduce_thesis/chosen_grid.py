"""Which grid the pipeline is built with: that of the run's configuration.

Kedro builds pipelines without looking at parameters. This hook is called before it does, and passes the
parameter ``reproduce_thesis.grid`` on; without a run (``kedro registry list``) the whole grid is shown.
"""

from __future__ import annotations

from typing import Any

from kedro.framework.hooks import hook_impl
from kedro.framework.project import pipelines

from tire_pipeline.thesis.parameters import GridParameters

_CHOSEN = {"grid": GridParameters()}


def chosen_grid() -> GridParameters:
    """The grid of the run."""
    return _CHOSEN["grid"]


class ThesisGridHooks:
    """Passes the run's grid on to the pipeline."""

    @hook_impl
    def after_context_created(self, context: Any) -> None:
        """Read the grid; pipelines that were built with another one are rebuilt."""
        parameters = context.config_loader["parameters"].get("reproduce_thesis") or {}
        grid = GridParameters.model_validate(parameters.get("grid") or {})
        if grid != _CHOSEN["grid"]:
            _CHOSEN["grid"] = grid
            if pipelines._is_data_loaded:
                pipelines.configure(pipelines._pipelines_module)
