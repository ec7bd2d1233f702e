"""Checks of a recording before it is explained."""

from __future__ import annotations

import numpy as np
import pandas as pd

from tire_pipeline.channels import RECORDED_CHANNELS, TANGENTIAL_FORCES
from tire_pipeline.magic_formula.fitting.setup.measured import locked_parts
from tire_pipeline.pages.numbers_in_words import how_many, in_digits
from tire_pipeline.recordings.conventions.channel_names import CANONICAL, FURTHER
from tire_pipeline.recordings.conventions.drive_columns import reader_of_drive
from tire_pipeline.recordings.conventions.plausible import (
    FORCE_OVER_LOAD,
    PLAUSIBLE_VALUES,
    likely_load_units,
    likely_unit_stated,
    likely_units,
    plausible,
    size,
    unit_stated,
    units_of_larger_loads,
)
from tire_pipeline.recordings.issue import Issue
from tire_pipeline.recordings.physical_signs import (
    grip_of_no_tire,
    moment_beyond_reach,
    moment_of_other_sign,
    side_force_away_from_the_lean,
    side_force_with_the_slip,
    slip_too_small,
)
from tire_pipeline.recordings.slip_definition import slip_ratio_defined_otherwise
from tire_pipeline.recordings.spikes import said_of_spikes, spikes
from tire_pipeline.recordings.stretches import stretches
from tire_pipeline.recordings.time_unit import unit_of_time
from tire_pipeline.recordings.unit_jumps import unit_jumps
from tire_pipeline.recordings.whole_rows import (
    LEAST_POINTS,
    LEAST_SAMPLES,
    LONGEST_HOLE,
    USED,
    few_whole_rows,
    unread_cells,
)
from tire_pipeline.small_loads import in_another_unit_as

BREAK_OF_TIME_LINE = LONGEST_HOLE + 0.5
"""Usual steps in one, over which a run is interrupted: more than ``LONGEST_HOLE`` to the nearest whole."""
_UNIT_OF_CHANNEL = {c.name: c.unit for c in (*CANONICAL, *FURTHER)}
LONG_GAP = 5.0
"""A step of more than so many usual ones is reported as a gap: states are unknown after it."""
_NAN_BLOCK = 10
_SHARPEST_TURN_OF_CARS = 0.3
"""Curvature, 1/m, beyond which only a model car turns: cars need a radius of 4.5 m at least."""
_BOTH_SIGNS = 0.1
"""Of the largest load, beyond which its sign is no noise; and of the rows, for each sign."""


def check_recording(recording: pd.DataFrame) -> list[Issue]:
    """Find the faults that would make an explanation wrong.

    Parameters
    ----------
    recording : DataFrame
        Canonical columns, as from :func:`read_recording`.

    Returns
    -------
    list of Issue
        Empty if no fault is found. Errors come first.

    See Also
    --------
    Issue : One finding.
    read_recording : Where recordings come from.

    Notes
    -----
    What is looked for: docs/reference/recordings.md.

    Examples
    --------
    >>> found = check_recording(pd.DataFrame({"normal_load": [4000.0, 4010.0]}))
    >>> found[0].name, found[0].severity
    ('no_force_channel', 'error')
    """
    repeated = repeated_channels(recording)
    if repeated:
        return [Issue("repeated_channel", "error", ", ".join(repeated), "keep one of each")]
    issues = _columns(recording) + _time(recording) + _values(recording)
    issues += unread_cells(recording.attrs.get("notes", ()), recording.attrs.get("channels", {}).values())
    return sorted(issues, key=lambda issue: issue.severity != "error")


def repeated_channels(recording: pd.DataFrame) -> list[str]:
    """Return the channels that have more than one column."""
    names = [str(n) for n in recording.columns]
    known = [n for n in names if n in RECORDED_CHANNELS or n.startswith("simulated_")]
    return [n for n in dict.fromkeys(known) if known.count(n) > 1]


def in_seconds(column: pd.Series) -> pd.Series:
    """Return dates as seconds from the first one; numbers stay as they are."""
    if pd.api.types.is_datetime64_any_dtype(column):
        return (column - column.min()).dt.total_seconds()
    return column


