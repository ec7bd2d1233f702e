"""``tire check``: what a recording holds, and what is wrong with it."""

from __future__ import annotations

from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from tire_pipeline.command.options import FILE, output_options, read_runs, reading_options
from tire_pipeline.command.outcome import NO_UNIT, CommandOutcome, Grid, digits, finish
from tire_pipeline.pages.numbers_in_words import how_many, in_digits

if TYPE_CHECKING:
    import pandas as pd

    from tire_pipeline.recordings import Issue

UNUSABLE = 1
"""Exit code if the recording cannot be explained."""
_MOST_DRAWN = 4000
_LABEL_WIDTH = 16
"""Letters beside the axis of a panel; a longer label goes on in the next line."""
_KEYS = ("channel", "unit", "lowest", "median", "highest", "missing")
"""What JSON says of each channel; the first is its name in the file."""


@click.command(
    help="Check the recording RUN: channels with their units, what was assumed on reading, what is wrong. "
    "The exit code is 1 if it cannot be explained."
)
@click.argument("run", type=FILE)
@reading_options
@output_options("-o")
def command(
    run: Path,
    axes: tuple[str, ...],
    units: tuple[str, ...],
    names: tuple[str, ...],
    format_: str | None,
    **output: Any,
) -> None:
    """Check a recording."""
    from tire_pipeline.recordings import check_recording

    runs = read_runs([run], axes=axes, units=units, names=names, format_=format_)
    recording = runs[run.name]
    issues = check_recording(recording)
    finish(outcome(run, recording, issues), f"{run.stem}_check", **output)
    if any(issue.severity == "error" for issue in issues):
        click.get_current_context().exit(UNUSABLE)


def outcome(run: Path, recording: pd.DataFrame, issues: list[Issue]) -> CommandOutcome:
    """What is said of a recording.

    Parameters
    ----------
    run : Path
        Its file.
    recording : DataFrame
    issues : list of Issue
        What is wrong with it.
    """
    attrs = recording.attrs
    errors = sum(issue.severity == "error" for issue in issues)
    verdict = "It cannot be explained as it is" if errors else "It can be explained"
    counts = [_count(errors, "error"), _count(len(issues) - errors, "warning")]
    lines = [f"{verdict}: {' and '.join(counts)}.", _size(recording), _axes(recording)]
    rows = _channels(recording)
    channels = Grid(
        ("channel", "in the file", "unit", "lowest", "median", "highest", "missing"),
        [(*row[:2], _unit(row[2]), *_alike(row[3:6]), row[6]) for row in rows],
        f"Channels, in SI units ({NO_UNIT}: none)",
    )
    found = Grid(
        ("severity", "what", "where", "what to do"),
        [(i.severity, i.name.replace("_", " "), i.where, i.advice) for i in issues],
        "What is wrong",
    )
    told = {issue.where for issue in issues}
    notes = [*attrs.get("conversions", []), *(note for note in attrs.get("notes", []) if note not in told)]
    data = {
        "file": run,
        "format": attrs.get("format"),
        "rows": len(recording),
        "usable": not errors,
        "issues": [
            {"name": i.name, "severity": i.severity, "where": i.where, "advice": i.advice, "rows": i.rows}
            for i in issues
        ],
        "channels": {row[0]: dict(zip(_KEYS, row[1:], strict=True)) for row in rows},
        "conversions": attrs.get("conversions", []),
        "notes": attrs.get("notes", []),
    }

    def page() -> str:
        return _page(run, recording, lines, channels, found, notes)

    shown = [_first(channels), *([found] if issues else [])]
    return CommandOutcome(run.name, lines, data, page, shown, notes)


def _first(channels: Grid) -> Grid:
    """The channels that are known and the first others: a log of a vehicle has hundreds of columns."""
    from tire_pipeline.recordings.conventions.canonical import STRANGE_NAMED
    from tire_pipeline.recordings.conventions.channel_names import find_channel

    strange = [row[0] for row in channels.rows if find_channel(row[0]) is None]
    more = set(strange[STRANGE_NAMED:])
    if not more:
        return channels
    title = f"{channels.title}; --json has {len(more):,} more columns of no known name"
    return Grid(channels.header, [row for row in channels.rows if row[0] not in more], title)


def _count(number: int, what: str) -> str:
    return how_many(number, what) if number else f"no {what}s"


def _size(recording: pd.DataFrame) -> str:
    kind = recording.attrs.get("format", "")
    if "time" not in recording:
        return f"{kind}, {how_many(len(recording), 'steady point')} (no time)."
    time = recording["time"].to_numpy(dtype=float)
    time = time[np.isfinite(time)]
    if time.size < 2:
        return f"{kind}, {how_many(len(recording), 'sample')}."
    step = float(np.median(np.diff(time)))
    rate = f" at {in_digits(1.0 / step, 4)} Hz" if step > 0.0 else ""
    return f"{kind}, {how_many(len(recording), 'sample')} over {digits(float(np.ptp(time)))} s{rate}."


