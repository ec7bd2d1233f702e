"""MDF 4 (asammdf), after its block links have been checked."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings.conventions.canonical import RawChannel, RawRecording
from tire_pipeline.recordings.readers.mdf_blocks import check_blocks

# MDF 4.1: data types 0 to 5 are integers and floats, channel type 1 is of changing length.
_LARGEST_NUMERIC_TYPE, _VARIABLE_LENGTH = 5, 1


def read_mdf(path: Path) -> RawRecording:
    """Read an MDF 4 file; channel groups of other rates are brought to the fastest one.

    Parameters
    ----------
    path : Path

    Returns
    -------
    RawRecording
        Time is the groups' master channel.

    Raises
    ------
    RecordingError
        Another version, a damaged file, or no numeric channels.
    """
    check_blocks(path)
    try:
        from asammdf import MDF

        with MDF(str(path)) as file:
            return _collect(file)
    except RecordingError as error:
        raise RecordingError(error.what, where=str(path), todo=error.todo) from error
    except Exception as error:  # asammdf raises whatever its parser trips over
        raise RecordingError(
            f"cannot be read as MDF 4 ({type(error).__name__}: {str(error)[:200]})",
            where=str(path),
        ) from error


def _collect(file: Any) -> RawRecording:
    """All numeric channels on the time base of the group with most samples."""
    notes: list[str] = []
    groups: list[tuple[np.ndarray | None, list[RawChannel]]] = []
    for index, group in enumerate(file.groups):
        master_index = file.masters_db.get(index)
        master: np.ndarray | None = None
        channels: list[RawChannel] = []
        for number, channel in enumerate(group.channels):
            if number == master_index:
                continue
            if channel.data_type > _LARGEST_NUMERIC_TYPE or channel.channel_type == _VARIABLE_LENGTH:
                notes.append(f"{channel.name}: no plain numbers, left out")
                continue
            # asammdf would drop invalid samples, and the channels of a group were of different lengths
            signal = file.get(group=index, index=number, ignore_invalidation_bits=True)
            samples = np.asarray(signal.samples)
            if samples.ndim != 1 or samples.dtype.kind not in "fiub":
                notes.append(f"{channel.name}: no plain numbers, left out")
                continue
            values = samples.astype(float)
            if signal.invalidation_bits is not None:
                values[np.asarray(signal.invalidation_bits, dtype=bool)] = np.nan
            channels.append(RawChannel(_own_name(channel.name), signal.unit or None, values))
            if master_index is not None and master is None:
                master = np.asarray(signal.timestamps, dtype=float)
        if channels and channels[0].values.size:
            groups.append((master, channels))
    if not groups:
        raise RecordingError("no numeric channels with samples")
    base, _ = max(groups, key=lambda g: g[1][0].values.size)
    length = max(g[1][0].values.size for g in groups)
    out: list[RawChannel] = []
    for master, channels in groups:
        for channel in channels:
            values = channel.values
            if values.size != length or not _same(master, base):
                if master is None or base is None or values.size < 2:
                    notes.append(f"{channel.name}: {values.size} samples without time, left out")
                    continue
                notes.append(f"{channel.name}: brought to the fastest group's time by lines")
                values = np.interp(base, master, values, left=np.nan, right=np.nan)
            out.append(RawChannel(channel.name, channel.unit, values))
    if base is not None:
        out.insert(0, RawChannel("time", "s", base))
    return RawRecording("MDF4", out, notes=notes)


def _own_name(name: str) -> str:
    """A channel's name without the device that INCA appends to it: ``FY\\ETKC:1``."""
    return name.partition("\\")[0] or name


def _same(one: np.ndarray | None, other: np.ndarray | None) -> bool:
    if one is None or other is None:
        return one is other
    return one.size == other.size and bool(np.array_equal(one, other))
