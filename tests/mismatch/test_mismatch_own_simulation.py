"""A user's first trial: the tool against his own simulation of a file, exact or with one known change."""

import numpy as np
import pandas as pd
import pytest
from weighed import beside, named

from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.effects.shared import first_order, own_relaxation
from tire_pipeline.mismatch.recording.prepare import prepare

LAGS = ("relaxation_length", "time_delay", "low_pass", "friction_scale", "stiffness_scale")


def simulated(tire, *, noise=0.0, steady=False, **scaled):
    """Slip sweeps at three loads, simulated by a file with scale factors that its reader does not know."""
    t = 0.02 * np.arange(3000)
    inputs = {
        "slip_angle": 0.2 * np.sin(2.0 * np.pi * t / 4.0),
        "normal_load": np.repeat([2000.0, 4000.0, 5600.0], 1000),
    }
    fy = tire.replace(**scaled).forces(**inputs).fy + noise * np.random.default_rng(0).standard_normal(t.size)
    recording = pd.DataFrame({"time": t, **inputs, "fy": fy})
    return recording.drop(columns="time").iloc[::50] if steady else recording


@pytest.mark.slow
@pytest.mark.parametrize("steady", [False, True])
@pytest.mark.parametrize("noise", [0.0, pytest.param(1.0, marks=pytest.mark.ci)])
def test_a_simulation_of_the_file_itself_agrees(tire, noise, steady):
    """It ended in a LinAlgError, or was *unexplained*: an error below the usual spoke for the unnamed."""
    report = explain_mismatch(tire, simulated(tire, noise=noise, steady=steady))
    assert report.verdict == "agrees"
    assert report.fit["fy"].rms_before == pytest.approx(noise, rel=0.1, abs=1e-6)


@pytest.mark.slow
@beside("force_offset", "friction_scale", "stiffness_scale", "force_gain", "plysteer_conicity")
def test_one_change_of_an_exact_simulation_has_its_name(tire, without):
    """What is left beside it is rounding, which counted as one long error."""
    recording = simulated(tire)
    assert named(tire, recording.assign(fy=recording["fy"] + 80.0), without) == ["force_offset"]
    assert named(tire, simulated(tire, LMUY=1.08), without) == ["friction_scale"]


def a_drive(tire, late=0.0, noise=20.0):
    """A slalom at changing speed; the forces follow slip after a distance, m, or at once."""
    t = 0.02 * np.arange(3000)
    slip = 0.08 * np.sin(2.0 * np.pi * t / 3.0) * np.sin(0.13 * t)
    load, speed = 4000.0 * (1.0 + 0.3 * np.sin(0.5 * t)), 15.0 + 8.0 * np.sin(0.05 * t)
    followed = first_order(slip, speed * 0.02 / late, t == 0.0) if late else slip
    fy = tire.forces(slip_angle=followed, normal_load=load).fy
    fy = fy + noise * np.random.default_rng(0).standard_normal(t.size)
    return pd.DataFrame({"time": t, "slip_angle": slip, "normal_load": load, "speed": speed, "fy": fy})


@pytest.fixture(scope="module")
def relaxing(tire):
    """A file that states a relaxation length, as most do."""
    return tire.replace(PTY1=1.5, PTY2=1.7)


@pytest.mark.slow
@beside(*LAGS)
def test_a_simulation_without_the_relaxation_that_its_file_states_agrees(relaxing, without):
    """It was *explained: relaxation length, which the model leaves out*, with 1.00."""
    recording = a_drive(relaxing)
    report = explain_mismatch(relaxing, recording, without=without)
    assert report.verdict == "agrees"
    assert any("without the relaxation that the file states" in note for note in report.notes)
    assert "tire.forces lacks" not in report.summary
    assert not report.corrected.reference.relaxes


@pytest.mark.slow
@beside(*LAGS)
def test_forces_that_relax_as_their_file_states_agree_and_the_error_is_told_both_ways(relaxing, without):
    """The noise was said to be as large as the lag makes the error of tire.forces."""
    late = own_relaxation(relaxing)["slip_angle"]
    report = explain_mismatch(relaxing, a_drive(relaxing, late), without=without)
    assert report.verdict == "agrees"
    fit = report.fit["fy"]
    assert fit.rms_before > 2.0 * fit.noise_floor
    assert fit.noise_floor == pytest.approx(20.0, rel=0.1)
    assert (
        f"tire.forces lacks the relaxation that the file states ({late:.2g} m of slip_angle)"
        in report.summary
    )
    assert report.corrected.reference.relaxes


@pytest.mark.parametrize("late", [0.0, 0.1, 1.2])
def test_the_lag_of_the_file_is_taken_where_it_is_the_better_one(relaxing, late):
    """0.1 m is nearer to none than to the 0.42 m of the file."""
    data = prepare(relaxing, a_drive(relaxing, late)).data
    assert (data.simulation.own_relaxation is not None) == (late > 0.5)


@pytest.mark.slow
@pytest.mark.parametrize(
    "seed", [0, pytest.param(1, marks=pytest.mark.ci), pytest.param(2, marks=pytest.mark.long)]
)
def test_noise_of_small_forces_is_noise(tire, seed):
    """It was *undecided*: 3% of the largest force is more than a formula leaves, but it is white."""
    drive = a_drive(tire, noise=0.0).drop(columns="fy")
    drive["slip_angle"] *= 0.2
    fy = tire.forces(slip_angle=drive["slip_angle"], normal_load=drive["normal_load"]).fy
    noise = 0.03 * np.abs(fy).max() * np.random.default_rng(seed).standard_normal(len(drive))
    assert explain_mismatch(tire, drive.assign(fy=fy + noise)).verdict == "agrees"
