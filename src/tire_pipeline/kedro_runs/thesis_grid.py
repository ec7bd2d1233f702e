"""The grid of ``reproduce_thesis``, passed from the run's configuration to the pipeline."""

from __future__ import annotations

from typing import Any

from kedro.framework.hooks import hook_impl


class ThesisGridHooks:
    """Passes the run's grid on to the pipeline."""

    @hook_impl
    def after_context_created(self, context: Any) -> None:
        """Read the grid."""
        from tire_pipeline.pipelines.reproduce_thesis.chosen_grid import choose_grid  # slow to import

        parameters = context.config_loader["parameters"].get("reproduce_thesis") or {}
        choose_grid(parameters.get("grid") or {})
