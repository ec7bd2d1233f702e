"""What is wrong with a recording, before anything is explained from it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import pandas as pd

from tire_pipeline.channels import ANGLE_CHANNELS, FORCE_CHANNELS, RECORDED_CHANNELS

LEAST_SAMPLES = 30
LEAST_POINTS = 12
"""Of a recording in time and of steady points: with less nothing is told from noise."""
_LARGEST_ANGLE = 1.6  # rad: what no tire is turned to; the same limit as the Magic Formula's
_GAP_FACTOR = 5.0
_NAN_BLOCK = 10


@dataclass(frozen=True)
class Issue:
    """One finding.

    Parameters
    ----------
    name : str
        Such as `no_force_channel`.
    severity : {"error", "warning"}
        With an error the recording cannot be explained.
    where : str
        Channel and position, in words.
    advice : str
        What can be done.
    rows : tuple of (int, int)
        First and last row of each place, at most 20 of them.

    See Also
    --------
    check_recording : What finds it.

    Notes
    -----
    Rows are counted from zero.

    Examples
    --------
    >>> Issue("no_force_channel", "error", "the recording", "give fx, fy or mz").severity
    'error'
    """

    name: str
    severity: Literal["error", "warning"]
    where: str
    advice: str
    rows: tuple[tuple[int, int], ...] = ()

    def __str__(self) -> str:
        return f"{self.severity}: {self.name} ({self.where}) -> {self.advice}"


def check_recording(recording: pd.DataFrame) -> list[Issue]:
    """Look for what would spoil an explanation.

    Parameters
    ----------
    recording : DataFrame
        Canonical columns, as from :func:`read_recording`.

    Returns
    -------
    list of Issue
        Empty if there is nothing. Errors come first.

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
    return sorted(issues, key=lambda issue: issue.severity != "error")


def repeated_channels(recording: pd.DataFrame) -> list[str]:
    """Return the channels of which there are several columns."""
    names = [str(n) for n in recording.columns]
    known = [n for n in names if n in RECORDED_CHANNELS or n.startswith("simulated_")]
    return [n for n in dict.fromkeys(known) if known.count(n) > 1]


def _columns(frame: pd.DataFrame) -> list[Issue]:
    issues = []
    columns = pd.DataFrame(frame, copy=False).items()  # without attrs: pandas copies them
    held = {name for name, values in columns if values.notna().any() or frame.empty}
    if not any(c in held for c in FORCE_CHANNELS):
        issues.append(
            Issue(
                "no_force_channel",
                "error",
                f"columns {', '.join(map(str, frame.columns[:12]))}",
                "nothing to compare with: name the force, e.g. names={'their name': 'fy'}",
            )
        )
    if "normal_load" not in held:
        issues.append(
            Issue(
                "no_normal_load",
                "error",
                "columns",
                "the model needs the load: add a column normal_load in N",
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
    return issues


def _time(frame: pd.DataFrame) -> list[Issue]:
    if "time" not in frame or len(frame) < 2:
        return []
    time = frame["time"].to_numpy(dtype=float)
    issues = []
    broken = ~np.isfinite(time)
    if broken.any():
        issues.append(
            Issue(
                "time_not_finite",
                "warning",
                f"time, {broken.sum()} rows from row {int(broken.argmax())}",
                "these rows are not used",
                _runs(broken),
            )
        )
    with np.errstate(invalid="ignore"):
        step = np.diff(time)
    back = np.concatenate([[False], step < 0])
    if back.any():
        issues.append(
            Issue(
                "time_runs_backwards",
                "error",
                f"time, {back.sum()} places, first at row {int(back.argmax())}",
                "split the file there, or sort by time if the rows were shuffled",
                _runs(back),
            )
        )
    again = np.concatenate([[False], step == 0])
    if again.any():
        issues.append(
            Issue(
                "repeated_time_stamps",
                "error",
                f"time, {again.sum()} rows, first at row {int(again.argmax())}",
                "the clock is coarser than the samples: give a finer one, or average the rows",
                _runs(again),
            )
        )
    ahead = step[step > 0]
    if ahead.size:
        usual = float(np.median(ahead))
        gap = np.concatenate([[False], step > _GAP_FACTOR * usual])
        if gap.any():
            longest = float(np.nanmax(step))
            issues.append(
                Issue(
                    "gaps_in_time",
                    "warning",
                    f"time, {gap.sum()} gaps of up to {longest:.3g} s, first at row "
                    f"{int(gap.argmax())}; the usual step is {usual:.3g} s",
                    "states such as temperature are unknown after a gap",
                    _runs(gap),
                )
            )
    return issues


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
        if column in ANGLE_CHANNELS and np.nanmax(np.abs(np.where(bad, np.nan, values))) > _LARGEST_ANGLE:
            issues.append(
                Issue(
                    "angle_in_degrees",
                    "error",
                    f"{column}, up to {np.nanmax(np.abs(np.where(bad, np.nan, values))):.3g} rad",
                    "this looks like degrees: read it with units={'its name': 'deg'}",
                )
            )
    if "normal_load" in frame:
        load = frame["normal_load"].to_numpy(dtype=float)
        if np.isfinite(load).any() and not (load > 0).any():
            issues.append(
                Issue(
                    "no_positive_load",
                    "error",
                    "normal_load",
                    "compression is positive here: mirror it",
                )
            )
    return issues


def _runs(mask: np.ndarray, most: int | None = 20) -> tuple[tuple[int, int], ...]:
    """First and last index of each run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], mask.astype(np.int8), [0]])))
    pairs = list(zip(edges[::2].tolist(), (edges[1::2] - 1).tolist(), strict=True))
    return tuple(pairs[:most])
