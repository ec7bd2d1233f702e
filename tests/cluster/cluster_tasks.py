"""Tasks that workers of the tests do; they import this file, which loads little, by its path."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tire_pipeline.errors import TirError


def double(number: int) -> int:
    return 2 * number


def fails(name: str) -> int:
    raise TirError("no tire", path=name, line=3, todo="mend it")


def key() -> str:
    """What the dashboard calls this task."""
    from distributed.worker import thread_state

    return str(thread_state.key)


def gone() -> None:
    """A file that changed while it was read."""


def dies(log: Path) -> int:
    with log.open("a") as file:
        file.write("x")
    os.kill(os.getpid(), signal.SIGKILL)
    return 0


def dies_elsewhere(log: Path, here: int) -> str:
    """End any process but the one that runs the tests."""
    return "done by the run itself" if os.getpid() == here else str(dies(log))


@dataclass(frozen=True)
class DiesUntil:
    """Reads a file; as long as ``flag`` is not there that takes more memory than there is."""

    flag: Path
    log: Path
    path: str

    def fingerprint(self) -> str:
        return "the file has not changed"

    def __call__(self) -> Any:
        """Return the tire; what that takes is not imported by each process that is begun anew."""
        if not self.flag.exists():
            dies(self.log)
        from tire_pipeline.tir import read_tir

        return read_tir(self.path)


@dataclass(frozen=True)
class KillingPlace:
    """A place whose file ``killer`` ends the process that opens it."""

    log: Path

    def fingerprints(self, names: Iterable[str]) -> Iterator[tuple[str, str]]:
        for name in names:
            if name == "killer":
                dies(self.log)
            yield name, f"hash of {name}"


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
