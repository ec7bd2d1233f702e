"""MDF 4 (asammdf), after its block links have been checked."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings.canonical import RawChannel, RawRecording
from tire_pipeline.recordings.limits import check_expansion

_HEADER = struct.Struct("<4sI2Q")
_FIRST_BLOCK = 64
_MOST_LINKS = 1 << 20
# Blocks whose first link leads to the next of their kind.
_CHAINED = (b"##DG", b"##CG", b"##CN", b"##DL", b"##CH", b"##EV", b"##AT", b"##FH")


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
    _check_blocks(path)
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


def _check_blocks(path: Path) -> None:
    """Every link must lead to a block inside the file, and no chain may run in a circle.

    Damaged links would else send the parser round for ever, or make it ask for memory without
    end (ASAM MDF 4.1, chapter 4: a block is `##XX`, length, number of links, links, data).
    """
    size = path.stat().st_size
    with path.open("rb") as file:
        if file.read(8)[:3] != b"MDF":
            raise RecordingError("no MDF file", where=str(path))
        file.seek(8)
        version = file.read(8).strip(b" \x00")
        if not version.startswith(b"4"):
            raise RecordingError(
                f"MDF version {version.decode('latin-1')!r}",
                where=str(path),
                todo="only version 4 is read: convert it with asammdf",
            )
        seen: set[int] = set()
        waiting = [_FIRST_BLOCK]
        unpacked = 0.0
        follows: dict[int, int] = {}
        while waiting:
            at = waiting.pop()
            if at in seen:
                continue
            seen.add(at)
            if len(seen) > _MOST_LINKS or at + _HEADER.size > size:
                raise RecordingError("a block link leads out of the file", where=str(path))
            file.seek(at)
            kind, _, length, links = _HEADER.unpack(file.read(_HEADER.size))
            if not kind.startswith(b"##") or length < _HEADER.size + 8 * links or at + length > size:
                raise RecordingError(f"damaged block at byte {at}", where=str(path))
            raw = file.read(8 * links)
            targets = struct.unpack(f"<{links}Q", raw)
            if kind in _CHAINED and links and targets[0]:
                follows[at] = targets[0]
            if kind == b"##DZ":
                body = file.read(24)
                if len(body) == 24:
                    unpacked += struct.unpack_from("<Q", body, 8)[0]
            if kind == b"##CG":
                # record id, cycles, flags, path separator, reserved, data bytes, invalidation bytes
                body = file.read(32)
                if len(body) == 32:
                    cycles = struct.unpack_from("<Q", body, 8)[0]
                    width = sum(struct.unpack_from("<2I", body, 24))
                    check_expansion(path, float(cycles) * max(width, 1))
            waiting.extend(t for t in targets if t)
        check_expansion(path, unpacked)
    _no_circles(follows, path)


def _no_circles(follows: dict[int, int], path: Path) -> None:
    done: set[int] = set()
    for start in follows:
        here: set[int] = set()
        at: int | None = start
        while at is not None and at not in done:
            if at in here:
                raise RecordingError(f"the chain of blocks at {at} runs in a circle", where=str(path))
            here.add(at)
            at = follows.get(at)
        done |= here


def _collect(file: object) -> RawRecording:
    """All numeric channels on the time base of the group with most samples."""
    notes: list[str] = []
    groups: list[tuple[np.ndarray | None, list[RawChannel]]] = []
    for index, group in enumerate(file.groups):  # type: ignore[attr-defined]
        master_index = file.masters_db.get(index)  # type: ignore[attr-defined]
        master: np.ndarray | None = None
        channels: list[RawChannel] = []
        for number, channel in enumerate(group.channels):
            if number == master_index:
                continue
            signal = file.get(group=index, index=number)  # type: ignore[attr-defined]
            samples = np.asarray(signal.samples)
            if samples.ndim != 1 or samples.dtype.kind not in "fiub":
                notes.append(f"{channel.name}: no plain numbers, left out")
                continue
            values = samples.astype(float)
            if signal.invalidation_bits is not None:
                values[np.asarray(signal.invalidation_bits, dtype=bool)] = np.nan
            channels.append(RawChannel(channel.name, signal.unit or None, values))
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


def _same(one: np.ndarray | None, other: np.ndarray | None) -> bool:
    if one is None or other is None:
        return one is other
    return one.size == other.size and bool(np.array_equal(one, other))
