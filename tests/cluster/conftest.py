"""Fixtures of the cluster tests."""

from __future__ import annotations

import pytest


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    """A scheduler and two workers for one file: they take a twentieth of a processor also while they wait."""
    pytest.importorskip("distributed", reason='the extra is not installed: pip install -e ".[cluster]"')
    from dask_processes import Processes

    processes = Processes(tmp_path_factory.mktemp("dask"))
    yield processes
    processes.end()


@pytest.fixture(scope="module")
def work(cluster):
    """The map of a run on the cluster."""
    from tire_pipeline.cluster.dask_map import close, dask_map
    from tire_pipeline.cluster.parameters import ClusterParameters

    yield dask_map(ClusterParameters(scheduler=cluster.address, wait_seconds=120))
    close()
