"""From a path or bytes to text that encodes back to the same bytes."""

from __future__ import annotations

import os
from pathlib import Path

from tire_pipeline.errors import TirError, TirSyntaxError
from tire_pipeline.files.regular_file import NotRegularError, kind_of_archive, open_regular

MOST_FILE_BYTES = 5_000_000
"""A larger file is refused: real ones have 2 to 60 kB."""

_BOMS = ((b"\xef\xbb\xbf", "utf-8"), (b"\xff\xfe", "utf-16-le"), (b"\xfe\xff", "utf-16-be"))
_CONTROL = bytes(i for i in range(32) if i not in b"\t\n\r\f\v\x1a") + b"\x7f"
_MOST_CONTROL = 0.02


def load_bytes(source: str | os.PathLike[str] | bytes, path: str | None = None) -> bytes:
    """Return the content, refusing what is not a regular file of at most ``MOST_FILE_BYTES``.

    Raises
    ------
    TirError
        The path is absent, not readable, or not a regular file.
    TirSyntaxError
        It is larger than ``MOST_FILE_BYTES``.
    """
    if isinstance(source, bytes | bytearray | memoryview):
        data = bytes(source)
    else:
        path = path or os.fspath(source)
        try:
            data = _load_file(Path(source), path)
        except (OSError, ValueError) as error:
            if isinstance(error, TirError):
                raise
            why = getattr(error, "strerror", None) or str(error)
            if isinstance(error, IsADirectoryError):
                raise TirError("this is a folder", path=path, todo="give one .tir file") from error
            raise TirError(
                f"cannot be read: {why}", path=path, todo="check the path and its permissions"
            ) from error
    if len(data) > MOST_FILE_BYTES:
        raise _too_large(path)
    return data


def _load_file(file: Path, path: str) -> bytes:
    try:
        with open_regular(file) as stream:
            return stream.read(MOST_FILE_BYTES + 1)
    except NotRegularError as error:
        raise TirError("is not a regular file", path=path, todo="name a .tir file") from error


def _too_large(path: str | None) -> TirSyntaxError:
    return TirSyntaxError(
        f"the file is larger than {MOST_FILE_BYTES / 1e6:g} MB, the limit for a tire property file",
        path=path,
        todo="check that it is one; real ones have a few ten kB",
    )


def decode(data: bytes, path: str | None = None) -> tuple[str, str, bytes]:
    """Return the text, its encoding and its byte order mark.

    UTF-8 if it is valid, otherwise Windows-1252, otherwise Latin-1; UTF-16 with a mark. Encoding the text
    with the encoding, after the mark, gives the same bytes.

    Raises
    ------
    TirSyntaxError
        Empty or binary.
    """
    mark = b""
    encodings: tuple[str, ...] = ("utf-8", "cp1252", "latin-1")
    for bom, name in _BOMS:
        if data.startswith(bom):
            mark, encodings = bom, (name,)
    if mark[:1] not in (b"\xff", b"\xfe") and _looks_binary(data):
        raise _binary(path, data)
    for encoding in encodings:
        try:
            text = data[len(mark) :].decode(encoding)
        except UnicodeDecodeError:
            continue
        if not text.strip(" \t\r\n\f\v\x1a\0"):
            raise TirSyntaxError("the file is empty", path=path, todo="export it again")
        if "\0" not in text:
            return text, encoding, mark
    raise _binary(path)


def _looks_binary(data: bytes) -> bool:
    if b"\0" in data:
        return True
    return len(data) - len(data.translate(None, _CONTROL)) > _MOST_CONTROL * len(data)


def _binary(path: str | None, data: bytes = b"") -> TirSyntaxError:
    if archive := kind_of_archive(data):
        return TirSyntaxError(
            f"is no tire property file: it is {archive}", path=path, todo="unpack it, and give the .tir file"
        )
    return TirSyntaxError(
        "is a binary file, not a tire property file", path=path, todo="export it as text (.tir)"
    )
