"""A scheduler and workers as processes of their own, on loopback."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import time
from contextlib import closing
from pathlib import Path

DEATHS = {"DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "2"}

LOOPBACK = ("--host", "127.0.0.1", "--dashboard-address", "127.0.0.1:0")
"""Both are needed: without the second a worker's page of health listens on every address."""


def free_port() -> int:
    with closing(socket.socket()) as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Processes:
    """Starts them, and ends what it has started."""

    def __init__(self, folder: Path, port: int | None = None) -> None:
        self.port = port or free_port()
        self.address = f"tcp://127.0.0.1:{self.port}"
        self.folder = folder
        self.scheduler = self._start("scheduler", "--port", str(self.port))
        self._wait_for_port()
        self.workers = self._start(
            "worker", self.address, "--nworkers", "2", "--nthreads", "1",
            "--local-directory", str(folder), "--death-timeout", "120",
        )  # fmt: skip

    def _start(self, what: str, *arguments: str) -> subprocess.Popen[bytes]:
        log = (self.folder / f"{what}.log").open("ab")
        command = [sys.executable, "-m", "dask", what, *LOOPBACK, *arguments]
        here = {**os.environ, **DEATHS, "PYTHONPATH": os.pathsep.join([*sys.path])}
        return subprocess.Popen(command, stdout=log, stderr=log, env=here, start_new_session=True)

    def _wait_for_port(self) -> None:
        for _ in range(600):
            with closing(socket.socket()) as one:
                if one.connect_ex(("127.0.0.1", self.port)) == 0:
                    return
            time.sleep(0.1)
        raise TimeoutError((self.folder / "scheduler.log").read_text())

    def kill_scheduler(self) -> None:
        _end(self.scheduler)

    def end(self) -> None:
        for process in (self.workers, self.scheduler):
            _end(process)


def _end(process: subprocess.Popen[bytes]) -> None:
    """The process and those that it has started: its session."""
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGKILL)
    process.wait(timeout=20)
