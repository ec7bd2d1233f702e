"""The values that a recording's data are made of: each is built from those before it, and holds by itself."""

from dataclasses import FrozenInstanceError, replace

import numpy as np
import pytest

from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.model.channels import RecordedChannels
from tire_pipeline.mismatch.model.data import Choices, Data
from tire_pipeline.mismatch.model.forces import simulate
from tire_pipeline.mismatch.model.nominal import NominalConditions, Reference, Scales
from tire_pipeline.mismatch.model.simulated import BaseSimulation
from tire_pipeline.mismatch.model.states import States
from tire_pipeline.mismatch.model.wheel import Wheel
from tire_pipeline.mismatch.recording.prepare import prepare


@pytest.fixture
def channels():
    """Two sweeps of 4 s at 50 Hz, a second apart, at a pressure that is recorded with noise."""
    time = np.r_[np.arange(0.0, 4.0, 0.02), np.arange(5.0, 9.0, 0.02)]
    n = time.size
    noise = np.random.default_rng(0).normal(0.0, 500.0, n)
    return RecordedChannels(
        channels={
            "slip_angle": 0.1 * np.sin(1.5 * time),
            "slip_ratio": np.zeros(n),
            "camber": np.zeros(n),
            "normal_load": np.where(time < 4.5, 3000.0, 5000.0),
            "speed": np.full(n, 20.0),
            "pressure": np.where(time < 4.5, 2.0e5, 2.4e5) + noise,
        },
        recorded={"fy": np.zeros(n)},
        time=time,
        start=np.r_[True, np.diff(time) > 0.5],
        present={"slip_angle", "normal_load", "speed", "pressure"},
    )


def test_channels_need_no_tire(channels):
    assert channels.varies("pressure")
    assert not channels.varies("speed")
    assert not channels.varies("camber")
    assert channels.sampling == pytest.approx(0.02)
    left = channels.smooth("pressure") - np.where(channels.time < 4.5, 2.0e5, 2.4e5)
    assert np.std(left) < 0.5 * 500.0
    assert np.abs(left).max() < 2e3  # no mean goes over the pause, across which the pressure steps


def test_nominal_conditions_are_of_the_file_or_of_the_recording_that_was_explained(tire, channels):
    stated = NominalConditions(tire.replace(NOMPRES=2.4e5), channels)
    assert (stated.load, stated.radius, stated.pressure) == (4000.0, 0.32, 2.4e5)
    taken_over = replace(stated, reference=Reference(pressure_nominal=1.8e5, load_range=(2900.0, 3100.0)))
    assert taken_over.pressure == 1.8e5
    load = np.array([3000.0, 9000.0])
    np.testing.assert_allclose(stated.load_excess(load), [-0.25, 1.25])
    np.testing.assert_allclose(taken_over.load_excess(load), [-0.25, 0.0])


def test_the_base_simulation_is_what_the_tire_gives(tire, channels):
    simulation = BaseSimulation(NominalConditions(tire, channels))
    at = {n: channels.get(n) for n in ("slip_angle", "normal_load", "speed")}
    np.testing.assert_array_equal(simulation.base["fy"], tire.forces(**at).fy)
    late = BaseSimulation(NominalConditions(tire, channels), own_relaxation={"slip_angle": 0.6})
    assert np.abs(late.base["fy"] - simulation.base["fy"]).max() > 100.0
    np.testing.assert_array_equal(late.both_forces["fy"], simulation.base["fy"])


def test_states_are_measured_by_the_recording_that_was_explained(tire, channels):
    nominal = NominalConditions(tire, channels)
    own = States(BaseSimulation(nominal))
    assert own.work[-1] == pytest.approx(1.0)
    assert own.distance[-1] == pytest.approx(20.0 * channels.step.sum())
    twice = replace(own.scales, work=2.0 * own.scales.work)
    other = States(BaseSimulation(replace(nominal, reference=Reference(scales=twice))))
    np.testing.assert_allclose(other.work, 0.5 * own.work)
    assert States(BaseSimulation(replace(nominal, recording=replace(channels, time=None)))).scales == Scales()


def test_a_wheel_rolls_on_in_a_pause(tire, channels):
    nominal = NominalConditions(tire, channels)
    assert Wheel(BaseSimulation(nominal)).way[-1] == pytest.approx(
        20.0 * (channels.time[-1] - channels.time[0])
    )
    known = np.arange(channels.size, dtype=float)
    np.testing.assert_array_equal(Wheel(BaseSimulation(nominal), known).way, known)


def test_a_part_takes_over_what_is_integrated_or_nominal(tire, record):
    """As if it were cut out of the simulation of all rows."""
    data = prepare(tire, record()).data
    rows = (np.arange(data.size) // 500) % 3 == 1
    part = data.part(rows)
    for name in ("work", "elapsed", "distance", "power"):
        np.testing.assert_array_equal(getattr(part.states, name), getattr(data.states, name)[rows])
    np.testing.assert_array_equal(part.wheel.way, data.wheel.way[rows])
    assert (part.nominal.pressure, part.states.scales) == (data.nominal.pressure, data.states.scales)
    for name, parameters in (
        ("wear", {"friction": -0.1}),
        ("temperature", {"friction": -0.1, "lag": 20.0}),
        ("inflation_pressure", {"stiffness": 0.4}),
        ("nonuniformity", {"cosine_y": 100.0, "radius": 0.31}),
    ):
        change = [(name, {**catalogue()[name].zeros(data), **parameters})]
        np.testing.assert_allclose(
            simulate(part, change)["fy"], simulate(data, change)["fy"][rows], rtol=1e-12
        )
    again = part.part(np.arange(part.size) < 700)
    np.testing.assert_array_equal(again.states.heat(30.0), part.states.heat(30.0)[:700])


def test_what_a_user_chose_holds_for_a_part_too(tire, record):
    """Long recordings are searched in parts."""
    chosen = Choices({"friction_scale": {"friction": 0.01}})
    data = prepare(tire, record(), chosen).data
    part = data.part(np.arange(data.size) < 1000)
    assert catalogue()["friction_scale"].usual(part, "friction") == (0.0, 0.01)
    assert part.stated_prior("wear", "friction") is None


def test_values_are_frozen(tire, channels):
    data = Data.of(tire, channels)
    for value, name in (
        (data, "choices"),
        (data.nominal, "tire"),
        (data.recording, "time"),
        (data.states, "simulation"),
    ):
        with pytest.raises(FrozenInstanceError):
            setattr(value, name, None)
