"""Files of a retraining that are read together: their rows of the table, made where they are read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import pandas as pd

from tire_pipeline.errors import cause_in_entry
from tire_pipeline.file_names import printable
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.tasks import Done, LostTaskError, Task
from tire_pipeline.tire_table.from_models import from_models, join_tables

FILES_A_TASK = 100
"""So many files are read together."""


@dataclass(frozen=True)
class FilesRead:
    """What became of some files.

    Attributes
    ----------
    done : list of Done
        One a file, in order; its value is whether the content was the one that was expected.
    table : DataFrame
        The tire table of those whose value is true.
    """

    done: list[Done[bool]]
    table: pd.DataFrame

    @property
    def failures(self) -> dict[str, str]:
        """File -> why it cannot be read."""
        return {each.name: printable(str(cause_in_entry(each.error))) for each in self.done if each.error}


@dataclass(frozen=True)
class ReadTogether:
    """Reads some files. Their table has a tenth of the size of their models and is quickly joined to others.

    Attributes
    ----------
    tasks : mapping
        File -> the task that reads it (:meth:`.Place.reading`).
    """

    tasks: Mapping[str, Task[TireModel | None]]
    label = ""

    def __call__(self) -> FilesRead:
        """Read all; one that fails does not stop the others."""
        done, models = list[Done[bool]](), list[tuple[str, str, TireModel]]()
        for name, task in self.tasks.items():
            try:
                tire = task()
            except Exception as error:
                done.append(Done(name, error=error))
                continue
            done.append(Done(name, tire is not None))
            if tire is not None:
                models.append((name, category_of(name), tire))
        return FilesRead(done, from_models(models))

    def split(self) -> dict[str, ReadTogether]:
        """Each file by itself: to find the one that ends its process."""
        return {name: ReadTogether({name: task}) for name, task in self.tasks.items()}

    def join(self, parts: list[FilesRead]) -> FilesRead:
        """What those of :meth:`split` gave, as if this one had been done."""
        return FilesRead(
            [done for part in parts for done in part.done], join_tables(part.table for part in parts)
        )

    def lost(self, reason: str) -> FilesRead:
        """What one file gives that ends its process."""
        return FilesRead([Done(name, error=LostTaskError(reason)) for name in self.tasks], from_models([]))


def read_in_blocks(tasks: Mapping[str, Task[TireModel | None]]) -> dict[str, ReadTogether]:
    """Divide the tasks; each block by the name of its first file."""
    names = list(tasks)
    some = (names[start : start + FILES_A_TASK] for start in range(0, len(names), FILES_A_TASK))
    return {block[0]: ReadTogether({name: tasks[name] for name in block}) for block in some}


def category_of(name: str) -> str:
    """The first folder of a file's path."""
    return name.split("/", 1)[0] if "/" in name else ""
