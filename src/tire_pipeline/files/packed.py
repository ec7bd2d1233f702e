"""Several files as the bytes of one ZIP; the same files give the same bytes."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Mapping

import pandas as pd

_DATE = (1980, 1, 1, 0, 0, 0)


class Passing(bytes):
    """A result that counts for this run only: the next one computes it again."""

    passing = True


def pack(members: Mapping[str, bytes]) -> bytes:
    """Files as one ZIP."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name, content in members.items():
            entry = zipfile.ZipInfo(name, _DATE)
            archive.writestr(entry, content, zipfile.ZIP_DEFLATED)
    return buffer.getvalue()


def unpack(content: bytes) -> dict[str, bytes]:
    """The files of one ZIP."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def member(content: bytes, name: str) -> bytes:
    """One of the files of one ZIP."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        return archive.read(name)


def names_in(content: bytes) -> list[str]:
    """Names of the files of one ZIP, none of which is read."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        return archive.namelist()


def as_parquet(frame: pd.DataFrame) -> bytes:
    """A table as a Parquet file."""
    buffer = io.BytesIO()
    frame.to_parquet(buffer)
    return buffer.getvalue()


def from_parquet(content: bytes) -> pd.DataFrame:
    """The table of :func:`as_parquet`, by one thread: more cost more than they save on some hundred rows."""
    import pyarrow.parquet

    table = pyarrow.parquet.ParquetFile(io.BytesIO(content)).read(use_threads=False)
    return table.to_pandas(use_threads=False)


def shape_of_parquet(content: bytes) -> tuple[int, list[str]]:
    """How many rows the table of :func:`as_parquet` has, and its columns, without reading them."""
    import pyarrow.parquet

    found = pyarrow.parquet.read_metadata(io.BytesIO(content))
    return found.num_rows, list(found.schema.names)
