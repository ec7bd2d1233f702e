"""Processes in process namespaces of their own, as in two containers that share a folder."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
UNSHARE = ["unshare", "--pid", "--fork", "--kill-child", "--mount-proc"]


def _permitted() -> bool:
    try:
        return subprocess.run([*UNSHARE, "true"], capture_output=True, check=False).returncode == 0
    except OSError:
        return False


namespaces = pytest.mark.skipif(not _permitted(), reason="unshare is not permitted here: needs root")


class InNamespace:
    """A Python process that has number 1 in its own process namespace."""

    def __init__(self, *arguments: str, log: Path) -> None:
        self.log = log
        with log.open("wb") as file:
            self._outer = subprocess.Popen(
                [*UNSHARE, sys.executable, *arguments],
                cwd=ROOT,
                env={**os.environ, "OMP_NUM_THREADS": "1"},
                stdout=file,
                stderr=subprocess.STDOUT,
            )

    def said(self) -> str:
        return self.log.read_text(encoding="utf-8")

    def send(self, number: signal.Signals) -> None:
        children = Path(f"/proc/{self._outer.pid}/task/{self._outer.pid}/children").read_text().split()
        (inner,) = map(int, children)
        os.kill(inner, number)

    def kill(self) -> None:
        self.send(signal.SIGKILL)
        self._outer.wait(timeout=60)

    def wait(self) -> int:
        return self._outer.wait(timeout=600)

    def running(self) -> bool:
        return self._outer.poll() is None

    def wait_until(self, there: Callable[[], object]) -> None:
        end = time.monotonic() + 300
        while not there():
            assert self.running(), f"it ended too early: {self.said()}"
            assert time.monotonic() < end, self.said()
            time.sleep(0.02)

    def __enter__(self) -> InNamespace:
        return self

    def __exit__(self, *_: object) -> None:
        if self.running():
            self.kill()
