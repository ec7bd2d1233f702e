"""Stored content that holds its own hash: a bit that flips on a disk or on the way is noticed.

What was stored before there were hashes is read as it is.
"""

from __future__ import annotations

import hashlib
import io
import re
from pathlib import PurePath

import pandas as pd

from tire_pipeline.errors import DomainError

_BLANK = b"0" * 64
_IN_PARQUET = b"tire_pipeline.sha256\x18\x40"
"""Key of the hash among a Parquet file's metadata, and what stands before a text of 64 bytes there."""
_IN_JSON = re.compile(rb',"sha256":"([0-9a-f]{64})"\}\Z')


def made_again(name: str) -> str:
    """What to do if the newest version of a dataset is damaged."""
    maker = f"the pipeline that makes {PurePath(name).stem!r}"
    return f"it is not used: run {maker} (or `kedro run`); a new version takes its place"


def sealed_parquet(frame: pd.DataFrame) -> bytes:
    """A table as a Parquet file with the hash of all of it: pages, names, types and sizes.

    Parquet's own checksums are of its pages only: of the bits in the rest, one flip in 80 gave another table
    without an error.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    table, buffer = pa.Table.from_pandas(frame), io.BytesIO()
    with pq.ParquetWriter(buffer, table.schema) as writer:
        writer.write_table(table)
        writer.add_key_value_metadata({_IN_PARQUET[:-2]: _BLANK})
    content = buffer.getvalue()
    at = content.rindex(_IN_PARQUET) + len(_IN_PARQUET)
    return b"".join([content[:at], _hash(content), content[at + len(_BLANK) :]])


def parquet_as_sealed(content: bytes, where: str, todo: str) -> pd.DataFrame:
    """The table of :func:`sealed_parquet`, or of another Parquet file.

    Parameters
    ----------
    content : bytes
    where, todo : str
        For the error: which file it is, and what to do if it is damaged.

    Raises
    ------
    DomainError
        It is not what was stored.
    """
    import pyarrow.parquet as pq

    damaged = DomainError("this stored table is damaged", where=where, todo=todo)
    at = content.rfind(_IN_PARQUET)
    if at >= 0:
        start, end = at + len(_IN_PARQUET), at + len(_IN_PARQUET) + len(_BLANK)
        if _hash(content[:start], _BLANK, content[end:]) != content[start:end]:
            raise damaged
    try:
        return pq.ParquetFile(io.BytesIO(content)).read().to_pandas()
    except Exception as error:  # pyarrow raises many kinds on damaged files
        raise damaged from error


def sealed_json(content: bytes) -> bytes:
    """The text of a JSON object that has a member, with the text's hash as its last member."""
    return b"".join([content[:-1], b',"sha256":"', _hash(content), b'"}'])


def json_as_sealed(content: bytes, where: str, todo: str) -> bytes:
    """The text that was given to :func:`sealed_json`, or another text.

    Raises
    ------
    DomainError
        It is not what was stored.
    """
    found = _IN_JSON.search(content)
    if found is None:
        return content
    text = content[: found.start()] + b"}"
    if _hash(text) != found[1]:
        raise DomainError("this file is damaged", where=where, todo=todo)
    return text


def _hash(*parts: bytes) -> bytes:
    total = hashlib.sha256()
    for part in parts:
        total.update(part)
    return total.hexdigest().encode()