def _axes(recording: pd.DataFrame) -> str:
    """Say which sign the side force has: what the reader of a file has to compare with the rig's manual."""
    read = f"Read with {recording.attrs['assumed'][0]}"
    if not {"slip_angle", "fy"} <= set(recording):
        return f"{read}."
    pair = recording[["slip_angle", "fy"]].to_numpy(dtype=float)
    pair = pair[np.isfinite(pair).all(axis=1)]
    if len(pair) < 3 or np.any(np.ptp(pair, axis=0) == 0.0):
        return f"{read}."
    together = float(np.corrcoef(pair.T)[0, 1])
    if abs(together) < 0.5:
        return f"{read}; the side force does not follow the slip angle."
    sign = (
        "negative, as in ISO W"
        if together < 0.0
        else "positive, unlike in ISO W. Compare with the rig's manual: an explanation tries all axes, and "
        "leaves open which hold"
    )
    return f"{read}: at a positive slip angle the side force is {sign}."


def _unit(name: str) -> str:
    """One sign for ratios, however the file writes them, and for channels of which no unit is known."""
    from tire_pipeline.recordings.conventions.units import find_unit

    known = find_unit(name)
    bare = known is not None and known.dimension == "ratio" and known.factor == 1.0
    return NO_UNIT if not name or bare else name


def _channels(recording: pd.DataFrame) -> list[tuple[Any, ...]]:
    names, units = (recording.attrs.get(each, {}) for each in ("channels", "units"))
    numbers = recording.select_dtypes("number")
    rows = []
    # all columns at once: pandas copies all attrs for each column that is taken by its name
    for column, values in zip(map(str, numbers.columns), numbers.to_numpy(dtype=float).T, strict=True):
        finite = values[np.isfinite(values)]
        low, middle, high = np.quantile(finite, [0.0, 0.5, 1.0]) if finite.size else [np.nan] * 3
        missing = int(values.size - finite.size)
        span = (float(low) + 0.0, float(middle) + 0.0, float(high) + 0.0)
        rows.append((column, names.get(column, ""), units.get(column, ""), *span, missing))
    return rows


def _alike(span: tuple[float, ...]) -> list[float]:
    """Round to the digits that matter beside the largest: a median of 1e-9 among angles of 0.2 is 0."""
    most = max(map(abs, span))
    if not np.isfinite(most) or most == 0.0:
        return list(span)
    places = 3 - int(np.floor(np.log10(most)))
    return [round(value, places) + 0.0 for value in span]


def _page(
    run: Path,
    recording: pd.DataFrame,
    lines: list[str],
    channels: Grid,
    issues: Grid,
    notes: list[str],
) -> str:
    import pandas as pd

    from tire_pipeline.reporting import Figure, Table, Text, render_page

    parts: list[Any] = [Text(lines, emphasis=True)]
    if issues.rows:
        parts.append(Table(pd.DataFrame(issues.rows, columns=list(issues.header)), heading="What is wrong"))
    parts.append(Figure(*_figure(recording), heading="Channels"))
    table = pd.DataFrame(channels.rows, columns=list(channels.header))
    parts.append(Table(table, channels.title, digits=4, unlike=True))
    if notes:
        parts.append(Text(notes, heading="What was done and assumed on reading"))
    return render_page(run.name, parts, footer=f"tire check {run.name}")


def _figure(recording: pd.DataFrame) -> tuple[Any, str]:
    from tire_pipeline.channels import shown_unit
    from tire_pipeline.pages.drawing import colour_of, new_figure
    from tire_pipeline.recordings.conventions.channel_names import CANONICAL

    drawn = [c.name for c in CANONICAL if c.name != "time" and c.name in recording]
    step = max(1, len(recording) // _MOST_DRAWN)
    timed = "time" in recording
    x = recording["time"].to_numpy(dtype=float)[::step] if timed else np.arange(len(recording))[::step]
    steps = np.diff(x, prepend=x[:1])
    gaps = np.flatnonzero(steps > 5.0 * np.median(steps))
    figure, axes = new_figure(
        len(drawn), 1, width=9.0, height=1.15 * len(drawn) + 0.6, squeeze=False, sharex=True
    )
    for panel, name in zip(axes.ravel(), drawn, strict=True):
        values = recording[name].to_numpy(dtype=float)[::step].copy()
        values[gaps] = np.nan  # no line over a gap
        factor, unit, label = shown_unit(name, float(np.nanmax(np.abs(values), initial=0.0)))
        look: Any = {"lw": 0.6} if timed else {"ls": "", "marker": "."}
        panel.plot(x, factor * values, color=colour_of(0), **look)
        panel.set_ylabel(fill(f"{label} ({unit or NO_UNIT})", _LABEL_WIDTH), fontsize=8)
    axes.ravel()[-1].set_xlabel("time (s)" if timed else "point")
    thinned = f" One sample in {step} is drawn." if step > 1 else ""
    said = "The channels that are known, in ISO W axes. Compare signs and sizes with what the rig did."
    return figure, said + thinned
