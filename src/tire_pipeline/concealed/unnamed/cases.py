"""A case of the open world: the second simulator's recording with a mechanism that is in no catalogue."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.channels import POINT_CHANNELS, SLIP_AND_LOAD
from tire_pipeline.concealed.open_world.mechanism import Added, Mechanism, put_in
from tire_pipeline.concealed.open_world.world import Nominal, World
from tire_pipeline.concealed.second import schedule
from tire_pipeline.concealed.second.causes import CAUSES
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
from tire_pipeline.concealed.second.roll import FORCES, Course
from tire_pipeline.concealed.second.run import Placed, Run
from tire_pipeline.concealed.second.strength import formula_misfit, sized, unit
from tire_pipeline.concealed.second.tire import Tire, draw_tire
from tire_pipeline.magic_formula import TireModel, fit_magic_formula

_PRESSURE_CHANGE = 0.2
"""Either way, where a mechanism needs the pressure to change."""
CATALOGUE_NAMES = {
    "inflation pressure": "inflation_pressure",
    "surface friction": "friction_scale",
    "carcass stiffness": "stiffness_scale",
    "load sensitivity": "load_sensitivity",
    "tread wear": "wear",
    "force offset": "force_offset",
    "slip angle offset": "slip_angle_offset",
}
"""Causes of the second simulator that may stand beside a mechanism -> effects of the catalogue."""
HELD_OUT_SHARE = 0.25
"""Rows that follow the recording and that nobody is shown, over those of the recording."""
_OF_FIT = (*SLIP_AND_LOAD, "speed")
_EVERY = 20
"""Rows of the references that the formula is fitted to."""


@dataclass(frozen=True)
class OpenCase:
    """One case.

    Parameters
    ----------
    tire : TireModel
        Fitted to reference recordings of the same tire without any mechanism.
    recording, held_out : pandas.DataFrame
        Canonical columns; the held-out rows follow the recording.
    added : tuple of Added
        What was added, sealed.
    named : tuple of str
        Causes of the second simulator's catalogue that are in, too.
    held_with, held_without : ndarray, shape (rows, 3)
        Forces of the held-out rows with and without all that was put in, free of noise. A pressure that
        changes is in both: the tire has it by itself.
    change : ndarray, shape (rows, 3)
        What the mechanisms do in the shown rows.
    unit : ndarray, shape (3,)
        Noise and the formula's misfit together, of which strengths are multiples: N, N, N m.
    """

    tire: TireModel
    recording: pd.DataFrame
    held_out: pd.DataFrame
    added: tuple[Added, ...]
    named: tuple[str, ...]
    held_with: np.ndarray
    held_without: np.ndarray
    change: np.ndarray
    unit: np.ndarray
    nominal: Nominal


def draw_open_case(
    seed: int,
    mechanisms: Sequence[Mechanism],
    named: Sequence[str] = (),
    strength: float | None = None,
    rows: int = 6000,
) -> OpenCase:
    """Draw one case; the same seed gives the same one.

    Parameters
    ----------
    seed : int
    mechanisms : sequence of Mechanism
        None, one or two.
    named : sequence of str
        Causes of ``concealed.second`` beside them.
    strength : float, optional
        In misfits; drawn from 0.5 to 6 if left out.
    rows : int
        At 100 Hz.

    Raises
    ------
    ValueError
        The run does not excite a mechanism, with pressures that change either.
    """
    try:
        return _drawn(seed, mechanisms, named, strength, rows, pressures=False)
    except ValueError:
        return _drawn(seed, mechanisms, named, strength, rows, pressures=True)


def _drawn(
    seed: int,
    mechanisms: Sequence[Mechanism],
    named: Sequence[str],
    strength: float | None,
    rows: int,
    *,
    pressures: bool,
) -> OpenCase:
    rng = np.random.default_rng(seed)
    tire, rig = draw_tire(rng), draw_rig(rng)
    sections = schedule.drawn_sections(
        rng, tire, rows + round(rows * HELD_OUT_SHARE), quick=False, speeds=True
    )
    course = driven(schedule.played(sections, tire), rig, tire, rng)
    levels = schedule.pattern(sections, rng)
    if pressures:
        course = course._replace(pressure=course.pressure * (1.0 + _PRESSURE_CHANGE * levels))
    run = Run(tire, rig, course, float(rng.choice([-15.0, 15.0])))
    placed = _placed(rng, run, levels, named)
    world = _world(run, placed)
    one = unit(rig, world.forces.T, formula_misfit())
    added = tuple(put_in(m, world, one, rng, strength) for m in mechanisms)
    change = sum((a.change for a in added), np.zeros_like(world.forces))
    without = run.forces().T if placed else world.forces
    table = _table(run, world, change, draw_noise(rig, len(change), rng))
    return OpenCase(
        tire=_fitted(rng, tire, rig),
        recording=table.iloc[:rows].reset_index(drop=True),
        held_out=table.iloc[rows:].reset_index(drop=True),
        added=added,
        named=(*named, *(("inflation pressure",) if pressures else ())),
        held_with=(world.forces + change)[rows:],
        held_without=without[rows:],
        change=change[:rows],
        unit=one,
        nominal=world.nominal,
    )


def _placed(
    rng: np.random.Generator, run: Run, levels: np.ndarray, named: Sequence[str]
) -> tuple[Placed, ...]:
    """Causes of the second simulator's catalogue, each at twice the misfit."""
    if not named:
        return ()
    without = run.forces()
    one = unit(run.rig, without, formula_misfit())
    scales = np.sqrt(np.mean(without**2, axis=1))
    out = []
    for name in named:
        draw = Draw(
            sign=float(rng.choice([-1.0, 1.0])), channel=1, constant=True, levels=levels, scales=scales
        )
        size, _ = sized(run, CAUSES[name], draw, without, one, 2.0)
        out.append((CAUSES[name], size, draw))
    return tuple(out)


