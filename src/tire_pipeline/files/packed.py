"""Several files as the bytes of one ZIP, the same for the same files; and the hash of a file beside it."""

from __future__ import annotations

import contextlib
import hashlib
import io
import lzma
import struct
import zipfile
import zlib
from collections.abc import Iterator, Mapping

import pandas as pd

from tire_pipeline.errors import DomainError

_DATE = (1980, 1, 1, 0, 0, 0)


_OF_A_DAMAGED_ZIP = (
    zipfile.BadZipFile,
    zlib.error,
    lzma.LZMAError,
    struct.error,
    RuntimeError,  # it seems to be encrypted, or to be of another kind
    EOFError,
    LookupError,
    ValueError,
    OSError,
)
"""What :mod:`zipfile` raises if some bytes are not what they were."""


SEAL = ".sha256"
"""What the name of a file with another one's hash ends in."""


def seal_of(content: bytes) -> bytes:
    """The hash of a file, for another file beside it.

    Examples
    --------
    >>> is_as_sealed(b"a,b", seal_of(b"a,b")), is_as_sealed(b"a,c", seal_of(b"a,b"))
    (True, False)
    """
    return hashlib.sha256(content).hexdigest().encode()


def is_as_sealed(content: bytes, seal: bytes) -> bool:
    """Whether a file has the hash that lies beside it."""
    return seal_of(content) == seal.strip()


class Passing(bytes):
    """A result that counts for this run only: the next one computes it again."""

    passing = True


class Stored(bytes):
    """The content of a stored file, and where that lies."""

    where = ""


def stored(content: bytes, where: str) -> Stored:
    """Content with its place, for the case that it is damaged."""
    found = Stored(content)
    found.where = where
    return found


def pack(members: Mapping[str, bytes]) -> bytes:
    """Files as one ZIP."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name, content in members.items():
            entry = zipfile.ZipInfo(name, _DATE)
            archive.writestr(entry, content, zipfile.ZIP_DEFLATED)
    return buffer.getvalue()


@contextlib.contextmanager
def _opened(content: bytes) -> Iterator[zipfile.ZipFile]:
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            yield archive
    except _OF_A_DAMAGED_ZIP as error:
        raise DomainError(
            "this stored file is damaged",
            where=getattr(content, "where", None),
            todo="delete it and run again: it is made again",
        ) from error


def unpack(content: bytes) -> dict[str, bytes]:
    """The files of one ZIP."""
    with _opened(content) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def member(content: bytes, name: str) -> bytes:
    """One of the files of one ZIP."""
    with _opened(content) as archive:
        return archive.read(name)


def names_in(content: bytes) -> list[str]:
    """Names of the files of one ZIP, none of which is read."""
    with _opened(content) as archive:
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