def _columns(frame: pd.DataFrame) -> list[Issue]:
    issues = []
    columns = pd.DataFrame(frame, copy=False).items()  # without attrs: pandas copies them
    held = {name for name, values in columns if values.notna().any() or frame.empty}
    if not any(c in held for c in TANGENTIAL_FORCES):
        issues.append(
            Issue(
                "no_force_channel",
                "error",
                f"columns {', '.join(map(str, frame.columns[:12]))}",
                reader_of_drive({*map(str, frame.columns), *frame.attrs.get("channels", {}).values()})
                or "nothing to compare with: say which column is the force: --name 'its name=fy', in Python "
                "names={'its name': 'fy'}",
            )
        )
    if "normal_load" not in held:
        issues.append(
            Issue(
                "no_normal_load",
                "error",
                "columns",
                frame.attrs.get("layout") or "the model needs the load: add a column normal_load in N",
            )
        )
    if "slip_angle" not in held and "slip_ratio" not in held:
        issues.append(Issue("no_slip_channel", "error", "columns", "add slip_angle (rad) or slip_ratio"))
    least = LEAST_SAMPLES if "time" in held else LEAST_POINTS
    if len(frame) < least:
        issues.append(
            Issue(
                "few_samples",
                "error",
                f"{len(frame)} rows",
                f"at least {least} are needed to tell physics from noise",
            )
        )
    elif held:
        numbers = [n for n in frame.columns if n in held and pd.api.types.is_numeric_dtype(frame[n])]
        issues += few_whole_rows({n: frame[n].to_numpy(dtype=float) for n in numbers}, "time" in held)
    return issues


def _time(frame: pd.DataFrame) -> list[Issue]:
    if "time" not in frame or len(frame) < 2:
        return []
    time = in_seconds(frame["time"]).to_numpy(dtype=float)
    known = np.flatnonzero(np.isfinite(time))
    step = np.full(time.size - 1, np.nan)
    step[known[1:] - 1] = np.diff(time[known])
    return [
        *_broken_time(~np.isfinite(time)),
        *_backwards(np.concatenate([[False], step < 0])),
        *_repeated(np.concatenate([[False], step == 0])),
        *_gaps(step),
        *unit_of_time(frame, step),
    ]


def _broken_time(bad: np.ndarray) -> list[Issue]:
    if not bad.any():
        return []
    where = f"time, {bad.sum()} rows from row {int(bad.argmax())}"
    return [Issue("time_not_finite", "warning", where, "these rows are not used", _runs(bad))]


def _backwards(bad: np.ndarray) -> list[Issue]:
    if not bad.any():
        return []
    where = f"time, {bad.sum()} places, first at row {int(bad.argmax())}"
    todo = "split the file there, or sort by time if the rows were shuffled"
    return [Issue("time_runs_backwards", "error", where, todo, _runs(bad))]


def _repeated(bad: np.ndarray) -> list[Issue]:
    if not bad.any():
        return []
    where = f"time, {bad.sum()} rows, first at row {int(bad.argmax())}"
    todo = "the clock is coarser than the samples: use a finer one, or average the rows"
    return [Issue("repeated_time_stamps", "error", where, todo, _runs(bad))]


def _gaps(step: np.ndarray) -> list[Issue]:
    ahead = step[step > 0]
    usual = float(np.median(ahead)) if ahead.size else np.inf
    bad = np.concatenate([[False], step > LONG_GAP * usual])
    if not bad.any():
        return []
    longest = in_digits(float(np.nanmax(step)))
    where = (
        f"time, {how_many(int(bad.sum()), 'gap')} of up to {longest} s, first at row {int(bad.argmax())}; "
        f"the usual step is {in_digits(usual)} s"
    )
    todo = "states such as temperature are unknown after a gap"
    return [Issue("gaps_in_time", "warning", where, todo, _runs(bad))]


