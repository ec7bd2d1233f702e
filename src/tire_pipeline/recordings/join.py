"""Several recordings of one tire as one, so that one explanation has to hold for all of them."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np
import pandas as pd

from tire_pipeline.channels import FORCE_CHANNELS, FORCE_OF_SLIP, TANGENTIAL_FORCES
from tire_pipeline.errors import RecordingError
from tire_pipeline.pages.numbers_in_words import in_digits
from tire_pipeline.recordings.conventions.channel_names import CANONICAL, FURTHER

LEAST_GAP = 1.0
"""Least time between two recordings that are joined, s."""
GAP_STEPS = 20.0
"""The same in sampling steps: enough to be an interruption wherever time is looked at."""
_SURE_CORRELATION = 0.5
_ZERO_IF_MISSING = {"slip_angle": 0.005, "camber": 0.008, "slip_ratio": 0.01}
"""Inputs that count as zero where they are not recorded, and the size from which that is wrong, rad or 1."""
_JOINED_CHANNELS = tuple(channel.name for channel in (*CANONICAL, *FURTHER) if channel.name != "time")


def join_recordings(recordings: Mapping[str, pd.DataFrame], *, forces_of_any: bool = False) -> pd.DataFrame:
    """Join recordings of one tire on one rig.

    Each recording follows the one before it after a gap in time, so that no filter, lag or delay runs over
    the seam. Only channels that all of them have are kept. Recordings of different rates are brought to the
    slowest: by averages of neighbours, or by single samples where slip changes too fast for averages.

    Parameters
    ----------
    recordings : mapping of str to DataFrame
        Name -> canonical columns in SI, as from :func:`read_recording`, in the order they were recorded in.
    forces_of_any : bool
        Keep a force or moment that only some have, NaN elsewhere: a fit takes `fy` from one and `fx` from
        another.

    Returns
    -------
    DataFrame
        One row a sample, new index. ``attrs["joined"]`` lists ``name``, ``first`` and ``last`` (rows) and
        ``offset`` (s, added to the recording's own time) of each; ``attrs["notes"]`` says which channels were
        left out and what else was done.

    Raises
    ------
    RecordingError
        Some have ``time`` and others do not; time does not rise; one has no force or load in common with the
        others; a slip or camber that varies in one is missing from another; the axes of two differ.

    See Also
    --------
    read_recording : Where recordings come from.

    Notes
    -----
    How several recordings are explained together: docs/how-to/several_recordings.md.

    Examples
    --------
    >>> run = pd.DataFrame(
    ...     {"time": [0.0, 0.1], "normal_load": [4e3, 4e3], "slip_angle": 0.01, "fy": -800.0}
    ... )
    >>> join_recordings({"a": run, "b": run})["time"].tolist()
    [0.0, 0.1, 2.1, 2.2]
    """
    if not recordings:
        raise RecordingError("there is no recording to join", todo="pass at least one")
    empty = [name for name, frame in recordings.items() if len(frame) == 0]
    if empty:
        raise RecordingError(
            "it has no samples", where=", ".join(empty), todo="leave it out, or record again"
        )
    recordings = {name: frame.dropna(axis=1, how="all") for name, frame in recordings.items()}
    timed = {name for name, frame in recordings.items() if "time" in frame}
    if timed and len(timed) < len(recordings):
        without = ", ".join(name for name in recordings if name not in timed)
        raise RecordingError(
            f"{without} has no time, other recordings have",
            todo="explain steady points and runs over time separately",
        )
    notes: list[str] = []
    columns = _common(recordings, notes, FORCE_CHANNELS if forces_of_any else ())
    _one_axis_system(recordings)
    parts = {name: frame.reindex(columns=columns) for name, frame in recordings.items()}
    if timed:
        parts = _one_rate(parts, notes)
    return _laid_end_to_end(parts, recordings, bool(timed), notes)


def _common(
    recordings: Mapping[str, pd.DataFrame], notes: list[str], of_any: Collection[str] = ()
) -> list[str]:
    """Columns of all recordings, and some of any, in their order; note or refuse what some lack."""
    frames = list(recordings.values())
    every = dict.fromkeys(str(c) for frame in frames for c in frame.columns)
    common = [c for c in every if c in of_any or all(c in frame for frame in frames)]
    check_missing(recordings)
    for channel in _JOINED_CHANNELS:
        if channel in of_any:
            continue
        lacking, moving = _lacking_and_moving(recordings, channel)
        if not 0 < len(lacking) < len(frames):
            continue
        note = f"{channel} is left out: {', '.join(lacking)} {_have(lacking)} none"
        if moving and channel not in FORCE_CHANNELS:
            note += f". It varies in {', '.join(moving)}: what depends on it cannot be determined there"
        notes.append(note)
    for what, names in _NEEDED.items():
        if any(not set(names) & set(common) & set(frame) for frame in frames):
            having = {name: ", ".join(n for n in names if n in frame) for name, frame in recordings.items()}
            said = ", ".join(f"{name} has {have or 'none'}" for name, have in having.items())
            raise RecordingError(
                f"{what} is not in all of {', '.join(recordings)}: {said}",
                todo="name the channels, or explain the recordings separately",
            )
    return common


def check_missing(recordings: Mapping[str, pd.DataFrame]) -> None:
    """Refuse recordings of which one lacks a slip or camber that another one has, and that is not zero there.

    Raises
    ------
    RecordingError
        Naming both.
    """
    for channel in _ZERO_IF_MISSING:
        lacking, moving = _lacking_and_moving(recordings, channel)
        if lacking and moving:
            raise RecordingError(
                f"{channel} is not zero in {moving[0]}, and missing from {lacking[0]}: it would count as 0",
                where=channel,
                todo=f"name the channel; or if it was 0 there, say so: --name {lacking[0]}:{channel}=0, in "
                f"Python names={{{channel!r}: 0}}; or leave one of the two recordings out",
            )


def _lacking_and_moving(recordings: Mapping[str, pd.DataFrame], channel: str) -> tuple[list[str], list[str]]:
    """Recordings without a channel, and those in which it varies (or is not zero, where zero is assumed)."""
    lacking = [name for name, frame in recordings.items() if channel not in frame]
    return lacking, [
        name for name, frame in recordings.items() if channel in frame and _moves(frame, channel)
    ]


_NEEDED = {"a force": TANGENTIAL_FORCES, "normal_load": ("normal_load",)}


def _have(names: list[str]) -> str:
    return "has" if len(names) == 1 else "have"


def _moves(frame: pd.DataFrame, channel: str) -> bool:
    values = frame[channel].to_numpy(dtype=float)
    values = values[np.isfinite(values)]
    if values.size == 0:
        return False
    low, high = np.quantile(values, [0.01, 0.99])
    if channel in _ZERO_IF_MISSING:
        return bool(max(abs(low), abs(high)) > _ZERO_IF_MISSING[channel])
    return bool(high - low > 0.03 * max(abs(low), abs(high)))


def _one_axis_system(recordings: Mapping[str, pd.DataFrame]) -> None:
    """Refuse recordings in which a positive slip makes forces of different signs: their axes differ."""
    for slip, force in FORCE_OF_SLIP.items():
        signs: dict[float, str] = {}
        for name, frame in recordings.items():
            if slip not in frame or force not in frame or not _moves(frame, slip):
                continue
            pair = frame[[slip, force]].to_numpy(dtype=float)
            pair = pair[np.isfinite(pair).all(axis=1)]
            if len(pair) < 3 or np.any(np.ptp(pair, axis=0) == 0.0):
                continue
            together = float(np.corrcoef(pair.T)[0, 1])
            if abs(together) > _SURE_CORRELATION:
                signs.setdefault(float(np.sign(together)), name)
        if len(signs) > 1:
            raise RecordingError(
                f"a positive {slip} gives a positive {force} in {signs[1.0]}, a negative in {signs[-1.0]}",
                where=force,
                todo=f"turn {slip} or {force} at its source (axes SAE turn both), or leave one out",
            )


def _one_rate(parts: Mapping[str, pd.DataFrame], notes: list[str]) -> dict[str, pd.DataFrame]:
    """Average neighbours of the faster recordings, so that all have about the rate of the slowest."""
    steps = {name: _step(name, frame) for name, frame in parts.items()}
    slowest = max(steps.values())
    result = dict(parts)
    slow = max(steps, key=lambda name: steps[name])
    for name, step in steps.items():
        count = round(slowest / step)
        if count < 2:
            continue
        averaged = _averaged(parts[name], step, count)
        if len(averaged) < 2:
            raise RecordingError(
                f"there are {in_digits(slowest, 3)} s from sample to sample, longer than all of {name}",
                where=slow,
                todo="check the unit of its time, or leave it out",
            )
        rates = f"{1 / step:.4g} to {1 / (step * count):.4g} Hz, the rate of {slow}"
        if _smeared(parts[name], count):
            result[name] = parts[name].iloc[::count].reset_index(drop=True)
            notes.append(
                f"{name}: one of {count} samples is used, {rates}; slip changes too fast to average them. "
                f"Without {slow} all are used"
            )
        else:
            result[name] = averaged
            notes.append(f"{name}: {count} samples each averaged, {rates}")
    return result


def _smeared(frame: pd.DataFrame, count: int) -> bool:
    """Whether a slip changes so much within samples that are averaged that the mean force is another one."""
    size = len(frame) // count * count
    for slip, much in _ZERO_IF_MISSING.items():
        if slip in frame:
            groups = frame[slip].to_numpy(dtype=float)[:size].reshape(-1, count)
            if np.nanquantile(np.abs(groups[:, -1] - groups[:, 0]), 0.9) > much:
                return True
    return False


def _step(name: str, frame: pd.DataFrame) -> float:
    time = frame["time"].to_numpy(dtype=float)
    steps = np.diff(time[np.isfinite(time)])
    if steps.size == 0:
        raise RecordingError("it has fewer than two samples", where=name, todo="leave it out")
    if np.any(steps <= 0.0):
        raise RecordingError(
            "time does not rise from sample to sample",
            where=name,
            todo="sort the recording and drop repeated rows, or split it where time starts again",
        )
    return float(np.median(steps))


def _averaged(frame: pd.DataFrame, step: float, count: int) -> pd.DataFrame:
    """Mean of each ``count`` neighbours; nothing is averaged over a gap."""
    time = frame["time"].to_numpy(dtype=float)
    frame = frame[np.isfinite(time)]
    time = time[np.isfinite(time)]
    piece = np.cumsum(np.diff(time, prepend=time[0]) > 3.5 * step)
    within = np.arange(time.size) - np.searchsorted(piece, piece)
    numbers = frame.select_dtypes("number")
    groups = numbers.groupby([piece, within // count])
    return groups.mean()[(groups.size() == count).to_numpy()].reset_index(drop=True)


def _laid_end_to_end(
    parts: Mapping[str, pd.DataFrame],
    recordings: Mapping[str, pd.DataFrame],
    timed: bool,
    notes: list[str],
) -> pd.DataFrame:
    laid: list[pd.DataFrame] = []
    joined: list[dict[str, object]] = []
    row, end = 0, 0.0
    starts: list[str] = []
    for name, frame in parts.items():
        offset = 0.0
        if timed:
            time = frame["time"].to_numpy(dtype=float)
            gap = max(LEAST_GAP, GAP_STEPS * float(np.nanmedian(np.diff(time)))) if laid else 0.0
            offset = end + gap - float(np.nanmin(time)) if laid else 0.0
            frame = frame.assign(time=time + offset)
            end = float(np.nanmax(frame["time"]))
            starts.append(f"{name} (from {in_digits(float(np.nanmin(frame['time'])), 4)} s)")
        joined.append({"name": name, "first": row, "last": row + len(frame) - 1, "offset": offset})
        row += len(frame)
        laid.append(frame)
    if timed and len(laid) > 1:
        notes.append(
            f"{len(laid)} recordings were joined in the order {', '.join(starts)}; heat, wear and drift go "
            "on from one to the next, as if nothing happened between them"
        )
    said: dict[str, list[str]] = {}
    for name, frame in recordings.items():
        for note in frame.attrs.get("notes", []):
            said.setdefault(note, []).append(name)
    notes += [f"{', '.join(names)}: {note}" for note, names in said.items()]
    result = pd.concat([frame.reset_index(drop=True) for frame in laid], ignore_index=True)
    result.attrs = {"joined": joined, "notes": notes, "steady_points": not timed}
    frames = recordings.values()
    converted = dict.fromkeys(text for frame in frames for text in frame.attrs.get("conversions", []))
    if converted:
        result.attrs["conversions"] = list(converted)
    assumed = dict.fromkeys(text for frame in frames for text in frame.attrs.get("assumed", []))
    against = dict.fromkeys(str(frame.attrs.get("axes_unclear", "")) for frame in frames)
    if assumed:
        result.attrs |= {"assumed": list(assumed), "axes_unclear": "; ".join(filter(None, against))}
    return result
