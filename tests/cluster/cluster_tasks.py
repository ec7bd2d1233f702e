"""Tasks that workers of the tests do; they import this file by its path."""

from __future__ import annotations

import os
import signal
import time
from pathlib import Path

from tire_pipeline.errors import TirError


def double(number: int) -> int:
    return 2 * number


def fails(name: str) -> int:
    raise TirError("no tire", path=name, line=3, todo="mend it")


def dies(log: Path) -> int:
    with log.open("a") as file:
        file.write("x")
    os.kill(os.getpid(), signal.SIGKILL)
    return 0


def dies_once(log: Path, number: int) -> int:
    if not log.exists():
        dies(log)
    return number


def slow(log: Path, number: int) -> int:
    with log.open("a") as file:
        file.write("x")
    time.sleep(0.2)
    return number


def slow_bytes(log: Path, number: int) -> bytes:
    return str(slow(log, number)).encode()
