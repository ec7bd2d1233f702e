"""From a DataFrame to clean arrays: missing, broken or wrongly recorded data are reported, not explained."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.channels import FORCE_CHANNELS, INPUT_CHANNELS, TANGENTIAL_FORCES
from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula.parameters.assumed_radius import assumed_radius
from tire_pipeline.mismatch.effects.base import Finding
from tire_pipeline.mismatch.effects.shared import lengths_in_words, own_relaxation
from tire_pipeline.mismatch.model.channels import RecordedChannels, largest
from tire_pipeline.mismatch.model.data import NO_CHOICES, Choices, Data
from tire_pipeline.mismatch.model.residual import residual
from tire_pipeline.mismatch.recording.cleaning import Cleaning, clean
from tire_pipeline.mismatch.recording.exact import open_axes, repair
from tire_pipeline.mismatch.recording.given import SPIKES, check_tire, usable_numbers, without_values
from tire_pipeline.mismatch.recording.identity import another_tire
from tire_pipeline.mismatch.recording.lone_points import lone_points
from tire_pipeline.mismatch.recording.open_questions import Question
from tire_pipeline.mismatch.recording.surrogate import stand_in
from tire_pipeline.mismatch.recording.time_line import averaged, beginnings, long_gaps, rising_time, seams
from tire_pipeline.mismatch.recording.usable import (
    in_another_unit,
    in_two_units,
    judge,
    leave_out_no_pressure,
    leave_out_still_slip,
    standing,
)
from tire_pipeline.pages.numbers_in_words import how_many
from tire_pipeline.recordings.conventions.channel_names import FURTHER
from tire_pipeline.recordings.issue import issue_in_words
from tire_pipeline.recordings.slip_definition import slip_ratio_defined_otherwise
from tire_pipeline.recordings.time_unit import LONG_STEP
from tire_pipeline.recordings.whole_rows import (
    LEAST_POINTS,
    LEAST_SAMPLES,
    LEAST_WHOLE,
    LONGEST_HOLE,
    apart,
    short_holes,
)

Array = np.ndarray
ASSUMED_ZERO = ("camber", "slip_ratio", "slip_angle")
"""What is taken as zero where it is not recorded."""
_LOADS_OF_MODEL = (0.02, 8.0)
"""Over the nominal load: at others the file is of another tire, or the load has another unit."""
AS_GIVEN = "columns in ISO W axes and SI units, as they were given"


@dataclass(frozen=True)
class Prepared:
    """The recording, cleaned.

    Parameters
    ----------
    recording : pandas.DataFrame
        As numbers, without the values that are left out.
    data : Data
        All usable samples, at 50 to 100 Hz.
    findings : list of Finding
        Artefacts that needed no fit, already repaired or taken out.
    notes : list of str
        What the user should know.
    rows : ndarray of int
        For each sample of ``data`` the row of the recording where it begins.
    factors : dict of str to float
        Channel -> what repaired its sign and unit: true = factor times recorded.
    cleaned : list of Cleaning
        What was done to each input channel that fluctuates.
    assumed : list of str
        What was not stated: axes, units, repairs, channels taken as zero.
    questions : list of Question
        Questions to settle before anything is explained, or before anything corrected is written, in this
        order. One that is not likely is asked only if sets of effects do not answer it.
    left_out : mapping of ndarray of int
        Force -> rows of the recording in which the wheel stands, or whose value is unlike all around it.
    """

    recording: pd.DataFrame
    data: Data
    findings: list[Finding]
    notes: list[str]
    rows: Array
    factors: dict[str, float]
    cleaned: list[Cleaning] = field(default_factory=list)
    assumed: list[str] = field(default_factory=list)
    questions: list[Question] = field(default_factory=list)
    left_out: Mapping[str, Array] = field(default_factory=dict)

    @property
    def question(self) -> Question | None:
        """The question to settle first."""
        return next((q for q in self.questions if q.likely), None)

    @property
    def suspected(self) -> Question | None:
        """The question that is not likely."""
        return next((q for q in self.questions if not q.likely), None)

    @property
    def stopped(self) -> str:
        """The verdict if nothing may be explained from it, else ""."""
        return "" if self.question is None else self.question.verdict


def _on_time(time: Array | None) -> list[str]:
    """Remarks on the time from sample to sample."""
    if time is None:
        return [
            "time is not recorded: rows that follow each other are taken for a run, others for steady "
            "points; a channel that stuck would not show"
        ]
    step = float(np.nanmedian(np.diff(time)))
    if step > LONG_STEP:
        return [f"there are {step:.3g} s from sample to sample; if that is wrong, the unit of time is"]
    return []


def _check_what_is_left(left: int, out: int) -> None:
    if left < LEAST_POINTS and out:
        raise RecordingError(
            f"after taking out {out} samples with a stuck or clipped channel, or in which the wheel stands, "
            f"only {left} are left",
            todo="record again",
        )


def _part(
    kept: Array, arrays: Mapping[str, Array], time: Array | None
) -> tuple[dict[str, Array], Array | None]:
    """Return some samples, by number or by bool, shape (n,)."""
    return {n: a[kept] for n, a in arrays.items()}, None if time is None else time[kept]


def _zeros(arrays: dict[str, Array], count: int) -> list[str]:
    """Put zeros in place of inputs that were not recorded, and say so."""
    missing = [name for name in ASSUMED_ZERO if name not in arrays]
    arrays |= {name: np.zeros(count) for name in missing}
    return [f"{name} is not recorded and taken as zero" for name in missing]


def _cleaned(tire: Any, arrays: dict[str, Array], start: Array) -> tuple[dict[str, Array], list[Cleaning]]:
    """Clean the inputs by the forces, less what another simulator has beyond the tire model."""
    forces = {n: arrays[n] - arrays.get(f"_beside_{n}", 0.0) for n in TANGENTIAL_FORCES if n in arrays}
    return clean(tire, arrays, forces, start)


def prepare(tire: Any, recording: pd.DataFrame, choices: Choices = NO_CHOICES) -> Prepared:
    """Check a recording, repair what is exactly wrong, and bring it to arrays.

    Parameters
    ----------
    tire : TireModel or None
        None if the recording has ``simulated_fy`` or ``simulated_fx``.
    recording : pandas.DataFrame
        Canonical columns, SI.
    choices : Choices
        What the user states in place of what the effects do.

    Raises
    ------
    RecordingError
        If something is missing that nothing can replace.
    """
    notes: list[str] = []
    check_tire(tire)
    recording = usable_numbers(recording)
    arrays = _arrays(recording)
    time = rising_time(arrays)
    _check_together(arrays)
    if time is not None:
        _bridge(arrays, notes)
    notes += [*_on_time(time), *map(issue_in_words, slip_ratio_defined_otherwise(recording))]
    rows = _usable(arrays, time, notes)
    arrays, time = _part(rows, arrays, time)
    still = standing(arrays, notes)
    at_rest, rows = rows[still], rows[~still]
    arrays, time = _part(~still, arrays, time)
    beside = None
    if tire is None:
        tire, beside = stand_in(arrays)
        arrays |= {f"_beside_{n}": b for n, b in beside.items()}
    leave_out_still_slip(tire, arrays, time, notes)
    findings, bad, factors = (
        repair(tire, arrays, time) if beside is None else ([], np.zeros(rows.size, bool), {})
    )
    leave_out_no_pressure(recording, arrays, notes)
    rows = rows[~bad]
    arrays, time = _part(~bad, arrays, time)
    lone, alone = lone_points(tire, arrays, rows) if time is None and beside is None else ({}, [])
    out = {n: np.r_[at_rest, rows[lone.get(n, [])]] for n in TANGENTIAL_FORCES if n in arrays}
    kept = np.setdiff1d(np.arange(rows.size), np.concatenate([[], *lone.values()]))
    rows = rows[kept]
    arrays, time = _part(kept, arrays, time)
    _check_what_is_left(rows.size, at_rest.size + int(bad.sum()))
    _overlap(tire, arrays)
    _dead_forces(arrays, notes)
    unusable, driven = judge(tire, arrays, time, notes)
    asked = [in_two_units(recording), in_another_unit(tire, arrays) if beside is None else None, unusable]
    if not any(asked) and beside is None:
        against = str(recording.attrs.get("axes_unclear", ""))
        axes = open_axes(tire, arrays, time, findings, against, recording.attrs.get("assumed", ()))
        asked = [another_tire(tire, arrays, driven), axes]
    present = {n for n in INPUT_CHANNELS if n in recording.columns and n in arrays}
    assumed = [*_assumed(recording, factors), *alone, *_zeros(arrays, rows.size), *assumed_radius(tire)]
    start = beginnings(time, rows.size, rows)
    notes += long_gaps(time, start, seams(recording.attrs.get("joined", ()), rows))
    arrays, time, start, rows = averaged(arrays, time, start, rows)
    arrays, cleaned = (arrays, []) if time is None else _cleaned(tire, arrays, start)
    notes += [c.text() for c in cleaned]
    own = own_relaxation(tire)
    if own and time is not None and "speed" not in present:
        notes.append("speed is not recorded, so the relaxation lengths that the file states are left out")
    beside = None if beside is None else {n: arrays.pop(f"_beside_{n}") for n in beside}
    recorded = RecordedChannels(
        channels={n: a for n, a in arrays.items() if n not in TANGENTIAL_FORCES},
        recorded={n: arrays[n] for n in TANGENTIAL_FORCES if n in arrays and (beside is None or n in beside)},
        time=time,
        start=start,
        present=present,
    )
    with_relaxation = partial(Data.of, tire, recorded, beside=beside, choices=choices)
    data = with_relaxation(own_relaxation=None)
    if own:
        data = _better_followed(with_relaxation(own_relaxation=own), data, notes)
    left_out = {n: gone for n, gone in out.items() if gone.size}
    recording, questions = without_values(recording, left_out), [q for q in asked if q]
    return Prepared(recording, data, findings, notes, rows, factors, cleaned, assumed, questions, left_out)


def whole_rows(recording: pd.DataFrame) -> tuple[dict[str, Array], Array | None]:
    """Return the channels of a recording, and its time, at the rows with a number in each that matters."""
    arrays = _arrays(usable_numbers(recording))
    time = rising_time(arrays)
    return _part(_usable(arrays, time, []), arrays, time)


def _assumed(recording: pd.DataFrame, factors: Mapping[str, float]) -> list[str]:
    """What is taken for given: by the reader, and by the repair of exact factors."""
    assumed = list(recording.attrs.get("assumed", [AS_GIVEN]))
    converted = [t for t in recording.attrs.get("conversions", []) if not _of_unused(t)]
    assumed += [t.replace(" from ", " converted from ", 1) for t in converted]
    assumed += recording.attrs.get(SPIKES, [])
    assumed += [f"{n} is taken as {f:.6g} times what was recorded" for n, f in factors.items() if f != 1.0]
    return assumed


def _of_unused(conversion: str) -> bool:
    """Whether a conversion is of a channel that no explanation uses, such as a loaded radius."""
    name = conversion.partition(":")[0]
    further = name in {channel.name for channel in FURTHER} and name not in INPUT_CHANNELS
    return further and not name.startswith("simulated_")


def _arrays(recording: pd.DataFrame) -> dict[str, Array]:
    """Return the numeric columns that are known, as float64."""
    arrays: dict[str, Array] = {}
    for name, series in pd.DataFrame(recording, copy=False).items():  # attrs would be copied
        try:
            arrays[str(name)] = series.to_numpy(dtype=float, na_value=np.nan)
        except (TypeError, ValueError):
            continue  # a column of text that is no channel
    if len(recording) == 0:
        raise RecordingError("the recording has no rows", todo="record again, or check how it was read")
    for name in [n for n, a in arrays.items() if n != "time" and not np.isfinite(a).any()]:
        del arrays[name]
    if not any(n in arrays for n in TANGENTIAL_FORCES):
        raise RecordingError(
            "no force channel: the recording has neither fx nor fy",
            todo=f"name the force columns fx, fy (columns are: {', '.join(map(str, recording.columns))})",
        )
    if "normal_load" not in arrays:
        raise RecordingError("no normal_load, which every tire model needs", todo="record or compute it")
    if "slip_angle" not in arrays and "slip_ratio" not in arrays:
        raise RecordingError("neither slip_angle nor slip_ratio is recorded", todo="record one of them")
    least = LEAST_SAMPLES if "time" in arrays else LEAST_POINTS
    if len(recording) < least:
        raise RecordingError(
            f"only {len(recording)} samples; at least {least} are needed to tell an effect from noise",
            todo="use a longer recording",
        )
    return arrays


def _dead_forces(arrays: dict[str, Array], notes: list[str]) -> None:
    """Take out forces that never change; raise if none is left."""
    dead = [n for n in TANGENTIAL_FORCES if n in arrays and np.ptp(arrays[n]) == 0.0]
    if not dead:
        return
    values = ", ".join(f"{n} is {arrays[n][0]:.4g} N throughout" for n in dead)
    for name in dead:
        del arrays[name]
    if not any(n in arrays for n in TANGENTIAL_FORCES):
        raise RecordingError(
            f"no force was measured: {values}", where=", ".join(dead), todo="check that the sensor was on"
        )
    notes.append(f"{values} and left out")


def _check_together(arrays: Mapping[str, Array]) -> None:
    """Raise if hardly any row has slip, load and force."""
    for force in [n for n in TANGENTIAL_FORCES if n in arrays]:
        if said := apart(arrays, force):
            raise RecordingError(
                said,
                where=force,
                todo="bring the channels to common moments first, or drop those that are mostly empty",
            )


def _bridge(arrays: dict[str, Array], notes: list[str]) -> None:
    """Put straight lines over holes of up to three samples, so that the time base stays even."""
    filled = np.zeros(arrays["normal_load"].size, bool)
    for name in (*INPUT_CHANNELS, *FORCE_CHANNELS):
        if name not in arrays:
            continue
        x = arrays[name]
        missing = ~np.isfinite(x)
        if not missing.any() or missing.all():
            continue
        known = np.flatnonzero(~missing)
        filled |= short_holes(missing)
        holes = np.flatnonzero(filled & missing)
        arrays[name] = x.copy()
        arrays[name][holes] = np.interp(holes, known, x[known])
    if filled.any():
        notes.append(
            f"{how_many(int(filled.sum()), 'sample')} in holes of up to {LONGEST_HOLE}: put on straight lines"
        )


def _usable(arrays: Mapping[str, Array], time: Array | None, notes: list[str]) -> Array:
    """Return the rows in which every channel that matters is finite."""
    n = arrays["normal_load"].size
    ok = np.ones(n, bool)
    if time is not None:
        ok &= np.isfinite(time)
    for name in (*INPUT_CHANNELS, *TANGENTIAL_FORCES):
        if name in arrays:
            ok &= np.isfinite(arrays[name])
    lost = int(n - ok.sum())
    if lost:
        worst = max(
            (*INPUT_CHANNELS, *TANGENTIAL_FORCES),
            key=lambda c: int((~np.isfinite(arrays[c])).sum()) if c in arrays else -1,
        )
        notes.append(f"{lost} of {n} samples left out: without a number in some channel (most often {worst})")
    if ok.sum() < max(LEAST_POINTS, LEAST_WHOLE * n):
        raise RecordingError(
            f"only {int(ok.sum())} of {n} samples have numbers in all channels",
            todo="drop the columns that are mostly empty",
        )
    return np.flatnonzero(ok)


def _overlap(tire: Any, arrays: Mapping[str, Array]) -> None:
    """Raise if the recording lies outside of the model's range."""
    load = arrays["normal_load"]
    c = tire.coefficients
    nominal = c.get("FNOMIN", float(np.median(load)))
    low, high = (size * nominal for size in _LOADS_OF_MODEL)
    if c.get("FZMAX", 0.0) > 0.0:
        low = min(low, c.get("FZMIN", low)) if c.get("FZMIN", 0.0) > 0.0 else low
        high = max(high, c["FZMAX"])
    inside = (load > low) & (load < high)
    if inside.mean() < LEAST_WHOLE:
        raise RecordingError(
            f"no overlap between model and recording: the loads are {np.min(load):.4g} to "
            f"{np.max(load):.4g} N, "
            f"the model's nominal load is {c.get('FNOMIN', float('nan')):.4g} N",
            where="normal_load",
            todo="use the .tir file of this tire, or check the unit of the load",
        )


def _better_followed(lagged: Data, at_once: Data, notes: list[str]) -> Data:
    """Leave out the relaxation that the file states where the forces follow slip better without it.

    A log of a simulation without it, or of steady forces, has none.
    """
    left = [
        sum(float(np.mean(x**2)) / largest(data.recorded[o]) ** 2 for o, x in residual(data, []).items())
        for data in (lagged, at_once)
    ]
    if left[0] < left[1]:
        return lagged
    if left[0] > left[1]:
        lengths = lengths_in_words(lagged.followed_relaxation)
        notes.append(f"the forces follow slip without the relaxation that the file states ({lengths})")
    return at_once
