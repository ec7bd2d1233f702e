"""Which workers a run takes: those of its configuration (docs/how-to/cluster.md)."""

from __future__ import annotations

from typing import Any

from kedro.framework.hooks import hook_impl
from pydantic import ValidationError

from tire_pipeline.cluster.parameters import ClusterParameters
from tire_pipeline.errors import DomainError
from tire_pipeline.tasks import Map, in_processes

_CHOSEN = {"parameters": ClusterParameters()}


def work_map(*, without_cluster: int | None = None) -> Map:
    """Give the run's map.

    Parameters
    ----------
    without_cluster : int, optional
        How many processes are used where there is no cluster; the run's parameter if left out.
    """
    chosen = _CHOSEN["parameters"]
    if chosen.scheduler:
        from tire_pipeline.cluster.dask_map import dask_map

        return dask_map(chosen)
    return in_processes(without_cluster or chosen.processes)


class ClusterHooks:
    """Takes the parameter ``cluster`` of the run, and lets go of the cluster when the run ends."""

    @hook_impl
    def after_context_created(self, context: Any) -> None:
        """Read the parameters; a wrong one stops the run before it begins."""
        given = context.config_loader["parameters"].get("cluster") or {}
        try:
            _CHOSEN["parameters"] = ClusterParameters.model_validate(given)
        except ValidationError as error:
            raise DomainError(
                str(error), where="cluster", todo="correct it in conf/*/parameters.yml or --params"
            ) from error

    @hook_impl
    def before_pipeline_run(self) -> None:
        """Find out at once whether the cluster is there."""
        work_map()

    @hook_impl
    def after_pipeline_run(self) -> None:
        """Close the connection."""
        self._close()

    @hook_impl
    def on_pipeline_error(self) -> None:
        """Close the connection; what is still under way is given up."""
        self._close()

    def _close(self) -> None:
        if _CHOSEN["parameters"].scheduler:
            from tire_pipeline.cluster.dask_map import close

            close()
