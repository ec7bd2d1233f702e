"""A task of its own file: what it loads takes a second in each process that is begun."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tire_pipeline.datasets.users_files.tir_folder import TirLoader


@dataclass(frozen=True)
class NotedLoader(TirLoader):
    """Reads a file as a run does; each reading leaves a letter beside it."""

    def __call__(self) -> Any:
        with Path(f"{self.path}.read").open("a") as file:
            file.write("x")
        return super().__call__()