def _world(run: Run, placed: tuple[Placed, ...]) -> World:
    rolled, course = run.rolled(placed)
    channels = pd.DataFrame({"time": course.time, **{name: getattr(course, name) for name in POINT_CHANNELS}})
    channels["tread_temperature"] = rolled.tread_temperature

    def forces(at: pd.DataFrame) -> np.ndarray:
        moved = run.course._replace(**{name: at[name].to_numpy() for name in POINT_CHANNELS})
        other = Run(run.tire, run.rig, moved, run.above)
        return other.forces(placed).T

    tire = run.tire
    nominal = Nominal(
        tire.nominal_load, tire.nominal_speed, tire.nominal_pressure, tire.friction_temperature, tire.radius
    )
    return World(channels, run.measured(rolled, placed).T, forces, nominal)


def _table(run: Run, world: World, change: np.ndarray, noise: Noise) -> pd.DataFrame:
    time = run.course.time
    columns: dict[str, Any] = {"time": time}
    for name in ENCODED:
        columns[name] = sensed(filtered(getattr(run.course, name), run.rig), name, time, noise)
    temperature = filtered(world.channels["tread_temperature"].to_numpy(), run.rig)
    columns["tread_temperature"] = sensed(temperature, "tread_temperature", time, noise)
    for name, force in zip(FORCES, (world.forces + change).T, strict=True):
        columns[name] = sensed(force, name, time, noise)
    return pd.DataFrame(columns)


def _fitted(rng: np.random.Generator, tire: Tire, rig: Rig) -> TireModel:
    """A Magic Formula fitted to reference sweeps of the tire, with the rig's noise on the forces."""
    tables = []
    for sections in schedule.reference_sections(tire):
        course: Course = driven(schedule.played(sections, tire), rig, tire, rng)
        run = Run(tire, rig, course, 0.0)
        noise = draw_noise(rig, course.time.size, rng)
        table = pd.DataFrame({name: filtered(getattr(course, name), rig) for name in _OF_FIT})
        for name, force in zip(FORCES, run.forces(), strict=True):
            table[name] = sensed(force, name, course.time, noise)
        tables.append(table.iloc[::_EVERY])
    points = pd.concat(tables, ignore_index=True)
    return fit_magic_formula(
        points, nominal_load=tire.nominal_load, unloaded_radius=tire.radius, starts=2, loss="linear"
    ).model
