"""What is handed over where no effect explains a recording: channels, forces and what is left of them."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.unnamed_physics.found import UnnamedPhysics
from tire_pipeline.mismatch.unnamed_physics.language.grammar import evaluate, parse
from tire_pipeline.mismatch.unnamed_physics.language.symbols import NominalValues, table_from
from tire_pipeline.mismatch.unnamed_physics.problems.unexplained import Unexplained

NOMINAL = NominalValues(F0=4000.0, R0=0.31, V0=16.0, P0=2.2e5, T0=45.0)


def physics(text, ranges=None):
    """An equation of the side force."""
    return UnnamedPhysics({"fy": text}, ("speed",), "force", ranges or {"v": (0.8, 1.2)}, NOMINAL)


def table(n=900, seed=0):
    rng = np.random.default_rng(seed)
    time = np.arange(n) * 0.02
    time[n // 2 :] += 5.0
    start = np.zeros(n, bool)
    start[[0, n // 2]] = True
    slip = 0.12 * np.sin(1.3 * time)
    load = 4000.0 + 1500.0 * np.sign(np.sin(0.31 * time))
    channels = {
        "slip_angle": slip,
        "slip_ratio": 0.05 * np.sin(0.9 * time),
        "camber": 0.04 * np.sign(np.sin(0.17 * time)),
        "normal_load": load,
        "speed": 16.0 + 6.0 * np.sin(0.11 * time) + rng.normal(0.0, 0.01, n),
        "pressure": np.full(n, 2.2e5),
        "tread_temperature": 45.0 + 10.0 * np.sin(0.05 * time),
    }
    stiff = 12.0 * load
    forces = {
        "fy": load * np.tanh(12.0 * slip),
        "fx": load * np.tanh(15.0 * channels["slip_ratio"]),
        "fy_slip": stiff / np.cosh(12.0 * slip) ** 2,
        "fx_slip": 15.0 * load,
        "fy_load": load * np.tanh(12.0 * slip),
        "fx_load": load * np.tanh(15.0 * channels["slip_ratio"]),
    }
    return table_from(channels, time, start, forces, NOMINAL), channels, time


def problem(added, seed=1, noise=20.0):
    """What an engine hands over: white noise, and a formula whose gain and offset may be a little off."""
    columns, _, time = table(2400)
    rng = np.random.default_rng(seed)
    fx, fy = columns.columns["fx"], columns.columns["fy"]
    rest = {
        "fx": rng.normal(0.0, noise, fx.size) + 0.001 * fx,
        "fy": rng.normal(0.0, noise, fy.size) - 0.002 * fy + added(columns),
    }
    block = (time // 2.0).astype(int)
    block = np.unique(block, return_inverse=True)[1]
    nuisance = {o: np.column_stack([f, np.full(f.size, 40.0)]) / noise for o, f in (("fx", fx), ("fy", fy))}
    return Unexplained(
        table=columns,
        nominal=NOMINAL,
        moves=frozenset("slip_angle slip_ratio camber normal_load speed tread_temperature time".split()),
        rest=rest,
        largest={"fx": 3000.0, "fy": 5000.0},
        block=block,
        order=np.argsort(block, kind="stable"),
        whiten=lambda o, x: x[np.argsort(block, kind="stable")] / noise,
        nuisance=nuisance,
        sizes=[{o: np.full(2, 0.01) for o in rest}],
        inflation=1.0,
    )


def by_speed(columns):
    """A side force that falls with the square of the speed, N."""
    return -0.05 * columns.columns["fy"] * columns.columns["v"] ** 2


def by_memory(columns):
    """A side force that follows the slip of the last seconds, N."""
    return -0.3 * columns.columns["fy"] * evaluate(parse("lag(abs(s), 2) - abs(s)"), columns)


def nothing(columns):
    """No force, N."""
    return np.zeros(columns.size)


def jolt(columns):
    """900 N in one sweep, and never again."""
    out = np.zeros(columns.size)
    out[300:360] = 900.0
    return out


def swinging(recording, share):
    """The recording, with forces that swing by a share with the turns of a drum of 0.85 m."""
    step = np.diff(recording["time"], prepend=recording["time"].iloc[0])
    swing = 1.0 + share * np.sin(np.cumsum(step * recording["speed"]) / 0.85)
    return recording.assign(fy=recording["fy"] * swing)