def _values(frame: pd.DataFrame) -> list[Issue]:
    issues = []
    for column, series in pd.DataFrame(frame, copy=False).items():  # without attrs: pandas copies them
        if not pd.api.types.is_numeric_dtype(series):
            continue
        values = series.to_numpy(dtype=float)
        bad = ~np.isfinite(values)
        if bad.all() and len(values):
            issues.append(Issue("empty_channel", "warning", str(column), "no number in it: leave it out"))
            continue
        blocks = tuple(r for r in _runs(bad, most=None) if r[1] - r[0] + 1 >= _NAN_BLOCK)
        if blocks and column != "time":
            rows = sum(b - a + 1 for a, b in blocks)
            issues.append(
                Issue(
                    "missing_block",
                    "warning",
                    f"{column}, {rows} rows in {len(blocks)} blocks, first rows "
                    f"{blocks[0][0]} to {blocks[0][1]}",
                    "these rows are not used",
                    blocks[:20],
                )
            )
        issues += _spikes(str(column), values) if column in USED and column != "time" else []
        issues += _unit(frame, str(column), np.where(bad, np.nan, values))
    issues += _slip_not_measured(frame) + _unit_changes(frame) + _force_and_load(frame)
    issues += slip_ratio_defined_otherwise(frame) + slip_too_small(frame) + moment_beyond_reach(frame)
    return [
        *issues,
        *grip_of_no_tire(frame),
        *moment_of_other_sign(frame),
        *side_force_with_the_slip(frame),
        *side_force_away_from_the_lean(frame),
    ]


def _slip_not_measured(frame: pd.DataFrame) -> list[Issue]:
    """Report a slip ratio that says throughout that the wheel is locked."""
    if "slip_ratio" not in frame or not pd.api.types.is_numeric_dtype(frame["slip_ratio"]):
        return []
    locked = locked_parts(frame, frame["slip_ratio"].to_numpy(dtype=float))
    told = [said.partition(": ") for _, said in locked]
    return [Issue("slip_not_measured", "warning", where, taken) for where, _, taken in told]


def _unit_changes(frame: pd.DataFrame) -> list[Issue]:
    """Report channels whose unit changes within the recording."""
    return [
        Issue(
            "unit_changes",
            "warning",
            str(jump),
            f"is that so? It jumps by {in_digits(jump.ratio)} there while load and slip are the same: bring "
            "both parts to one unit, or split the file there",
            ((jump.row, jump.row),),
        )
        for jump in unit_jumps(frame)
    ]


def _spikes(column: str, values: np.ndarray) -> list[Issue]:
    found = spikes(values, column)
    if not found.any():
        return []
    return [Issue("spikes", "warning", said_of_spikes(column, values, found), "left out", _runs(found))]


def _unit(frame: pd.DataFrame, column: str, values: np.ndarray) -> list[Issue]:
    """Report values that no tire has, and the units that would make them plausible."""
    large = size(values)
    if plausible(column, large):
        return []
    unit = _UNIT_OF_CHANNEL[column]
    up_to = "up to " if large > PLAUSIBLE_VALUES[column].high else ""
    where = f"{column}, {up_to}{in_digits(large)} {unit}".removesuffix(" -")
    read_as = PLAUSIBLE_VALUES[column].read_as
    if not read_as:
        return [
            Issue(
                "implausible_value",
                "warning",
                where,
                f"no tire has this; {likely_unit_stated(frame, column, likely_units(frame, column, large))}",
            )
        ]
    return [
        Issue(
            "angle_in_degrees" if read_as == "deg" else "slip_in_percent",
            "warning",
            where,
            f"no wheel reaches this; explain_mismatch reads it as {read_as}. State the unit: "
            f"{unit_stated(frame, column, read_as)}",
        )
    ]


def _friction(frame: pd.DataFrame, forces: dict[str, np.ndarray], load: np.ndarray) -> list[Issue]:
    """Report a force that is too large for its load: the load is probably in another unit."""
    large = size(load)
    sizes = {name: size(force) for name, force in forces.items()}
    name = max(sizes, key=lambda n: sizes[n], default="")
    usual = not name or not large > 0.0 or sizes[name] <= FORCE_OVER_LOAD[1] * large
    if usual or not plausible("normal_load", large):
        return _small_load(frame, large, name, sizes.get(name, 0.0))
    where = f"{name}, up to {in_digits(sizes[name])} N at a normal_load of up to {in_digits(large)} N"
    units = likely_load_units(frame, large, sizes[name])
    todo = f"no tire makes this force; of the load, {likely_unit_stated(frame, 'normal_load', units)}"
    return [Issue("implausible_friction", "warning", where, todo)]


