"""Parts of a table as Parquet files beside an index, which is written last and says which they are."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import Any

import pandas as pd

from tire_pipeline.datasets.storage.files_at import files_at
from tire_pipeline.datasets.storage.sealed import json_as_sealed, made_again, sealed_json
from tire_pipeline.errors import DomainError
from tire_pipeline.files.packed import as_parquet, from_parquet


def write_parts(
    folder: str,
    index: str,
    frames: Iterable[pd.DataFrame],
    more: Callable[[pd.DataFrame], dict[str, Any]] = lambda frame: {},
) -> None:
    """Write parts one after the other, then the index.

    Parameters
    ----------
    folder, index : str
        Where they lie, and the name of the index.
    frames : iterable of DataFrame
    more : callable
        What the index says of a part beside its name, its hash and the number of its rows.
    """
    files, parts = files_at(folder), []
    for number, frame in enumerate(frames):
        name, content = f"part-{number:06d}.parquet", as_parquet(frame)
        files.write(name, content)
        digest = hashlib.sha256(content).hexdigest()
        parts.append({"name": name, "sha256": digest, "rows": len(frame), **more(frame)})
    files.write(index, sealed_json(json.dumps({"parts": parts}).encode()))


def parts_of(folder: str, index: str) -> Iterator[tuple[dict[str, Any], Callable[[], pd.DataFrame]]]:
    """Yield what the index says of each part, and the function that reads it."""
    where, todo = f"{folder}/{index}", made_again(index)
    content = json_as_sealed(files_at(folder).read(index), where, todo)
    try:
        parts = json.loads(content)["parts"]
    except (ValueError, KeyError, TypeError) as error:
        raise DomainError("this list of a table's parts is damaged", where=where, todo=todo) from error
    for part in parts:
        yield part, partial(read_part, folder, part["name"], part["sha256"], todo)


def read_part(folder: str, name: str, sha256: str, todo: str) -> pd.DataFrame:
    """A part of a table.

    Raises
    ------
    DomainError
        It is gone, or not what was written.
    """
    try:
        content = files_at(folder).read(name)
    except FileNotFoundError as error:
        where = f"{folder}/{name}"
        raise DomainError("this part of the table is missing", where=where, todo=todo) from error
    if hashlib.sha256(content).hexdigest() != sha256:
        raise DomainError("this part of the table is damaged", where=f"{folder}/{name}", todo=todo)
    return from_parquet(content)
