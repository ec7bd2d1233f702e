"""Parquet (pyarrow)."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pyarrow as pa

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings.conventions.canonical import RawChannel, RawRecording
from tire_pipeline.recordings.readers.limits import check_expansion

if TYPE_CHECKING:
    import pyarrow.parquet as pq


_KINDS_OF_NUMBERS = (pa.types.is_floating, pa.types.is_integer, pa.types.is_boolean, pa.types.is_decimal)


def read_parquet(path: Path) -> RawRecording:
    """Read the numeric columns of a Parquet file.

    Units come from a field's metadata (`unit` or `units`), or from `attrs["units"]` of the
    DataFrame that was written.

    Parameters
    ----------
    path : Path

    Returns
    -------
    RawRecording

    Raises
    ------
    RecordingError
        The file is damaged or holds no numeric columns.
    """
    import pyarrow.parquet as pq  # slow to import, and few recordings are Parquet

    try:
        with pq.ParquetFile(path) as file:
            rows, schema = file.metadata.num_rows, file.schema_arrow
            check_expansion(path, 8.0 * rows * max(1, len(schema.names)))
            return _read(file, schema)
    except RecordingError as error:
        if error.where is None:
            raise RecordingError(error.what, where=str(path), todo=error.todo) from error
        raise
    except Exception as error:  # pyarrow raises many kinds on damaged files
        raise RecordingError(
            f"cannot be read as Parquet ({type(error).__name__}: {str(error)[:200]})",
            where=str(path),
        ) from error


def _read(file: pq.ParquetFile, schema: pa.Schema) -> RawRecording:
    notes: list[str] = []
    told = _attrs(schema)
    listed = told.get("units")
    units = listed if isinstance(listed, dict) else {}
    channels: list[RawChannel] = []
    for field in schema:
        kind = field.type
        stamp = pa.types.is_timestamp(kind) or pa.types.is_duration(kind)
        number = any(is_kind(kind) for is_kind in _KINDS_OF_NUMBERS)
        if field.name.startswith("__index_level_"):
            continue
        if not (stamp or number):
            notes.append(f"{field.name}: {kind}, no numbers, left out")
            continue
        column = file.read(columns=[field.name]).column(0)
        if pa.types.is_decimal(kind):
            column = column.cast(pa.float64())
        if stamp:
            values = column.cast(pa.int64()).to_pandas().to_numpy(dtype=float, na_value=np.nan)
            scale = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}[kind.unit]
            values = (values - np.nanmin(values)) * scale if values.size else values
            notes.append(f"{field.name}: dates, counted in seconds from the first")
            channels.append(RawChannel(field.name, "s", values))
            continue
        values = column.to_pandas().to_numpy(dtype=float, na_value=np.nan)
        meta = {k.decode().lower(): v.decode() for k, v in (field.metadata or {}).items()}
        unit = meta.get("unit") or meta.get("units") or units.get(field.name)
        channels.append(RawChannel(field.name, unit, values))
    if not channels or channels[0].values.size == 0:
        raise RecordingError("no numeric columns with rows")
    constants = told.get("constants")
    return RawRecording("Parquet", channels, constants if isinstance(constants, dict) else {}, notes)


def _attrs(schema: pa.Schema) -> dict[str, object]:
    """What pandas wrote as `attrs`."""
    raw = (schema.metadata or {}).get(b"PANDAS_ATTRS")
    if not raw:
        return {}
    try:
        value = json.loads(raw)
    except ValueError:
        return {}
    return value if isinstance(value, dict) else {}