def _small_load(frame: pd.DataFrame, large: float, force: str, largest: float) -> list[Issue]:
    """Report a load that only a model car has, where something says that this is another tire."""
    found = in_another_unit_as(frame, large)
    only_unstated = len(found) == 1 and not frame.attrs.get("file_units", {}).get("normal_load", "N")
    turns = "turn_slip" in frame and size(_numbers(frame, "turn_slip")) > _SHARPEST_TURN_OF_CARS
    if not found or (only_unstated and turns):
        return []
    where = f"normal_load, up to {in_digits(large)} N: a model car's, but {', and '.join(found)}"
    units = units_of_larger_loads(frame, large)
    if units and FORCE_OVER_LOAD[0] <= largest / large <= FORCE_OVER_LOAD[1]:
        newtons = f"both are in N, which is to be stated then: {unit_stated(frame, 'normal_load', 'N')}; or "
        stated = [unit_stated(frame, n, units[0]).partition(", in Python")[0] for n in ("normal_load", force)]
        todo = (
            f"{force} fits the load as it was read: {newtons if only_unstated else ''}both are in "
            f"{' or '.join(units)}: {' '.join(stated)}"
        )
    else:
        ask = likely_unit_stated(frame, "normal_load", units)
        todo = f"look at the units of load and forces; of the load, {ask}"
    return [Issue("small_load", "warning", where, todo)]


def _force_and_load(frame: pd.DataFrame) -> list[Issue]:
    issues = []
    forces = {n: _numbers(frame, n) for n in TANGENTIAL_FORCES if n in frame}
    forces = {n: f for n, f in forces.items() if f.size}
    still = [n for n, f in forces.items() if f.size > 1 and np.ptp(f) == 0.0]
    if still:
        issues.append(
            Issue(
                "constant_force",
                "error" if len(still) == len(forces) else "warning",
                ", ".join(f"{n} is {in_digits(forces[n][0], 4)} N throughout" for n in still),
                "no force was measured: check that the sensor was on",
            )
        )
    load = _numbers(frame, "normal_load") if "normal_load" in frame else np.empty(0)
    issues += _friction(frame, forces, load)
    issues += _sign_of_load(load)
    against = frame.attrs.get("axes_unclear", "")
    if against:
        issues.append(
            Issue(
                "axes_unclear",
                "warning",
                str(against),
                'read the file with axes="SAE" or axes="ISO" (--axes), whichever holds: unless the forces '
                "tell, an explanation leaves it open and writes no corrected file",
            )
        )
    return issues


def _sign_of_load(load: np.ndarray) -> list[Issue]:
    if load.size == 0:
        return []
    if of_both_signs(load):
        where = f"normal_load, {int(np.sum(load < 0.0))} of {load.size} rows below zero"
        todo = "no wheel pulls at the ground: bring all rows to one sign, compression positive"
        return [Issue("load_of_both_signs", "warning", where, todo)]
    if float(np.median(load)) < 0.0:
        todo = "compression is positive here: an explanation turns the sign; say in which axes the file is"
        return [Issue("negative_load", "warning", "normal_load, median below zero", todo)]
    if not (load > 0).any():
        todo = "no wheel stood on the ground: record the load"
        return [Issue("no_positive_load", "error", "normal_load", todo)]
    return []


def of_both_signs(load: np.ndarray) -> bool:
    """Whether large loads of both signs are there in a tenth of the rows or more, shape (n,)."""
    beyond = np.abs(load) > _BOTH_SIGNS * np.max(np.abs(load), initial=0.0)
    return bool(min(np.mean(beyond & (load < 0.0)), np.mean(beyond & (load > 0.0))) >= _BOTH_SIGNS)


def _numbers(frame: pd.DataFrame, column: str) -> np.ndarray:
    """Return the finite values of a column; an empty array for a column of text."""
    values = pd.to_numeric(frame[column], errors="coerce").to_numpy(dtype=float)
    return values[np.isfinite(values)]


def _runs(mask: np.ndarray, most: int | None = 20) -> tuple[tuple[int, int], ...]:
    """First and last index of each run of True."""
    return tuple((first, after - 1) for first, after in stretches(mask)[:most].tolist())
