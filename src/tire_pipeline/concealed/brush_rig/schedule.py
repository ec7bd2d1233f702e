"""What the rig is told to do: blocks of sweeps, sines, steps and ramps, in a drawn order.

The blocks of a case follow from its *focus*. In a case with an effect the focus is the effect; in
a case without, the focus is a decoy drawn from the same distribution. So every block occurs as
often in cases without an effect, and the schedule gives nothing away.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import pandas as pd
import scipy

from tire_pipeline.channels import POINT_CHANNELS
from tire_pipeline.concealed.effect_names import HEAT_OR_WEAR

CHANNELS = (*POINT_CHANNELS, "turn_slip")
"""Inputs of the tire, in the order of the columns that :mod:`brush` takes."""

OPTIONAL_BLOCKS = ("camber", "pressure", "speed", "sine", "brake", "turn", "coast", "repeat")
"""Blocks that a schedule may hold beside its base sweeps."""

_NEEDS: dict[str, tuple[str, ...]] = {
    "camber": ("camber",),
    "combined_slip": ("brake",),
    "inflation_pressure": ("pressure",),
    "temperature": ("coast", "repeat"),
    "wear": ("coast", "repeat"),
    "speed_dependence": ("speed",),
    "relaxation_length": ("sine",),
    "time_delay": ("sine",),
    "low_pass": ("sine",),
    "turn_slip": ("turn",),
    "crosstalk": ("brake",),
    "force_gain": ("brake",),
    "slip_ratio_offset": ("brake",),
    "friction_scale": ("brake",),
    "surface_change": ("repeat",),
    "sensor_drift": ("repeat",),
    "backlash": ("sine",),
    "rig_resonance": ("sine",),
    "slip_rate": ("sine",),
    "load_rate": ("repeat",),
}
_AMBIGUOUS: dict[int, tuple[str, ...]] = {
    0: ("sine",),
    1: (),
    2: ("repeat",),
    3: ("repeat",),
}


@dataclass(frozen=True)
class CasePlan:
    """How a rig is run in one case; drawn once, used for the recording and the held-out run.

    Attributes
    ----------
    blocks : tuple of str
        Optional blocks that the schedule holds.
    single_speed, single_load : bool
        Whether speed or load never change (ambiguous by design).
    loads, cambers, pressures, speeds : tuple of float
        Levels, SI.
    held_out_load : float
        A load that the recording never has.
    """

    blocks: tuple[str, ...]
    single_speed: bool
    single_load: bool
    loads: tuple[float, ...]
    held_out_load: float
    cambers: tuple[float, ...]
    pressures: tuple[float, ...]
    speeds: tuple[float, ...]
    speed: float
    pressure: float
    nominal_load: float
    amplitude: float
    rate: float
    shape: str
    sweeps: int


def draw_plan(
    rng: np.random.Generator,
    focus: tuple[str, ...],
    *,
    ambiguous: int | None,
    nominal_load: float,
    speed: float,
    pressure: float,
) -> CasePlan:
    """Draw the plan of one case.

    Parameters
    ----------
    rng : numpy.random.Generator
    focus : tuple of str
        Effects, concealed or decoys, that the schedule must be able to show.
    ambiguous : int, optional
        Which of ``names.AMBIGUOUS_SETS`` the schedule must not be able to separate.
    nominal_load, speed, pressure : float
        N, m/s, Pa.
    """
    if ambiguous is None:
        needed = {block for name in focus for block in _NEEDS.get(name, ())}
        chance = [0.5, 0.4, 0.55, 0.5, 0.5, 0.2, 0.35, 0.5]
    else:
        needed = set(_AMBIGUOUS[ambiguous])
        chance = [0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0]
        if ambiguous == HEAT_OR_WEAR:
            chance = [0.3, 0.0, 0.0, 0.3, 0.4, 0.0, 0.0, 0.0]
    drawn = {b for b, p in zip(OPTIONAL_BLOCKS, chance, strict=True) if rng.random() < p}
    n_loads = int(rng.integers(3, 6))
    loads = np.linspace(rng.uniform(0.3, 0.5), rng.uniform(1.35, 1.6), n_loads)
    loads = loads * rng.uniform(0.95, 1.05, n_loads)
    single_load = ambiguous in (2, 3)
    if single_load:
        loads = np.array([rng.uniform(0.8, 1.1)])
    place = rng.uniform(0.35, 0.65) if single_load is False else 0.0
    held = loads[0] * 1.0 if single_load else loads[0] + place * (loads[1] - loads[0])
    camber = float(rng.uniform(0.04, 0.09))
    return CasePlan(
        blocks=tuple(b for b in OPTIONAL_BLOCKS if b in needed or b in drawn),
        single_speed=ambiguous is not None,
        single_load=single_load,
        loads=tuple(float(v) for v in np.round(rng.permutation(loads) * nominal_load, -1)),
        held_out_load=float(np.round(held * nominal_load, -1)),
        cambers=tuple(float(v) for v in rng.permutation([-camber, 0.5 * camber, camber])),
        pressures=tuple(float(v) for v in pressure * rng.permutation([0.82, 1.18])),
        speeds=tuple(float(v) for v in speed * rng.permutation([0.4, 1.6, 2.2])),
        speed=speed,
        pressure=pressure,
        nominal_load=nominal_load,
        amplitude=float(rng.uniform(0.14, 0.23)),
        rate=float(rng.uniform(0.04, 0.13)),
        shape=str(rng.choice(["triangle", "sine", "dwell"])),
        sweeps=int(rng.integers(1, 3)),
    )


@dataclass
class _SetPoints:
    """Collects stretches of set points at the recording's rate."""

    plan: CasePlan
    dt: float
    parts: list[dict[str, np.ndarray]] = field(default_factory=list)
    starts: list[tuple[str, int]] = field(default_factory=list)
    length: int = 0

    def run(self, name: str, seconds: float, **values: float | np.ndarray) -> None:
        """Append a stretch; channels that are not named rest at their nominal value."""
        n = max(round(seconds / self.dt), 2)
        rest = {
            "slip_angle": 0.0,
            "slip_ratio": 0.0,
            "camber": 0.0,
            "normal_load": self.plan.nominal_load if not self.plan.single_load else values_load(self),
            "speed": self.plan.speed,
            "pressure": self.plan.pressure,
            "turn_slip": 0.0,
        }
        part = {}
        for channel, value in (rest | values).items():
            array = np.asarray(value, dtype=float)
            part[channel] = np.full(n, float(array)) if array.ndim == 0 else array[:n]
        self.starts.append((name, self.length))
        self.parts.append(part)
        self.length += n


