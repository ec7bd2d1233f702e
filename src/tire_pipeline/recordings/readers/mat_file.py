"""MATLAB .mat files up to version 7 (scipy.io): vectors, or a struct of vectors."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import scipy

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings.conventions.canonical import RawChannel, RawRecording
from tire_pipeline.recordings.conventions.channel_names import find_channel
from tire_pipeline.recordings.conventions.units_in_names import split_unit
from tire_pipeline.recordings.readers.limits import check_expansion
from tire_pipeline.recordings.readers.mat_elements import check_elements

_LEVEL_5 = 1  # of scipy's numbers: 0 is MATLAB's version 4, 2 is HDF5
_HDF5 = b"\x89HDF\r\n\x1a\n"


def read_mat(path: Path) -> RawRecording:
    """Read the vectors of a .mat file.

    They may stand at the top (as in the Tire Test Consortium's files, whose `channel.name` and
    `channel.units` are heeded) or in one struct, with a struct or field `units` beside them.

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
    units = _ttc_units(content.get("channel"))
    name, group = _richest(content)
    units = {**units, **_units_of(content.get("units")), **_units_of(group.get("units"))}
    vectors = {k: _vector(v) for k, v in group.items() if k not in ("units", "channel")}
    lengths = [v.size for k, v in vectors.items() if v is not None and v.size > 1]
    if not lengths:
        opaque = [k for k, _, kind in listed if kind in ("opaque", "object", "function", "unknown")]
        raise RecordingError(
            "no numeric vectors" + (f"; {', '.join(opaque)} are MATLAB objects" if opaque else ""),
            where=str(path),
            todo="save vectors or a struct: s = table2struct(T, 'ToScalar', true)",
        )
    length = max(set(lengths), key=lambda n: (lengths.count(n), n))
    notes = [f"taken from the struct {name}"] if name else []
    channels: list[RawChannel] = []
    constants: dict[str, dict[str, object]] = {}
    for key, vector in vectors.items():
        if vector is not None and vector.size == length:
            channels.append(RawChannel(key, units.get(key), vector))
        elif vector is not None and vector.size == 1:
            constants[key] = {"value": float(vector[0]), "unit": units.get(key), "comment": ""}
        elif isinstance(group[key], str):
            constants[key] = {"value": group[key], "unit": None, "comment": ""}
        else:
            notes.append(f"{key}: no vector of {length} numbers, left out")
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
            f"cannot be read as a .mat file ({type(error).__name__}: {error})", where=str(path)
        ) from error
    return {k: v for k, v in content.items() if not k.startswith("__")}, listed


def _vector(value: object) -> np.ndarray | None:
    """A numeric vector as floats, None for anything else."""
    if not isinstance(value, (np.ndarray, int, float, np.number, np.bool_)):
        return None
    array = np.asarray(value)
    if array.dtype.kind not in "fiub" or sum(n != 1 for n in array.shape) > 1:
        return None
    return array.reshape(-1).astype(float)


def _richest(content: dict[str, object]) -> tuple[str, dict[str, object]]:
    """The top level or that struct which holds most recognised channels."""

    def score(group: dict[str, object]) -> int:
        return sum(
            _vector(v) is not None and find_channel(split_unit(k)[0]) is not None for k, v in group.items()
        )

    best, best_name, best_score = content, "", score(content)
    for name, value in content.items():
        if isinstance(value, dict) and name not in ("units", "channel"):
            here = score(value)
            if here > best_score:
                best, best_name, best_score = value, name, here
    return best_name, {str(k): v for k, v in best.items()}


def _units_of(value: object) -> dict[str, str]:
    if not isinstance(value, dict):
        return {}
    return {str(k): v for k, v in value.items() if isinstance(v, str)}


def _ttc_units(channel: object) -> dict[str, str]:
    """Names and units of the `channel` struct of a Tire Test Consortium file."""
    if not isinstance(channel, dict):
        return {}
    names, units = channel.get("name"), channel.get("units")
    if names is None or units is None:
        return {}
    pairs = zip(np.ravel(np.asarray(names)), np.ravel(np.asarray(units)), strict=False)
    return {str(n).strip(): str(u).strip() for n, u in pairs}
