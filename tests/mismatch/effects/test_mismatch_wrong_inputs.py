"""Channels that the model is driven by and that read wrong: each has a name of its own."""

import numpy as np
import pytest
from brake_rig import brake_sweeps, weighted
from weighed import beside, named

from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.model.forces import simulate
from tire_pipeline.mismatch.recording.prepare import prepare

WRONG = {
    "load_gain": {"gain": 0.07},
    "load_offset": {"offset": -150.0},
    "slip_ratio_offset": {"offset": 0.004},
    "slip_angle_offset": {"offset": 0.003},
}


@pytest.fixture(scope="module")
def as_it_was(braked):
    """A file, brake sweeps that it gives, and these as they are prepared."""
    file = weighted(braked)
    recording = brake_sweeps(file, (-3.0, 5.0))
    return file, recording, prepare(file, recording).data


@pytest.mark.parametrize("name", WRONG)
def test_an_effect_takes_back_what_its_channel_reads_wrong(as_it_was, name):
    """The model at the misread channel, with the effect, gives the forces at the true one."""
    file, recording, truth = as_it_was
    effect = catalogue()[name]
    true = recording[effect.wrong_channel].to_numpy()
    misread = recording.assign(**{effect.wrong_channel: effect.misread(true, WRONG[name])})
    data = prepare(file, misread).data
    found = simulate(data, [(name, {**effect.zeros(data), **WRONG[name]})])
    for output, force in truth.simulation.base.items():
        largest = np.abs(force).max()
        assert np.abs(data.simulation.base[output] - force).max() > 1e-3 * largest
        np.testing.assert_allclose(found[output], force, atol=1e-6 * largest)


@pytest.mark.slow
@pytest.mark.parametrize("offset", [0.004, pytest.param(-0.008, marks=pytest.mark.long)])
@beside("slip_ratio_offset", "crosstalk", "force_offset", "force_gain", "rolling_resistance")
def test_an_offset_of_the_slip_ratio_is_no_crosstalk(braked, offset, without):
    """A rolling radius that is wrong by half a percent was crosstalk with a probability of 1.00."""
    file = weighted(braked)
    run = brake_sweeps(file, (-3.0, 0.0, 5.0))
    report = explain_mismatch(file, run.assign(slip_ratio=run["slip_ratio"] + offset), without=without)
    assert [effect.name for effect in report.effects] == ["slip_ratio_offset"]
    assert report.effects[0].parameters["offset"][0] == pytest.approx(offset, rel=0.15)


@pytest.mark.slow
@pytest.mark.parametrize("offset", [400.0, pytest.param(-400.0, marks=pytest.mark.ci)])
@beside("load_offset", "load_gain", "force_offset", "force_gain", "crosstalk", "load_sensitivity")
def test_an_offset_of_the_load_has_its_name(braked, offset, without):
    file = weighted(braked)
    run = brake_sweeps(file, (-3.0, 0.0, 5.0))
    names = named(file, run.assign(normal_load=run["normal_load"] + offset), without)
    assert names == ["load_offset"]


def test_a_load_offset_is_not_looked_for_at_one_load(braked):
    file = weighted(braked)
    recording = brake_sweeps(file, (0.0, 5.0)).assign(normal_load=4000.0)
    data = prepare(file, recording).data
    assert catalogue()["load_offset"].absent(data) == "normal_load does not vary"
    assert catalogue()["load_gain"].absent(data) is None


@pytest.mark.slow
def test_rolling_resistance_is_not_only_crosstalk(braked):
    """It is physics that files leave to My: a leak of the load was named, a fault of the recording, alone."""
    file = weighted(braked)
    run = brake_sweeps(file, (-3.0, 0.0, 5.0))
    explained = explain_mismatch(file, run.assign(fx=run["fx"] - 0.02 * run["normal_load"]))
    assert "rolling_resistance" in {name for names, _ in explained.sets for name in names}


@pytest.mark.slow
@beside("compliance", "plysteer_conicity", "slip_angle_offset", "crosstalk", "load_gain")
def test_a_wheel_that_the_load_turns_is_compliance(braked, without):
    """It was a conicity and an offset of the slip angle, each with a probability above 0.98."""
    file = weighted(braked)
    run = brake_sweeps(file, (-3.0, 0.0, 5.0))
    turned = run["slip_angle"] + 0.005 * (run["normal_load"] / file.coefficients["FNOMIN"] - 1.0)
    assert named(file, run.assign(slip_angle=turned), without) == ["compliance"]


@pytest.mark.slow
def test_a_drift_of_the_load_is_a_drift(braked):
    file = weighted(braked)
    run = brake_sweeps(file, (-3.0, 0.0, 5.0))
    drifting = run["normal_load"] + 400.0 * run["time"] / run["time"].iloc[-1]
    assert named(file, run.assign(normal_load=drifting)) == ["sensor_drift"]


def test_at_one_load_a_leak_of_the_load_stands_beside_an_offset(tire, record):
    """Both are one constant force there; an offset alone had 1.00."""
    recording = record(3)
    recording = recording[recording["time"] < 15.0]
    leaking = recording.assign(fy=recording["fy"] + 0.05 * recording["normal_load"])
    (names,) = [names for names, _ in explain_mismatch(tire, leaking).sets]
    assert {"force_offset", "crosstalk"} <= set(names)


@beside("friction_scale", "stiffness_scale")
def test_a_slip_that_reads_a_tenth_is_no_unit_of_the_force(tire, record, without):
    """A tenth of the slip made Fy look 4.4 times too large, as pounds that were taken for newtons do."""
    recording = record(3)
    misread = recording.assign(slip_angle=0.1 * recording["slip_angle"])
    report = explain_mismatch(tire, misread, without=without)
    assert report.verdict == "unusable"
    assert not report.sets