def values_load(points: _SetPoints) -> float:
    """Load at which a single-load plan runs, N."""
    return points.plan.loads[0]


def _sweep(plan: CasePlan, dt: float, amplitude: float, rate: float, cycles: int = 1) -> np.ndarray:
    """Slip angle of whole sweeps, from zero to both sides and back, rad."""
    period = 4.0 * amplitude / rate
    t = np.arange(round(cycles * period / dt)) * dt
    phase = (t / period) % 1.0
    if plan.shape == "sine":
        return amplitude * np.sin(2.0 * np.pi * phase)
    triangle = 4.0 * np.abs(((phase - 0.25) % 1.0) - 0.5) - 1.0
    if plan.shape == "dwell":
        return amplitude * np.clip(1.15 * triangle, -1.0, 1.0)
    return amplitude * triangle


def _base(points: _SetPoints, rng: np.random.Generator, loads: tuple[float, ...]) -> None:
    for load in loads:
        a = _sweep(points.plan, points.dt, points.plan.amplitude, points.plan.rate, points.plan.sweeps)
        points.run("base", len(a) * points.dt, slip_angle=a, normal_load=load)


def _levels(
    channel: str,
) -> Callable[[_SetPoints, np.random.Generator, tuple[float, ...]], None]:
    """Sweeps at each level of a channel, at two loads."""

    def block(points: _SetPoints, rng: np.random.Generator, levels: tuple[float, ...]) -> None:
        plan = points.plan
        loads = sorted(plan.loads)
        pair = (loads[0], loads[-1]) if len(loads) > 1 else (loads[0],)
        if rng.random() < 0.5 and len(loads) > 2:
            pair = (loads[1], loads[-2]) if len(loads) > 3 else (loads[0], loads[1])
        rate = plan.rate * 1.3
        for level in levels:
            for load in pair:
                a = _sweep(plan, points.dt, plan.amplitude, rate)
                points.run(channel, len(a) * points.dt, slip_angle=a, normal_load=load, **{channel: level})

    return block


def _sine(points: _SetPoints, rng: np.random.Generator, _: tuple[float, ...]) -> None:
    plan = points.plan
    speeds = [plan.speed]
    if not plan.single_speed:
        speeds += [plan.speed * float(rng.uniform(0.35, 0.5)), plan.speed * 1.6]
    for speed in rng.permutation(speeds):
        for frequency in (0.5, 1.0, 2.0):
            seconds = 4.0 / frequency
            t = np.arange(round(seconds / points.dt)) * points.dt
            amplitude = float(rng.uniform(0.015, 0.05)) / frequency**0.3
            a = amplitude * np.sin(2.0 * np.pi * frequency * t)
            points.run("sine", seconds, slip_angle=a, speed=float(speed))


def _brake(points: _SetPoints, rng: np.random.Generator, angles: tuple[float, ...]) -> None:
    plan = points.plan
    loads = sorted(plan.loads)
    pair = (loads[0], loads[-1]) if len(loads) < 3 else (loads[-2], loads[0])
    depth = float(rng.uniform(0.12, 0.2))
    seconds = float(rng.uniform(4.0, 7.0))
    t = np.arange(round(seconds / points.dt)) * points.dt / seconds
    ramp = -depth * (4.0 * np.abs(((t - 0.25) % 1.0) - 0.5) - 1.0)
    edge = np.linspace(0.0, 1.0, round(1.0 / points.dt))
    for angle in angles:
        for place, load in enumerate(pair):
            into = edge if place == 0 and angle else edge[:0]
            out = edge[::-1] if place == len(pair) - 1 and angle else edge[:0]
            steer = angle * np.concatenate([into, np.ones(len(ramp)), out])
            slip = np.concatenate([0.0 * into, ramp, 0.0 * out])
            points.run("brake", len(slip) * points.dt, slip_ratio=slip, slip_angle=steer, normal_load=load)


