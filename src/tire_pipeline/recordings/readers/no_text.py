"""What a file is that was taken for text."""

from __future__ import annotations

from tire_pipeline.errors import RecordingError

_BEGINNINGS = {
    b"PK\x03\x04": ("a ZIP archive or an Excel workbook", "save the table in it as CSV"),
    b"\xd0\xcf\x11\xe0": ("an old Excel workbook", "save the table in it as CSV"),
    b"\x1f\x8b": ("compressed by gzip", "decompress it first"),
    b"BZh": ("compressed by bzip2", "decompress it first"),
    b"\xfd7zXZ\x00": ("compressed by xz", "decompress it first"),
    b"\x28\xb5\x2f\xfd": ("compressed by zstd", "decompress it first"),
    b"\x89HDF": ("HDF5", "save it as CSV or Parquet"),
    b"%PDF": ("a PDF document", "save its table as CSV"),
}
_NUL = b"\x00"


def no_text(head: bytes, where: str) -> RecordingError:
    """The error for a file that has NUL bytes in it.

    Parameters
    ----------
    head : bytes
        How it begins.
    where : str
        The file.

    Examples
    --------
    >>> print(no_text(b"PK\\x03\\x04...", "run.csv"))
    run.csv: this is no text file: it is a ZIP archive or an Excel workbook -> save the table in it as CSV
    """
    for beginning, (kind, todo) in _BEGINNINGS.items():
        if head.startswith(beginning):
            return RecordingError(f"this is no text file: it is {kind}", where=where, todo=todo)
    at = head.index(_NUL) if _NUL in head else 0
    if head[:at].strip() and not head[at:].strip(_NUL):
        return RecordingError(
            f"from byte {at} on it holds nothing but NUL bytes",
            where=where,
            todo="the recorder was stopped while it wrote: cut the file there, at the end of a line",
        )
    return RecordingError("this is no text file", where=where, todo="check its format")
