"""Tasks by the workers of a Dask cluster: the one place that knows Dask.

Workers read the same files as this process, at the same paths (a shared folder, or object storage). Results
come back to this process, and it alone writes them: a run that has lost its data folder writes nothing more.
"""

from __future__ import annotations

import ipaddress
import itertools
import logging
import math
import os
import time
import uuid
from collections.abc import Iterator, Mapping
from concurrent.futures import CancelledError
from functools import partial
from typing import TYPE_CHECKING, Any, TypeVar
from urllib.parse import urlsplit

from tire_pipeline.errors import DomainError
from tire_pipeline.tasks import Done, Map, Task, attempt_in_silence, done_alone, shown

if TYPE_CHECKING:
    from distributed import Client, Future

    from tire_pipeline.cluster.parameters import ClusterParameters

_T = TypeVar("_T")
_LOG = logging.getLogger(__name__)
_AHEAD = 3
"""So many tasks a thread are with the scheduler at once; a million of them would fill its memory."""
_SECONDS_BETWEEN = 1.0
"""Between two questions how many threads there are: an answer takes milliseconds, as much as a short task."""
_COMPUTING = ("numpy", "pandas", "pyarrow", "scikit-learn", "scipy", "numba", "torch")
_OPEN_CLIENTS: dict[ClusterParameters, Client] = {}


def dask_map(chosen: ClusterParameters) -> Map:
    """Connect to a scheduler, once a run, and give a map over its workers.

    Parameters
    ----------
    chosen : ClusterParameters

    Raises
    ------
    DomainError
        The address is neither on this machine nor encrypted, nothing answers there, there is no worker, or a
        worker runs another version of this project.
    """
    client = _OPEN_CLIENTS.get(chosen)
    if client is None or client.status != "running":
        client = _OPEN_CLIENTS[chosen] = _connected(chosen)
    return _DaskMap(client, str(chosen.scheduler))


def close() -> None:
    """Close all connections."""
    while _OPEN_CLIENTS:
        _OPEN_CLIENTS.popitem()[1].close(timeout=2)


def check_address(chosen: ClusterParameters) -> bool:
    """Whether the connection is encrypted; whatever a scheduler sends is unpickled, so it must be trusted.

    Raises
    ------
    DomainError
        Neither on this machine nor encrypted, or a file is missing.
    """
    address = str(chosen.scheduler)
    parts = urlsplit(address if "://" in address else f"tcp://{address}")
    files = {n: getattr(chosen, n) for n in ("tls_ca", "tls_certificate", "tls_key")}
    if parts.scheme == "tls":
        for name, file in files.items():
            if not file or not os.path.isfile(file):
                raise DomainError(
                    f"cluster.{name} is not a file" if file else f"cluster.{name} is not given",
                    where=address,
                    todo="give tls_ca, tls_certificate and tls_key (docs/how-to/cluster.md)",
                )
        return True
    if not _loopback(parts.hostname or ""):
        raise DomainError(
            "a scheduler on another machine needs TLS, because Dask runs any code that it receives",
            where=address,
            todo="use tls://... with cluster.tls_ca, tls_certificate and tls_key (docs/how-to/cluster.md)",
        )
    return False


def _loopback(host: str) -> bool:
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