def _turn(points: _SetPoints, rng: np.random.Generator, curvatures: tuple[float, ...]) -> None:
    plan = points.plan
    for curvature in curvatures:
        a = _sweep(plan, points.dt, 0.5 * plan.amplitude, plan.rate * 1.3)
        points.run("turn", len(a) * points.dt, slip_angle=a, turn_slip=curvature, speed=0.5 * plan.speed)


def _coast(points: _SetPoints, rng: np.random.Generator, _: tuple[float, ...]) -> None:
    points.run("coast", float(rng.uniform(20.0, 45.0)), speed=points.plan.speed)


def _repeat(points: _SetPoints, rng: np.random.Generator, loads: tuple[float, ...]) -> None:
    for load in loads:
        a = _sweep(points.plan, points.dt, points.plan.amplitude, points.plan.rate)
        points.run("repeat", len(a) * points.dt, slip_angle=a, normal_load=load)


def make_schedule(
    plan: CasePlan, rng: np.random.Generator, *, rate: float, held_out: bool = False
) -> tuple[pd.DataFrame, list[tuple[str, int]]]:
    """Turn a plan into the channels that the rig runs.

    Parameters
    ----------
    plan : CasePlan
    rng : numpy.random.Generator
    rate : float
        Samples a second.
    held_out : bool
        Make the shorter held-out run instead: sweeps at a load and at levels that the recording
        does not have.

    Returns
    -------
    schedule : pandas.DataFrame
        ``time`` and :data:`CHANNELS`, SI, as the tire truly sees them.
    starts : list of (block, first row)
    """
    points = _SetPoints(plan, 1.0 / rate)
    if held_out:
        between = (plan.held_out_load, plan.loads[0])
        _base(points, rng, between if not plan.single_load else between[:1])
        levels = _held_out_levels(plan, rng)
        order = [b for b in OPTIONAL_BLOCKS if b in plan.blocks and b not in ("coast", "repeat")]
    else:
        _base(points, rng, plan.loads)
        levels = _recorded_levels(plan, rng)
        middle = [b for b in plan.blocks if b not in ("coast", "repeat")]
        order = [str(b) for b in rng.permutation(middle)] if middle else []
        order += [b for b in ("coast", "repeat") if b in plan.blocks]
    for name in order:
        _BLOCKS[name](points, rng, levels.get(name, ()))
    frame = pd.DataFrame({name: np.concatenate([p[name] for p in points.parts]) for name in CHANNELS})
    lags = {"camber": 0.3, "normal_load": 0.25, "speed": 1.2, "pressure": 1.5, "turn_slip": 0.5}
    for channel, lag in lags.items():
        frame[channel] = _follow(frame[channel].to_numpy(), lag * rate)
    for channel in ("slip_angle", "slip_ratio"):
        frame[channel] = _follow(frame[channel].to_numpy(), 0.04 * rate)
    frame.insert(0, "time", np.arange(len(frame)) / rate)
    return frame, points.starts


def _recorded_levels(plan: CasePlan, rng: np.random.Generator) -> dict[str, tuple[float, ...]]:
    side = float(rng.uniform(0.03, 0.06))
    turn = float(rng.uniform(0.08, 0.2))
    return {
        "camber": plan.cambers,
        "pressure": plan.pressures,
        "speed": plan.speeds,
        "brake": (0.0, side, -1.7 * side),
        "turn": (turn, -turn, 0.5 * turn),
        "repeat": plan.loads[: max(2, len(plan.loads) - 1)],
    }


def _held_out_levels(plan: CasePlan, rng: np.random.Generator) -> dict[str, tuple[float, ...]]:
    return {
        "camber": (0.75 * max(plan.cambers),),
        "pressure": (plan.pressure * float(rng.choice([0.88, 1.12])),),
        "speed": (plan.speed * float(rng.choice([0.6, 1.4])),),
        "brake": (0.0, 0.045),
        "turn": (float(rng.uniform(0.05, 0.12)),),
    }


def _follow(target: np.ndarray, samples: float) -> np.ndarray:
    """First-order lag of a rig actuator, starting at rest on the first target."""
    b = 1.0 - np.exp(-1.0 / samples)
    out, _ = scipy.signal.lfilter([b], [1.0, b - 1.0], target, zi=[(1.0 - b) * target[0]])
    return np.asarray(out)


_BLOCKS: dict[str, Callable[[_SetPoints, np.random.Generator, tuple[float, ...]], None]] = {
    "camber": _levels("camber"),
    "pressure": _levels("pressure"),
    "speed": _levels("speed"),
    "sine": _sine,
    "brake": _brake,
    "turn": _turn,
    "coast": _coast,
    "repeat": _repeat,
}
