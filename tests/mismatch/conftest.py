"""A small rig: a tire model with a structured misfit, and channels with noise."""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import pytest
from mismatch_shared import shared

from tire_pipeline.magic_formula import TireModel

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


def rig_force(tire, alpha, load, friction=1.0, stiffness=1.0):
    """The tire's force with another friction and stiffness, and the misfit that fitted models have."""
    plain = tire.forces(slip_angle=alpha * stiffness / friction, normal_load=load).fy * friction
    wave = np.sin(5.0 * np.arctan(alpha / 0.06)) * np.cos(2.0 * load / 4000.0)
    return plain + 0.006 * load * wave * np.abs(alpha) / (np.abs(alpha) + 0.03)


def schedule(seconds=150.0, rate=50.0):
    t = np.arange(0.0, seconds, 1.0 / rate)
    period = 7.5
    triangle = 2.0 * np.abs(2.0 * ((t / period + 0.25) % 1.0) - 1.0) - 1.0
    alpha = -0.18 * triangle
    level = np.array([3000.0, 5500.0, 1800.0, 4200.0])[(t // (2 * period)).astype(int) % 4]
    load = np.empty_like(level)
    load[0] = level[0]
    for i in range(1, load.size):
        load[i] = load[i - 1] + 0.08 * (level[i] - load[i - 1])
    pressure = np.where((t > 50.0) & (t < 85.0), 1.85e5, np.where(t >= 85.0, 2.6e5, 2.2e5))
    return t, alpha, load, pressure


@pytest.fixture(scope="session")
def tire() -> TireModel:
    return TireModel.from_coefficients(COEFFICIENTS, version="5.2")


@pytest.fixture(scope="session")
def record(tire):
    """Return a function that records the rig: ``record(friction=array or number, ...)``."""

    def run(seed=0, friction=1.0, stiffness=1.0, pressure_effect=0.0, offset=0.0, delay=0.0, noise=25.0):
        rng = np.random.default_rng(seed)
        t, alpha, load, pressure = schedule()
        d = (pressure - 2.2e5) / 2.2e5
        fy = rig_force(tire, alpha, load, friction * (1.0 + pressure_effect * d), stiffness)
        if delay:
            fy = np.interp(t - delay, t, fy)
        n = t.size
        return pd.DataFrame(
            {
                "time": t,
                "slip_angle": alpha + 1e-4 * rng.standard_normal(n),
                "normal_load": load + 8.0 * rng.standard_normal(n),
                "speed": 16.7 + 0.02 * rng.standard_normal(n),
                "pressure": pressure + 300.0 * rng.standard_normal(n),
                "fy": fy + offset + noise * rng.standard_normal(n),
            }
        )

    return run


@pytest.fixture(scope="session")
def examples():
    folder = shared("recordings/concealed_examples")
    return folder, json.loads((folder / "labels.json").read_text())
