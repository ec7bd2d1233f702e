"""Reading a recording of any format."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import pandas as pd

from tire_pipeline.errors import RecordingError
from tire_pipeline.files.regular_file import kind_of_archive, no_regular_file
from tire_pipeline.recordings.conventions.canonical import RawRecording, canonical_frame
from tire_pipeline.recordings.conventions.units_in_names import split_unit
from tire_pipeline.recordings.readers.csv_file import read_csv
from tire_pipeline.recordings.readers.limits import check_size
from tire_pipeline.recordings.readers.mat_file import read_mat
from tire_pipeline.recordings.readers.mdf_file import read_mdf
from tire_pipeline.recordings.readers.parquet_file import read_parquet
from tire_pipeline.recordings.readers.tydex_file import read_tydex

READERS: dict[str, Callable[[Path], RawRecording]] = {
    "TYDEX": read_tydex,
    "CSV": read_csv,
    "MDF4": read_mdf,
    "MAT": read_mat,
    "Parquet": read_parquet,
}
_WORKBOOKS = (".xlsx", ".xlsm", ".ods")
"""ZIP archives that nobody thinks of as such."""
SUFFIXES: dict[str, str] = {
    ".tdx": "TYDEX",
    ".tydex": "TYDEX",
    ".csv": "CSV",
    ".tsv": "CSV",
    ".txt": "CSV",
    ".dat": "CSV",
    ".asc": "CSV",
    ".mf4": "MDF4",
    ".mdf": "MDF4",
    ".mat": "MAT",
    ".parquet": "Parquet",
    ".pq": "Parquet",
}


def read_recording(
    path: str | Path,
    *,
    format: str | None = None,
    axes: str | None = None,
    units: Mapping[str, str] | None = None,
    names: Mapping[str, str | float] | None = None,
) -> pd.DataFrame:
    """Read a recording of any known format into canonical columns, in SI and ISO W axes.

    A recording without `time` is a set of steady points. Where a file states no unit, SI is assumed, and
    `attrs["notes"]` says so.

    Parameters
    ----------
    path : str or Path
        Of the file.
    format : {"TYDEX", "CSV", "MDF4", "MAT", "Parquet"}, optional
        Left out: by content, else by suffix.
    axes : {"ISO", "SAE", "adapted SAE"}, optional
        Axes of the file if its names do not state them (TYDEX names do). "SAE" (J670e: y to the
        right, z down) mirrors slip_angle, fy, my and mz, "adapted SAE" (Pacejka's book) the same but
        for slip_angle. Left out: ISO W is assumed, and `attrs` say so.
    units, names : mapping, optional
        By the file's channel name, with or without the unit in it: its unit (over what the file says), the
        column that it is. By a column that the file lacks: the number that it was, as ``{"slip_angle": 0}``.

    Returns
    -------
    DataFrame, one row a sample
        Of `time` s, `slip_angle` rad, `slip_ratio`, `camber` rad, `normal_load` N (compression
        positive), `speed` m/s, `pressure` Pa, `tread_temperature` degC, `fx`, `fy` N, `mx`, `my`,
        `mz` N m those that the file has, then its further channels. `attrs`: `source`, `format`,
        `steady_points`, `channels` (the file's names), `units`, `conversions`, `repeats`,
        `constants`, `comments`, `notes`, `assumed` (axes and units that were not stated),
        `axes_unclear` (what speaks against the axes that were assumed).

    Raises
    ------
    RecordingError
        The file cannot be read, or has no known channel.

    See Also
    --------
    check_recording : Finds faults of a recording.
    join_recordings : Joins several recordings of one tire.

    Notes
    -----
    Formats, names and units: docs/reference/recordings.md; axes: docs/reference/axes.md.

    Examples
    --------
    >>> recording = read_recording("rig_run.csv")
    >>> list(recording.columns)
    ['time', 'slip_angle', 'normal_load', 'speed', 'pressure', 'fy']
    """
    file = Path(path)
    if reason := _no_recording(file):
        raise RecordingError(reason, where=str(file), todo="name a recording that may be read")
    check_size(file)
    kind = _format(file, format)
    try:
        raw = READERS[kind](file)
        bare = _split_units(raw)
        units = {bare.get(k, k): v for k, v in (units or {}).items()}
        names = {bare.get(k, k): v for k, v in (names or {}).items()}
        return canonical_frame(raw, source=str(file), axes=axes, units=units, names=names)
    except RecordingError:
        raise
    except (OSError, MemoryError, UnicodeError) as error:
        raise RecordingError(
            f"cannot be read as {kind} ({type(error).__name__}: {error})", where=str(file)
        ) from error


def _no_recording(file: Path) -> str:
    """Why nothing can be read there; empty if it is a regular file."""
    try:
        return no_regular_file(file)
    except OSError as error:
        return f"it cannot be accessed ({error.strerror})"


def _format(file: Path, format: str | None) -> str:
    """The format by name, by the file's first bytes, or by its suffix."""
    if format is not None:
        by_name = {name.lower(): name for name in READERS}
        if format.lower() not in by_name:
            raise RecordingError(f"format={format!r}", todo=f"one of {', '.join(READERS)}")
        return by_name[format.lower()]
    try:
        with file.open("rb") as stream:
            head = stream.read(4096)
    except OSError as error:
        raise RecordingError(f"cannot be opened ({error.strerror})", where=str(file)) from error
    if not head:
        raise RecordingError("the file is empty", where=str(file), todo="export it again")
    if head[:4] == b"PAR1":
        return "Parquet"
    if head[:3] == b"MDF":
        return "MDF4"
    if head[:10] in (b"MATLAB 5.0", b"MATLAB 7.3"):
        return "MAT"
    if b"**HEADER" in head.upper() or b"**MEASURCHANNELS" in head.upper():
        return "TYDEX"
    kind = SUFFIXES.get(file.suffix.lower())
    archive = kind_of_archive(head)
    if kind is None and archive and file.suffix.lower() not in _WORKBOOKS:
        raise RecordingError(
            f"it is {archive}", where=str(file), todo="unpack it, and give the recordings that are in it"
        )
    if kind is None:
        raise RecordingError(
            f"suffix {file.suffix!r} is not known",
            where=str(file),
            todo="a tire model is not a recording: name a recording"
            if file.suffix.lower() == ".tir"
            else f"save it as CSV or Parquet; if it is one of {', '.join(READERS)} under another suffix, "
            "state that format (format=..., --format)",
        )
    return kind


def _split_units(raw: RawRecording) -> dict[str, str]:
    """Separate units from names where the file states none elsewhere; return full name -> bare name."""
    bare = {}
    for channel in raw.channels:
        base, unit = split_unit(channel.name)
        if unit is not None and not (channel.unit and channel.unit.strip()):
            bare[channel.name] = base
            channel.unit = unit
            channel.name = base
        channel.values = np.asarray(channel.values, dtype=float)
    if len({c.values.size for c in raw.channels}) > 1:
        raise RecordingError("channels have different lengths")
    return bare
