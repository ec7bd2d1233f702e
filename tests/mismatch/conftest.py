"""A small rig: a tire model with a structured misfit, and channels with noise."""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import pytest
from mismatch_shared import shared
from small_rig import COEFFICIENTS, rig_force, schedule

from tire_pipeline.magic_formula import TireModel


@pytest.fixture(scope="session")
def tire() -> TireModel:
    return TireModel.from_coefficients(COEFFICIENTS, version="5.2")


@pytest.fixture(scope="session")
def braked(tire) -> TireModel:
    """The same tire with a longitudinal force, too."""
    return tire.replace(PCX1=1.6, PDX1=1.1, PEX1=0.1, PKX1=22.0, PKX3=0.2)


@pytest.fixture(scope="session")
def record(tire):
    """Return a function that records the rig: ``record(friction=array or number, ...)``."""

    def run(
        seed=0, friction=1.0, stiffness=1.0, pressure_effect=0.0, offset=0.0, delay=0.0, noise=25.0, rate=25.0
    ):
        rng = np.random.default_rng(seed)
        t, alpha, load, pressure = schedule(rate=rate)
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


@pytest.fixture(params=[range(2), pytest.param(range(2, 8), marks=pytest.mark.ci)], ids=["two", "six more"])
def draws(request):
    """Seeds of the noise: what is found before any explanation has to be found in each."""
    return request.param


@pytest.fixture(scope="session")
def examples():
    folder = shared("recordings/concealed_examples")
    return folder, json.loads((folder / "labels.json").read_text())
