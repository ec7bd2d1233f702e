"""From a file's channels, as it names and measures them, to the canonical DataFrame."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from tire_pipeline.channels import SLIP_AND_LOAD
from tire_pipeline.errors import RecordingError, did_you_mean
from tire_pipeline.pages.numbers_in_words import first_of
from tire_pipeline.recordings.conventions.axis_systems import to_iso_w
from tire_pipeline.recordings.conventions.channel_names import CANONICAL, FURTHER, Channel, find_channel
from tire_pipeline.recordings.conventions.drive_columns import reader_of_drive
from tire_pipeline.recordings.conventions.slip_from_speeds import slip_from_speeds
from tire_pipeline.recordings.conventions.units import UNITS_BY_NAME, find_unit, number_of
from tire_pipeline.recordings.conventions.unrecognised import may_be, of_a_wheel, one_column_a_load

_SI = {c.name: c.unit for c in CANONICAL}
_SI_ASSUMED = "no unit given, SI assumed"
STRANGE_NAMED = 20
"""So many columns of no known name are named; ``tire check --json`` has them all."""


@dataclass
class RawChannel:
    """One channel with the name, unit and values of the file."""

    name: str
    unit: str | None
    values: NDArray[np.float64]


@dataclass
class RawRecording:
    """What a reader of one format returns."""

    format: str
    channels: list[RawChannel]
    constants: dict[str, dict[str, object]] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    comments: list[str] = field(default_factory=list)


def notes_beside_assumed(recording: pd.DataFrame) -> list[str]:
    """Return the notes of a recording that ``attrs["assumed"]`` does not say as well."""
    return [note for note in recording.attrs.get("notes", []) if _SI_ASSUMED not in note]


def canonical_frame(
    raw: RawRecording,
    *,
    source: str,
    axes: str | None = None,
    units: Mapping[str, str] | None = None,
    names: Mapping[str, str | float] | None = None,
) -> pd.DataFrame:
    """Name, convert and order the channels.

    Parameters
    ----------
    raw : RawRecording
    source : str
        The file, for messages and `attrs`.
    axes : {"ISO", "SAE", "adapted SAE"}, optional
        The axes the file is in where its names do not say. Left out: ISO W is assumed, and that is said.
    units, names : mapping, optional
        By the file's channel name: the unit that holds, the column that it is. By the column: a number that
        it holds throughout.

    Returns
    -------
    DataFrame
        See :func:`tire_pipeline.recordings.read_recording`.
    """
    raw, named = _with_constants(raw, names or {}, source)
    _check_units(raw, units or {}, source)
    notes, assumed = list(raw.notes), []
    conversions: list[str] = []
    chosen = _assign(raw, named, notes, source)
    origin = {column: item.name for item, _, column in chosen}
    columns, unit_names, unsaid = _in_si(chosen, units or {}, source, notes, conversions)
    if unsaid:
        notes.append(f"{_SI_ASSUMED}: {', '.join(unsaid)}")
        assumed.append(f"SI units of {', '.join(unsaid)}, for which the file gives none")
    strange = [column for item, channel, column in chosen if channel is None and not find_channel(item.name)]
    if strange:
        notes.append(f"not used, because their names are not known: {first_of(strange, STRANGE_NAMED)}")
    wheels = of_a_wheel(strange)
    if not any(name in _SI for name in columns):
        raise RecordingError(
            f"no channel is recognised among {', '.join(map(_with_unit, raw.channels[:12]))}",
            where=source,
            todo=reader_of_drive({c.name for c in raw.channels}.union(map(_with_unit, raw.channels)))
            or wheels
            or "name them with names={'their name': 'slip_angle', ...}, on the command line with --name "
            "'their name=slip_angle', in a pipeline as docs/how-to/state_axes_and_units.md shows",
        )
    unnamed = {i.name: (units or {}).get(i.name, i.unit) for i, known, _ in chosen if known is None}
    notes += filter(None, [wheels, may_be(unnamed, columns)])
    layout = one_column_a_load(strange, columns)
    notes += [layout] if layout else []
    frame = _ordered(columns)
    axes_said, against = to_iso_w(frame, origin, raw.constants, axes, notes, conversions, source)
    assumed.insert(0, axes_said)
    frame = slip_from_speeds(frame, notes)
    frame, repeats = _repeats(frame, notes)
    frame = frame.reset_index(drop=True)
    frame.attrs = {
        "source": source,
        "format": raw.format,
        "steady_points": "time" not in frame,
        "channels": {c: origin[c] for c in frame.columns if c in origin},
        "units": {c: unit_names[c] for c in frame.columns if c in unit_names},
        "file_units": {c: (units or {}).get(i.name, i.unit) for i, known, c in chosen if known},
        "conversions": conversions,
        "repeats": repeats,
        "constants": raw.constants,
        "comments": raw.comments,
        "notes": notes,
        "assumed": assumed,
        "axes_unclear": against,
        "layout": layout,
    }
    return frame


def _with_constants(
    raw: RawRecording, names: Mapping[str, str | float], source: str
) -> tuple[RawRecording, dict[str, str]]:
    """Return a recording with a channel for each that is stated to hold a number, and the other names."""
    there, size = {c.name for c in raw.channels}, max((c.values.size for c in raw.channels), default=0)
    held, others = [], {}
    for name, told in names.items():
        value = number_of(str(told))
        if value is None or not np.isfinite(value):
            others[name] = str(told)
            continue
        if name not in _SI or name in there:
            is_there = "the file has that column" if name in there else "it is no channel"
            raise RecordingError(
                f"{name} is stated to be {told}, but {is_there}",
                where=source,
                todo="leave it out" if name in there else did_you_mean(name, _SI, "name a channel"),
            )
        held.append(RawChannel(name, None if value else _SI[name], np.full(size, value)))
    said = [f"{channel.name} is {names[channel.name]} throughout, as was stated" for channel in held]
    return replace(raw, channels=[*raw.channels, *held], notes=[*raw.notes, *said]), others


def _with_unit(channel: RawChannel) -> str:
    return f"{channel.name} ({channel.unit})" if channel.unit else channel.name


def _in_si(
    chosen: list[tuple[RawChannel, Channel | None, str]],
    units: Mapping[str, str],
    source: str,
    notes: list[str],
    conversions: list[str],
) -> tuple[dict[str, NDArray[np.float64]], dict[str, str], list[str]]:
    """Values and units by column, and the columns for which the file gives no unit; what is done is noted."""
    columns: dict[str, NDArray[np.float64]] = {}
    unit_names: dict[str, str] = {}
    unsaid: list[str] = []
    for item, channel, column in chosen:
        unit = units.get(item.name, item.unit)
        values = item.values
        if channel is not None:
            values, said = _to_si(item.name, values, unit, channel, source, column, notes, unsaid)
            conversions += said
            unit_names[column] = channel.unit
        elif unit:
            unit_names[column] = unit
        columns[column] = _no_overflow(item.name, values, notes)
    return columns, unit_names, unsaid


def _no_overflow(name: str, values: NDArray[np.float64], notes: list[str]) -> NDArray[np.float64]:
    """Put NaN where a number is infinite, or so large that its square is: no channel reaches it."""
    with np.errstate(over="ignore", invalid="ignore"):
        beyond = ~np.isnan(values) & ~np.isfinite(values * values)
    if not beyond.any():
        return values
    notes.append(f"{name}: {int(beyond.sum())} values are beyond any measurement and became NaN")
    return np.where(beyond, np.nan, values)


def _check_units(raw: RawRecording, units: Mapping[str, str], source: str) -> None:
    """Check that stated units are known, and are of channels that exist."""
    there = [c.name for c in raw.channels]
    strange = [name for name in units if name not in there]
    if strange:
        raise RecordingError(
            f"a unit is stated for {', '.join(map(repr, strange))}, which the file does not have",
            where=source,
            todo=f"its channels are {', '.join(there[:30])}",
        )
    for name, unit in units.items():
        if find_unit(unit) is None:
            raise RecordingError(
                f"the stated unit {unit!r} of channel {name} is not known",
                where=source,
                todo=did_you_mean(
                    unit,
                    UNITS_BY_NAME,
                    "spell it as docs/reference/recordings.md does, such as deg, km/h or kPa",
                ),
            )


def _assign(
    raw: RawRecording, names: dict[str, str], notes: list[str], source: str
) -> list[tuple[RawChannel, Channel | None, str]]:
    """Give each channel its column; of several for one column the best-known name wins."""
    unknown = [n for n in names if n not in {c.name for c in raw.channels}]
    if unknown:
        raise RecordingError(
            f"a name is stated for {', '.join(map(repr, unknown))}, which the file does not have",
            where=source,
            todo="its channels are " + ", ".join(c.name for c in raw.channels[:30]),
        )
    _check_told(names, source)
    best: dict[str, tuple[int, int]] = {}
    found: list[tuple[Channel, int] | None] = []
    for index, item in enumerate(raw.channels):
        told = names.get(item.name)
        hit = find_channel(told if told is not None else item.name)
        if hit and told is not None:
            hit = (hit[0], -1)
        found.append(hit)
        if hit and (hit[0].name not in best or hit[1] < best[hit[0].name][0]):
            best[hit[0].name] = (hit[1], index)
    result: list[tuple[RawChannel, Channel | None, str]] = []
    taken: set[str] = set(best)
    numbers: dict[str, int] = {}
    for index, (item, hit) in enumerate(zip(raw.channels, found, strict=True)):
        if hit and best[hit[0].name][1] == index:
            result.append((item, hit[0], hit[0].name))
            continue
        column = names.get(item.name, item.name) or f"channel_{index + 1}"
        if hit:
            notes.append(_beside(item, raw.channels[best[hit[0].name][1]], hit[0].name))
        base = column
        while column in taken:
            numbers[base] = numbers.get(base, 1) + 1
            column = f"{base}_{numbers[base]}"
        taken.add(column)
        result.append((item, None, column))
    return result


def _beside(item: RawChannel, winner: RawChannel, channel: str) -> str:
    """Say which of two columns for one channel it is."""
    if item.name == winner.name:
        return f"{item.name}: two columns have this name; {channel} is the first, the other is kept beside it"
    return f"{item.name}: {channel} is taken from {winner.name}; kept beside it"


def _check_told(names: Mapping[str, str], source: str) -> None:
    """Check that a column is stated to be a known channel."""
    for column, told in names.items():
        if told and find_channel(told) is None:
            raise RecordingError(
                f"column {column!r} is stated to be {told!r}, which is not a known channel",
                where=source,
                todo=did_you_mean(
                    told,
                    [channel.name for channel in (*CANONICAL, *FURTHER)],
                    "the file's name stands first and the channel second, such as Kraft_y=fy; "
                    "docs/reference/recordings.md lists the channels",
                ),
            )


def _to_si(
    name: str,
    values: NDArray[np.float64],
    unit: str | None,
    channel: Channel,
    source: str,
    column: str,
    notes: list[str],
    unsaid: list[str],
) -> tuple[NDArray[np.float64], list[str]]:
    known = find_unit(unit)
    if known is None:
        if unit and unit.strip():
            notes.append(f"{name}: unit {unit!r} is not known; {channel.unit} assumed")
        else:
            unsaid.append(f"{name} ({channel.unit})")
        return values, []
    if known.dimension != channel.dimension and not (
        channel.dimension == "ratio" and known.dimension == "angle" and known.factor == 1
    ):
        raise RecordingError(
            f"channel {name} has unit {unit!r}, which is no {channel.dimension}",
            where=source,
            todo=f"say what holds: units={{{name!r}: {channel.unit!r}}}, on the command line "
            f"--unit '{name}={channel.unit}'; if it is another quantity, name its channel",
        )
    if known.factor == 1 and known.offset == 0:
        return values, []
    with np.errstate(over="ignore", invalid="ignore"):
        values = values * known.factor + known.offset
    return values, [f"{column}: {name} from {unit} to {channel.unit}"]


def _ordered(columns: dict[str, NDArray[np.float64]]) -> pd.DataFrame:
    first = [c.name for c in CANONICAL if c.name in columns]
    rest = [c for c in columns if c not in _SI]
    return pd.DataFrame({c: columns[c] for c in (*first, *rest)}, copy=False)


def _repeats(frame: pd.DataFrame, notes: list[str]) -> tuple[pd.DataFrame, dict[str, int]]:
    """Drop identical rows that repeat a time stamp; count the others and repeated points."""
    counts = {"identical_rows_dropped": 0, "repeated_stamps": 0, "backward_stamps": 0}
    if "time" not in frame:
        points = [c for c in SLIP_AND_LOAD if c in frame]
        if points and len(frame) > 1:
            steps = {"slip_angle": 2e-3, "slip_ratio": 2e-3, "camber": 4e-3}
            loads = np.abs(frame["normal_load"].to_numpy()) if "normal_load" in frame else np.ones(1)
            loads = loads[np.isfinite(loads)]
            steps["normal_load"] = 0.02 * float(loads.max(initial=0.0)) or 1.0
            with np.errstate(over="ignore", invalid="ignore"):
                grid = pd.DataFrame({c: np.round(frame[c] / steps[c]) for c in points})
            counts["repeated_points"] = int(grid.duplicated(keep=False).sum())
        return frame, counts
    time = frame["time"].to_numpy()
    with np.errstate(invalid="ignore"):
        step = np.diff(time)
    again = np.concatenate([[False], step == 0])
    if again.any():
        where = np.flatnonzero(again)
        now, before = frame.iloc[where].to_numpy(), frame.iloc[where - 1].to_numpy()
        same = ((now == before) | (np.isnan(now) & np.isnan(before))).all(axis=1)
        counts["identical_rows_dropped"] = int(same.sum())
        counts["repeated_stamps"] = int((~same).sum())
        if same.any():
            frame = frame.drop(index=frame.index[where[same]])
            notes.append(f"{same.sum()} rows that repeat the row before them were dropped")
        if (~same).any():
            notes.append(f"{(~same).sum()} time stamps repeat with other values: kept (see check_recording)")
    counts["backward_stamps"] = int((step < 0).sum())
    if counts["backward_stamps"]:
        notes.append(
            f"time runs backwards at {counts['backward_stamps']} places: rows kept in the file's order"
        )
    return frame, counts