def _connected(chosen: ClusterParameters) -> Client:
    try:
        from distributed import Client, Security
    except ImportError as error:
        raise DomainError("Dask is not installed", todo='pip install -e ".[cluster]"') from error
    # a lost scheduler is told in one line by _gone; Dask logs tracebacks of what it still sends and tries
    for name in ("distributed.client", "distributed.batched"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    security = None
    if check_address(chosen):
        security = Security(
            tls_ca_file=chosen.tls_ca,
            tls_client_cert=chosen.tls_certificate,
            tls_client_key=chosen.tls_key,
            require_encryption=True,
        )
    todo = "start it (`make cluster`), or set cluster.scheduler"
    where = str(chosen.scheduler)
    try:
        client = Client(chosen.scheduler, security=security, timeout=chosen.wait_seconds)
    except (OSError, TimeoutError, ValueError) as error:
        raise DomainError("no Dask scheduler answers there", where=where, todo=todo) from error
    except RuntimeError as error:  # Dask's own configuration asks for encryption
        raise DomainError(f"Dask does not connect: {error}", where=where, todo=todo) from error
    try:
        client.wait_for_workers(1, timeout=chosen.wait_seconds)
    except TimeoutError as error:
        client.close()
        raise DomainError("this scheduler has no workers", where=where, todo=todo) from error
    _same_code(client, where)
    _LOG.info("%d Dask workers at %s; their dashboard: %s", _workers(client), where, client.dashboard_link)
    return client


def _same_code(client: Client, where: str) -> None:
    own = code_version()
    todo = "install the same version there, and start the workers again"
    try:
        versions = client.run(code_version)
    except Exception as error:  # whatever it is that a worker cannot import
        client.close()
        raise DomainError(f"the workers cannot run this project: {error}", where=where, todo=todo) from None
    for worker, other in versions.items():
        if other != own:
            client.close()
            raise DomainError(
                f"the worker {worker} runs another version of this project", where=where, todo=todo
            )


def code_version() -> str:
    """A hash of this project's source and of the versions of what computes."""
    from importlib.metadata import version

    from tire_pipeline.code_hash import code_hash

    return " ".join([code_hash("."), *map(version, _COMPUTING)])


def _workers(client: Client) -> int:
    return len(client.scheduler_info(n_workers=-1)["workers"])


def run_task(name: str, task: Task[_T]) -> Done[_T]:
    """On a worker: do a task, or raise; what fails within it is told on the dashboard's page of logs.

    The value comes in a wrapper: Dask sends bytes of a special class as plain ones.
    """
    value = attempt_in_silence(name, task).result()
    for file, reason in getattr(value, "failures", {}).items():
        logging.getLogger("distributed.worker").warning("%s: %s", file, reason)
    return Done(name, value)


class _DaskMap:
    def __init__(self, client: Client, address: str) -> None:
        self._client = client
        self._address = address
        self._threads = 1
        self._ask_again = -math.inf

    def __call__(self, tasks: Mapping[str, Task[_T]], what: str) -> Iterator[Done[_T]]:
        yield from shown(self._done(tasks, what), what, tasks, at_once=0)

    def _done(self, tasks: Mapping[str, Task[_T]], what: str) -> Iterator[Done[_T]]:
        from distributed import KilledWorker, as_completed

        waiting = iter(tasks)
        running: dict[str, str] = {}
        lost: list[str] = []
        futures = as_completed()
        self._ask_again = -math.inf
        try:
            self._submit(futures, running, itertools.islice(waiting, self._room(running)), tasks, what)
            for future in futures:
                name = running.pop(future.key)
                done = self._outcome(name, future)
                future.release()
                self._submit(futures, running, itertools.islice(waiting, self._room(running)), tasks, what)
                if isinstance(done.error, KilledWorker):
                    _LOG.warning("%s: %s: its worker died; it is tried alone", what, name)
                    lost.append(name)
                else:
                    yield done
        finally:  # the caller may have enough, or an error: what is under way is given up
            for future in list(futures.futures):
                future.cancel()
        for name in lost:
            yield done_alone(name, tasks[name], partial(self._on_a_worker, what=what), what)

    def _room(self, running: Mapping[str, str]) -> int:
        if time.monotonic() >= self._ask_again:
            try:
                self._threads = max(sum(self._client.nthreads().values()), 1)
            except (CancelledError, OSError, TimeoutError) as lost:
                raise self._gone() from lost
            self._ask_again = time.monotonic() + _SECONDS_BETWEEN
        return max(_AHEAD * self._threads - len(running), 0)

    def _submit(
        self,
        futures: Any,
        running: dict[str, str],
        names: Iterator[str],
        tasks: Mapping[str, Task[_T]],
        what: str,
    ) -> None:
        for name in names:
            future = self._future(name, tasks[name], what)
            running[str(future.key)] = name
            futures.add(future)

    def _future(self, name: str, task: Task[_T], what: str) -> Future[Done[_T]]:
        shown = getattr(task, "label", "") or name
        group = what.replace(" ", "_").replace("-", "_")
        key = f"{group}-{uuid.uuid4().hex}-{shown}"  # the dashboard takes what is before the first - together
        return self._client.submit(run_task, name, task, key=key, pure=False)

    def _outcome(self, name: str, future: Future[Done[_T]]) -> Done[_T]:
        try:
            error = future.exception()
            if error is None:
                return future.result()
        except (CancelledError, OSError, TimeoutError) as lost:
            raise self._gone() from lost
        if isinstance(error, CancelledError):
            raise self._gone() from error
        return Done(name, error=error)

    def _gone(self) -> DomainError:
        return DomainError(
            "the Dask scheduler does not answer any more",
            where=self._address,
            todo="start it again, then run again: what was stored is not done again",
        )

    def _on_a_worker(self, name: str, task: Task[_T], what: str) -> Done[_T] | None:
        """Do a task; None if each worker that took it died."""
        from distributed import KilledWorker

        outcome = self._outcome(name, self._future(name, task, what))
        return None if isinstance(outcome.error, KilledWorker) else outcome
