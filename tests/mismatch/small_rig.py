"""A small rig: a tire with a structured misfit, and what it drives through."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.recording.prepare import prepare

COEFFICIENTS = {
    "FNOMIN": 4000.0,
    "UNLOADED_RADIUS": 0.32,
    "LONGVL": 16.7,
    "PCY1": 1.35,
    "PDY1": 1.02,
    "PDY2": -0.1,
    "PEY1": -1.2,
    "PEY2": -0.6,
    "PKY1": 22.0,
    "PKY2": 2.1,
}

ANOTHER = {"PDY1": 0.9, "PDY2": -0.25, "PKY1": 30.0, "PKY2": 1.4, "PEY1": -0.3}
"""Coefficients of another tire."""

LOAD_LAG = 0.24
"""Of the load behind what was asked for, s."""


def rig_force(tire, alpha, load, friction=1.0, stiffness=1.0):
    """The tire's force with another friction and stiffness, and the misfit that fitted models have."""
    plain = tire.forces(slip_angle=alpha * stiffness / friction, normal_load=load).fy * friction
    wave = np.sin(5.0 * np.arctan(alpha / 0.06)) * np.cos(2.0 * load / 4000.0)
    return plain + 0.006 * load * wave * np.abs(alpha) / (np.abs(alpha) + 0.03)


def schedule(seconds=150.0, rate=25.0):
    """Return time (s), slip angle (rad), normal load (N) and pressure (Pa) at ``rate`` samples per second."""
    t = np.arange(0.0, seconds, 1.0 / rate)
    period = 7.5
    triangle = 2.0 * np.abs(2.0 * ((t / period + 0.25) % 1.0) - 1.0) - 1.0
    alpha = -0.18 * triangle
    level = np.array([3000.0, 5500.0, 1800.0, 4200.0])[(t // (2 * period)).astype(int) % 4]
    step = 1.0 - np.exp(-1.0 / (rate * LOAD_LAG))
    load = np.empty_like(level)
    load[0] = level[0]
    for i in range(1, load.size):
        load[i] = load[i - 1] + step * (level[i] - load[i - 1])
    pressure = np.where((t > 50.0) & (t < 85.0), 1.85e5, np.where(t >= 85.0, 2.6e5, 2.2e5))
    return t, alpha, load, pressure


def out_of_round(tire, recording, force=200.0):
    """Return a recording whose side force swings by ``force`` (N) once a turn, at 0.97 of the radius."""
    data = prepare(tire, recording).data
    return recording.assign(
        fy=recording["fy"] + force * np.cos(data.states.distance / (0.97 * data.nominal.radius))
    )


def with_pauses(recording):
    """Return a recording that was stopped three times while the wheel turned on."""
    time = recording["time"].to_numpy()
    shown = np.zeros(time.size, bool)
    for first, last in ((0.0, 31.3), (40.0, 71.7), (84.1, 115.0), (121.9, 150.0)):
        shown |= (time >= first) & (time < last)
    return recording[shown]


EXACT_FAULTS = (
    (lambda r: r.assign(slip_angle=np.degrees(r["slip_angle"])), "unit_error"),
    (lambda r: r.assign(normal_load=r["normal_load"] / 4.4482216), "unit_error"),
    (lambda r: r.assign(fy=r["fy"] / 1000.0), "unit_error"),
    (lambda r: r.assign(pressure=r["pressure"] / 6894.757), "unit_error"),
    (lambda r: r.assign(fy=-r["fy"]), "sign_convention"),
    (lambda r: r.assign(slip_angle=-r["slip_angle"]), "sign_convention"),
    (lambda r: r.assign(fy=r["fy"].where(~r["time"].between(60, 90), r["fy"].iloc[1500])), "stuck_channel"),
    (lambda r: r.assign(fy=np.clip(r["fy"], -3500.0, 3400.0)), "clipping"),
)
"""Faults of a recording that have exact factors or show in a channel alone, and their names."""


def at_its_limit(tire, recording, seed):
    """Return slow sweeps, recorded by a load cell that ends at 1200 N."""
    slow = recording[recording["time"] < 80.0]
    slow = slow.assign(slip_angle=0.15 * np.sin(2.0 * np.pi * slow["time"] / 40.0))
    at = {n: slow[n].to_numpy() for n in ("slip_angle", "normal_load")}
    fy = tire.forces(**at).fy + np.random.default_rng(seed).normal(0.0, 25.0, len(slow))
    return slow.assign(fy=np.clip(fy, -1200.0, 1200.0))
