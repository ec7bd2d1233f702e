"""Which workers a run takes: those of its configuration (docs/how-to/cluster.md)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import partial, update_wrapper
from typing import Any, TypeVar

from kedro.framework.hooks import hook_impl
from pydantic import ValidationError

from tire_pipeline.cluster.parameters import ClusterParameters
from tire_pipeline.errors import DomainError
from tire_pipeline.tasks import Done, Map, Task, end_processes, in_processes

_T = TypeVar("_T")
_CHOSEN_CLUSTER = {"parameters": ClusterParameters()}


def work_map() -> Map:
    """Return the run's map."""
    chosen = _CHOSEN_CLUSTER["parameters"]
    if chosen.scheduler:
        from tire_pipeline.cluster.dask_map import dask_map

        return dask_map(chosen)
    return in_processes(chosen.processes)


def _of_the_run(tasks: Mapping[str, Task[_T]], what: str) -> Iterator[Done[_T]]:
    """The run's map: which one it is, is known when it is called."""
    return work_map()(tasks, what)


def given_map(function: Callable[..., _T]) -> Callable[..., _T]:
    """Give a node's function the run's map as its argument ``work``.

    Parameters
    ----------
    function : callable
        Takes ``work`` by name.
    """
    return update_wrapper(partial(function, work=_of_the_run), function)


class ClusterHooks:
    """Takes the parameter ``cluster`` of the run, and releases cluster and processes when the run ends."""

    @hook_impl
    def after_context_created(self, context: Any) -> None:
        """Read the parameters; a wrong one stops the run before it begins."""
        given = context.config_loader["parameters"].get("cluster") or {}
        try:
            _CHOSEN_CLUSTER["parameters"] = ClusterParameters.model_validate(given)
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
        """Close the connection, end the processes."""
        self._close()

    @hook_impl
    def on_pipeline_error(self) -> None:
        """Close the connection, end the processes; unfinished tasks are dropped."""
        self._close()

    def _close(self) -> None:
        end_processes()
        if _CHOSEN_CLUSTER["parameters"].scheduler:
            from tire_pipeline.cluster.dask_map import close

            close()
