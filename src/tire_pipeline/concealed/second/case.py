"""A case: a recording with a cause in it, recordings of the same tire without, and the sealed truth."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.concealed.second import schedule
from tire_pipeline.concealed.second.causes import CAUSES, Cause
from tire_pipeline.concealed.second.draws import Draw
from tire_pipeline.concealed.second.rig import (
    ENCODED,
    Noise,
    Rig,
    draw_noise,
    draw_rig,
    driven,
    filtered,
    sensed,
)
from tire_pipeline.concealed.second.roll import FORCES, Course, Rolled
from tire_pipeline.concealed.second.run import Placed, Run, as_parameters
from tire_pipeline.concealed.second.strength import STRONGEST, WEAKEST, formula_misfit, sized, unit
from tire_pipeline.concealed.second.tire import Tire, draw_tire

NOTHING = "nothing"
MOST_ROWS = 18_000
HELD_OUT = 0.25  # rows of the held-out sweeps over those of the recording


@dataclass(frozen=True)
class Truth:
    """What is sealed: what was done to the recording, and the forces with and without it, free of noise.

    `strengths` are in multiples of `unit` (3,: N, N, N m), noise and the formula's misfit together, each
    cause alone. `held_out` has the channels of sweeps that follow the recording; the four arrays are
    (rows, 3), fx, fy, mz, of the recording and of those sweeps. What `held_with` and `held_without` differ
    by is all that an oracle could remove.
    """

    causes: tuple[str, ...]
    physics: tuple[str, ...]
    parameters: tuple[dict[str, Any], ...]
    strengths: tuple[float, ...]
    unit: np.ndarray
    recording_with: np.ndarray
    recording_without: np.ndarray
    held_out: pd.DataFrame
    held_with: np.ndarray
    held_without: np.ndarray
    tire: Tire
    rig: Rig


@dataclass(frozen=True)
class SecondCase:
    """A recording (columns of `docs/reference/recordings.md`, SI, ISO W), references without it, truth."""

    recording: pd.DataFrame
    references: tuple[pd.DataFrame, ...]
    truth: Truth


def _chosen(rng: np.random.Generator, cause: str | tuple[str, ...] | None) -> tuple[Cause, ...]:
    """The causes asked for, or one of all and nothing, each as likely."""
    if cause is None:
        cause = str(rng.choice([NOTHING, *CAUSES]))
    names = (cause,) if isinstance(cause, str) else tuple(cause)
    unknown = [name for name in names if name != NOTHING and name not in CAUSES]
    if unknown:
        raise ValueError(f"no cause {unknown[0]!r} in the second simulator; known are {[NOTHING, *CAUSES]}")
    return tuple(CAUSES[name] for name in names if name != NOTHING)


def _table(
    run: Run, rolled: Rolled, forces: np.ndarray, noise: Noise, hidden: tuple[str, ...], course: Course
) -> pd.DataFrame:
    """What is stored of a run: encoders of the course, temperature, forces; without the `hidden` channels."""
    time = run.course.time
    columns = {"time": time}
    for name in ENCODED:
        columns[name] = sensed(filtered(getattr(course, name), run.rig), name, time, noise)
    temperature = filtered(rolled.tread_temperature, run.rig)
    columns["tread_temperature"] = sensed(temperature, "tread_temperature", time, noise)
    if np.any(course.turn_slip):
        columns["turn_slip"] = filtered(course.turn_slip, run.rig)
    for name, force in zip(FORCES, forces, strict=True):
        columns[name] = sensed(force, name, time, noise)
    return pd.DataFrame({name: values for name, values in columns.items() if name not in hidden})


def _hidden(rng: np.random.Generator, causes: tuple[Cause, ...]) -> tuple[str, ...]:
    """Channels that this recording has not: gauges that some rigs lack, and those that would give it away."""
    hidden = [name for name in ("pressure", "tread_temperature") if rng.random() < 0.35]
    if any(cause.name == "path curvature" for cause in causes) and rng.random() < 0.6:
        hidden.append("turn_slip")
    return tuple(hidden)


def _stored_course(run: Run, placed: tuple[Placed, ...]) -> Course:
    """What the encoders see: pressure and curvature as they are; camber and slip angle as they were told."""
    seen = run.course
    for cause, size, draw in placed:
        gauged = cause.name == "path curvature" or (cause.name == "inflation pressure" and not draw.constant)
        if gauged and cause.on_course is not None:
            seen = cause.on_course(seen, size, draw)
    return seen


def _references(rng: np.random.Generator, tire: Tire, rig: Rig) -> tuple[pd.DataFrame, ...]:
    """The same tire without a cause, on its own schedule and the same rig."""
    tables = []
    for sections in schedule.reference_sections(tire):
        run = Run(tire, rig, driven(schedule.played(sections, tire), rig, tire, rng), 0.0)
        rolled, course = run.rolled()
        noise = draw_noise(rig, course.time.size, rng)
        tables.append(_table(run, rolled, run.measured(rolled), noise, (), course))
    return tuple(tables)


def _draw(rng: np.random.Generator, levels: np.ndarray, scales: np.ndarray) -> Draw:
    """Sign, channel and course of one cause; a channel that the schedule excites."""
    excited = np.flatnonzero(scales > np.array([300.0, 300.0, 5.0]))
    return Draw(
        sign=float(rng.choice([-1.0, 1.0])),
        channel=int(rng.choice(excited)),
        constant=bool(rng.random() < 0.6),
        levels=levels,
        scales=scales,
    )


def _drawn_run(
    rng: np.random.Generator, tire: Tire, rig: Rig, causes: tuple[Cause, ...], rows: int
) -> tuple[Run, np.ndarray]:
    """A run with what the causes need, or by chance without need, and its level a section, (n,)."""
    quick = any(cause.quick for cause in causes) or rng.random() < 0.25
    speeds = any(cause.speeds for cause in causes) or rng.random() < 0.25
    off = any(cause.off_temperature for cause in causes) or rng.random() < 0.25
    sections = schedule.drawn_sections(rng, tire, rows, quick, speeds)
    course = driven(schedule.played(sections, tire), rig, tire, rng)
    above = float(rng.choice([-1.0, 1.0]) * rng.uniform(10.0, 20.0)) if off else 0.0
    return Run(tire, rig, course, above), schedule.pattern(sections, rng)


def _placed(
    rng: np.random.Generator,
    run: Run,
    levels: np.ndarray,
    without: np.ndarray,
    one: np.ndarray,
    wanted: tuple[tuple[Cause, float], ...],
) -> tuple[tuple[Placed, ...], tuple[float, ...]]:
    """Each cause with its size and draw, and the strength it reached alone."""
    scales = np.sqrt(np.mean(without**2, axis=1))
    placed, strengths = [], []
    for cause, much in wanted:
        draw = _draw(rng, levels, scales)
        size, reached = sized(run, cause, draw, without, one, much)
        placed.append((cause, size, draw))
        strengths.append(reached)
    return tuple(placed), tuple(strengths)


def draw_case(
    rng: np.random.Generator,
    cause: str | tuple[str, ...] | None = None,
    strength: float | tuple[float, ...] | None = None,
    rows: int = 6000,
    misfit: np.ndarray | None = None,
) -> SecondCase:
    """Draw one case of the second simulator.

    Parameters
    ----------
    rng
        The same state gives the same case.
    cause
        A name of `CAUSES`, several, "nothing", or None: one of these drawn, each as likely.
    strength
        RMS of the change of the forces, in the one it shows in most, in multiples of noise and the formula's
        misfit together; one a cause. None: drawn, even on a logarithmic scale from 0.5 to 6. Where physics
        ends before, `truth.strengths` says what was reached.
    rows
        Rows of the recording at 100 Hz, at most 18,000.
    misfit
        The formula's misfit over each force's RMS, (3,); None: `formula_misfit`.

    Returns
    -------
    SecondCase

    Raises
    ------
    ValueError
        Where a cause is unknown, strengths do not go with the causes, or rows are not 600 to 18,000.
    """
    causes = _chosen(rng, cause)
    if not 600 <= rows <= MOST_ROWS:
        raise ValueError(f"rows is {rows}; give 600 to {MOST_ROWS}")
    wanted = (strength,) * len(causes) if isinstance(strength, (int, float)) else strength
    if wanted is None:
        wanted = tuple(np.exp(rng.uniform(np.log(WEAKEST), np.log(STRONGEST), len(causes))))
    if len(wanted) != len(causes):
        raise ValueError(f"{len(wanted)} strengths for {len(causes)} causes; give one a cause")
    tire, rig = draw_tire(rng), draw_rig(rng)
    run, levels = _drawn_run(rng, tire, rig, causes, rows + round(rows * HELD_OUT))
    without = run.forces()
    one = unit(rig, without, formula_misfit() if misfit is None else misfit)
    placed, strengths = _placed(rng, run, levels, without, one, tuple(zip(causes, wanted, strict=True)))
    rolled, _ = run.rolled(placed)
    forces = run.measured(rolled, placed)
    noise = draw_noise(rig, forces.shape[1], rng)
    hidden = _hidden(rng, causes)
    table = _table(run, rolled, forces, noise, hidden, _stored_course(run, placed))
    truth = Truth(
        causes=tuple(each.name for each in causes),
        physics=tuple(each.physics for each in causes),
        parameters=tuple(as_parameters(each) for each in placed),
        strengths=strengths,
        unit=one,
        recording_with=forces.T[:rows],
        recording_without=without.T[:rows],
        held_out=table.iloc[rows:].reset_index(drop=True),
        held_with=forces.T[rows:],
        held_without=without.T[rows:],
        tire=tire,
        rig=rig,
    )
    return SecondCase(table.iloc[:rows].reset_index(drop=True), _references(rng, tire, rig), truth)
