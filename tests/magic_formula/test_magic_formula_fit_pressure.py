"""Pressures that cannot determine what changes with pressure: the ripple of one, and each at its own load."""

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.magic_formula.fitting import fit_magic_formula
from tire_pipeline.magic_formula.fitting.setup.coverage import (
    ONE_PRESSURE,
    PRESSURE_WITH_LOAD,
    open_coefficients,
)

pytestmark = pytest.mark.slow

BY_PRESSURE = ("PPY1", "PPY2", "PPY3")
TIRE = TireModel.from_coefficients(
    {"FNOMIN": 4000, "UNLOADED_RADIUS": 0.3, "PCY1": 1.3, "PDY1": 1, "PKY1": -20, "PKY2": 2}, "6.1"
)


def told(pressure, load=4000.0, camber=0.0):
    pressure = np.asarray(pressure, dtype=float)
    zero = np.zeros(pressure.size)
    points = {name: zero for name in ("slip_angle", "slip_ratio", "speed")}
    points |= {"pressure": pressure, "normal_load": zero + load, "camber": zero + camber}
    return open_coefficients(BY_PRESSURE, points, 4000.0)


@pytest.mark.parametrize("spread", [0.0, 0.01, 0.02, 0.03])
def test_a_ripple_however_large_is_one_pressure(spread):
    t, rng = np.linspace(0.0, 60.0, 2000), np.random.default_rng(0)
    for shape in (np.sin(t), rng.standard_normal(t.size), 2.0 * t / t[-1] - 1.0):
        assert ONE_PRESSURE in told(200e3 * (1.0 + spread * shape)), spread


@pytest.mark.parametrize("levels", [(200e3, 220e3), (200e3, 210e3, 222e3), (150e3, 250e3)])
def test_set_pressures_differ(levels):
    rng = np.random.default_rng(0)
    pressure = np.repeat(levels, 500) * (1.0 + 0.005 * rng.standard_normal(500 * len(levels)))
    assert told(pressure) == {}


def test_a_pressure_that_changes_widely_differs_without_levels():
    assert told(np.linspace(180e3, 230e3, 500)) == {}


@pytest.mark.parametrize("what", ["load", "camber"])
def test_pressures_at_loads_or_cambers_of_their_own_tell_nothing(what):
    pressure = np.repeat([180e3, 220e3], 300)
    other = {"load": np.repeat([2000.0, 5000.0], 300), "camber": np.repeat([0.0, 0.05], 300)}[what]
    assert list(told(pressure, **{what: other})) == [PRESSURE_WITH_LOAD]
    assert told(np.tile(pressure, 2), **{what: np.r_[other, other[::-1]]}) == {}


def rippling() -> pd.DataFrame:
    """Sweeps at three loads and one pressure, whose ripple goes with a change of the force by 2%."""
    rng = np.random.default_rng(3)
    angle = np.tile(0.18 * np.sin(np.linspace(0.0, 4.0 * np.pi, 160)), 3)
    load = np.repeat([2000.0, 4000.0, 6000.0], 160)
    slow = np.sin(np.linspace(0.0, 40.0, angle.size))
    fy = TIRE.forces(slip_angle=angle, normal_load=load, limits="ignore").fy
    fy = fy * (1.0 + 0.02 * slow) + 80.0 * rng.standard_normal(angle.size)
    pressure = 200e3 * (1.0 + 0.015 * slow)
    return pd.DataFrame({"slip_angle": angle, "normal_load": load, "pressure": pressure, "fy": fy})


def test_a_ripple_that_helps_the_fit_moves_the_force_at_another_pressure_little():
    """The least would have PPY3 = 1.3, with 20% less force at a pressure 15% lower."""
    rows = rippling()
    fit = fit_magic_formula(rows, "6.1", starts=2)
    at = {"slip_angle": np.linspace(-0.18, 0.18, 31), "normal_load": 4000.0, "limits": "ignore"}
    here, there = (fit.model.forces(pressure=p, **at).fy for p in (200e3, 170e3))
    assert 0.02 < np.abs(here - there).max() / np.abs(here).max() < 0.16
    freed = TIRE.replace(NOMPRES=200e3, PPY3=0.02 / 0.015)
    points = {name: rows[name].to_numpy() for name in ("slip_angle", "normal_load", "pressure")}
    left = [np.std(m.forces(**points, limits="ignore").fy - rows["fy"]) for m in (fit.model, freed)]
    assert left[0] < 1.05 * left[1]
    said = [text for text in fit.undetermined if text.startswith(ONE_PRESSURE)]
    assert len(said) == 1
    assert "a fit without the column pressure keeps typical values" in said[0]


def test_without_the_column_the_coefficients_of_pressure_are_typical():
    fit = fit_magic_formula(rippling().drop(columns="pressure"), "6.1", starts=2)
    assert all(fit.model.value(name) == 0.0 for name in BY_PRESSURE)
