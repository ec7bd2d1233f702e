"""MATLAB .mat files up to version 7 (scipy.io)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import scipy

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings.conventions.canonical import RawChannel, RawRecording
from tire_pipeline.recordings.readers.limits import check_expansion
from tire_pipeline.recordings.readers.mat_elements import check_elements
from tire_pipeline.recordings.readers.mat_layouts import richest, stated_units

_LEVEL_5 = 1  # of scipy's numbers: 0 is MATLAB's version 4, 2 is HDF5
_HDF5 = b"\x89HDF\r\n\x1a\n"


def read_mat(path: Path) -> RawRecording:
    """Read the channels of a .mat file.

    They may stand at the top (as in the Tire Test Consortium's files, whose `channel.name` and
    `channel.units` are heeded) or in a struct: as vectors with `units` beside them, as structs of data and
    unit, as elements of a struct array, or as columns of a matrix beside their names.

    Parameters
    ----------
    path : Path

    Returns
    -------
    RawRecording

    Raises
    ------
    RecordingError
        Version 7.3 (HDF5), tables and other objects, or no vectors.
    """
    content, listed = _loaded(path)
    try:
        table = richest(content)
    except RecordingError as error:
        raise RecordingError(error.what, where=str(path), todo=error.todo) from error
    # A unit that stands beside the channels holds before one at the top of the file.
    units = {**stated_units(content.get("channel")), **stated_units(content.get("units")), **table.units}
    lengths = [v.size for v in table.vectors.values() if v.size > 1]
    if not lengths:
        opaque = [k for k, _, kind in listed if kind in ("opaque", "object", "function", "unknown")]
        raise RecordingError(
            "no numeric vectors" + (f"; {', '.join(opaque)} are MATLAB objects" if opaque else ""),
            where=str(path),
            todo="save vectors or a struct: s = table2struct(T, 'ToScalar', true)",
        )
    if table.others and table.where:
        raise RecordingError(
            f"{', '.join([table.where, *table.others])} each hold a recording",
            where=str(path),
            todo="save each in a file of its own, and pass all of one tire together",
        )
    length = max(set(lengths), key=lambda n: (lengths.count(n), n))
    notes = [f"taken from the struct {table.where}"] if table.where else []
    channels: list[RawChannel] = []
    constants: dict[str, dict[str, object]] = {
        key: {"value": text, "unit": None, "comment": ""} for key, text in table.texts.items()
    }
    for key, vector in table.vectors.items():
        if vector.size == length:
            channels.append(RawChannel(key, units.get(key), vector))
        elif vector.size == 1:
            constants[key] = {"value": float(vector[0]), "unit": units.get(key), "comment": ""}
        else:
            table.left_out.append(key)
    notes += [f"{key}: no vector of {length} numbers, left out" for key in table.left_out]
    return RawRecording("MAT", channels, constants, notes)


def _loaded(path: Path) -> tuple[dict[str, Any], list[tuple[str, tuple[int, ...], str]]]:
    """What the file holds by name, and the name, shape and kind of each part as the file states them."""
    with path.open("rb") as file:
        head = file.read(1024)
    if b"MATLAB 7.3 MAT-file" in head[:128] or _HDF5 in (head[:8], head[512:520]):
        raise RecordingError(
            "a MATLAB 7.3 file (HDF5)",
            where=str(path),
            todo="save it with save('name.mat', ..., '-v7')",
        )
    try:
        if scipy.io.matlab.matfile_version(str(path))[0] == _LEVEL_5:
            check_elements(path)
        listed = scipy.io.whosmat(str(path))
        values = sum(float(np.prod([float(n) for n in shape])) for _, shape, _ in listed)
        check_expansion(path, 8 * values)
        # simplify_cells makes plain dicts; objects stay opaque and are refused below.
        content = scipy.io.loadmat(str(path), simplify_cells=True)
    except RecordingError:
        raise
    except Exception as error:  # scipy raises whatever its parser trips over
        raise RecordingError(
            f"cannot be read as a .mat file ({type(error).__name__}: {error})",
            where=str(path),
            todo="save it again with save('name.mat', ..., '-v7'); if it is no MATLAB file, state no format",
        ) from error
    return {k: v for k, v in content.items() if not k.startswith("__")}, listed
