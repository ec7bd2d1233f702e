"""Runs of their own that are killed at one of their writes into a bucket.

Each is forked from a process that has the imports and nothing else: importing all for each of two dozen
writes takes minutes.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from unittest.mock import patch

from bucket_runs import run_here


def forked_run(
    conf: Path, log: Path, pipeline: str, parameters: Mapping[str, Any], killed_at: tuple[str, int] | None
) -> int | None:
    """Do a run; its exit code, minus the signal that ended it.

    Parameters
    ----------
    conf, pipeline, parameters
        As for :func:`.run_here`.
    log : Path
        Takes what it says.
    killed_at : (str, int) or None
        Part of an object's name, and at which write of such an object the run is killed.

    Notes
    -----
    A run like it has to be done before in this process: what it has imported is taken for what they need.
    """
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(
        ["bucket_runs", "s3fs", *(name for name in sys.modules if name.startswith("tire_pipeline."))]
    )
    process = context.Process(target=_run, args=(conf, log, pipeline, dict(parameters), killed_at))
    with patch.dict(os.environ, PYTHONPATH=os.pathsep.join(sys.path)):  # the process forked from starts here
        process.start()
    process.join(timeout=500)
    if process.is_alive():
        process.kill()
        process.join()
        raise TimeoutError(log.read_text())
    return process.exitcode


def _run(
    conf: Path, log: Path, pipeline: str, parameters: dict[str, Any], killed_at: tuple[str, int] | None
) -> None:
    with log.open("w") as file:
        os.dup2(file.fileno(), 1)
        os.dup2(file.fileno(), 2)
    if killed_at:
        _kill_at(*killed_at)
    run_here(conf, pipeline, **parameters)


def _kill_at(part: str, number: int) -> None:
    """From now on the process is killed just before this write of an object whose name has this part."""
    from aiobotocore.client import AioBaseClient

    call, seen = AioBaseClient._make_api_call, []

    async def killing(self, operation, parameters):
        if operation in ("PutObject", "CompleteMultipartUpload") and part in parameters["Key"]:
            seen.append(operation)
            if len(seen) == number:
                os.kill(os.getpid(), signal.SIGKILL)
        return await call(self, operation, parameters)

    AioBaseClient._make_api_call = killing
