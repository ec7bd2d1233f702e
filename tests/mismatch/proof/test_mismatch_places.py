"""Where a recording leaves the model: the place named first is the largest that is sure."""

import numpy as np
import pandas as pd
import pytest
from mismatch_rates import flat_belt, free_drive, second_session

from tire_pipeline.mismatch.discrepancy.noise import estimate_noise
from tire_pipeline.mismatch.model.blocks import sweeps
from tire_pipeline.mismatch.proof.locate import everywhere, locate
from tire_pipeline.mismatch.proof.measured import Remainder
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.mismatch.report.sentences import head


def located(tire, recording):
    """Places, what is off throughout, and what the report says of it."""
    data = prepare(tire, recording).data
    rest = {o: data.recorded[o] - data.base[o] for o in data.outputs}
    found = locate(data, rest, estimate_noise(data, rest), sweeps(data))
    even = everywhere(data, rest, found)
    nothing = Remainder(size={}, located=[], form="", significant=False)
    said = head("unexplained", [], {}, found, nothing, "", {}, even).text
    return found, even, said.partition(". ")[2]


@pytest.mark.parametrize("gain", [0.85, 1.1, 1.3])
def test_a_gain_of_a_real_force_is_everywhere(gain):
    """It was "between 45 and 90 s, at load above 4.23 kN"."""
    tire, given, _ = flat_belt(20)
    _, even, said = located(tire, given.assign(fy=gain * given["fy"]))
    assert even["fy"] == pytest.approx(gain - 1.0, abs=0.03)
    assert "throughout" in said
    assert " s," not in said


def test_what_is_in_one_stretch_is_not_everywhere():
    tire, given, _ = flat_belt(20)
    late = given["time"] > given["time"].quantile(0.7)
    found, even, said = located(tire, given.assign(fy=given["fy"] * np.where(late, 1.2, 1.0)))
    assert even == {}
    assert "throughout" not in said
    (time,) = (f for f in found if f.axis == "time" and f.along_force)
    assert time.low >= given["time"].quantile(0.5)


def real_mismatches():
    """Real recordings that their models do not fit, and known faults in one that fits."""
    yield flat_belt(20, "camber pressure")[:2]
    yield second_session(20, 0)[:2]
    yield free_drive(20)[:2]
    tire, given, _ = flat_belt(20)
    yield tire, given.assign(fy=given["fy"] + 300.0)
    yield tire, given.assign(slip_angle=given["slip_angle"] + 0.02)


def test_the_first_place_is_the_largest_that_is_sure_and_no_share_is_of_next_to_nothing():
    """A row said "-241% of the force"."""
    for tire, recording in real_mismatches():
        found, _, _ = located(tire, recording)
        assert found
        sizes = [abs(f.mean) for f in found]
        assert sizes == sorted(sizes, reverse=True)
        assert all(f.p_value <= 0.05 for f in found)
        assert max(abs(f.share) for f in found if np.isfinite(f.share)) < 1.0, found


@pytest.mark.parametrize("seed", range(3))
def test_combined_slip_is_located_in_slip_ratio_and_not_in_what_came_along(tire, seed):
    """The tread warmed while the rig braked: the tread temperature was the place."""
    model = tire.replace(PCX1=1.6, PDX1=1.1, PEX1=0.1, PKX1=22.0, PKX3=0.2)
    full = model.replace(RBY1=9.0, RBY2=7.0, RCY1=1.05)
    rng = np.random.default_rng(seed)
    t = np.arange(0.0, 120.0, 0.05)
    braking = (t // 10.0) % 2 == 1
    slip = {
        "slip_angle": np.where(braking, 0.07 * np.sign(np.sin(t / 20.0)), 0.15 * np.sin(0.84 * t)),
        "slip_ratio": np.where(braking, -0.06 * (1.0 - np.cos(2.0 * np.pi * t / 5.0)), 0.0),
        "normal_load": np.array([3000.0, 4500.0])[(t // 40.0).astype(int) % 2],
    }
    warm = np.convolve(np.where(braking, 60.0, 30.0), np.full(100, 0.01), "same")
    forces = full.forces(**slip)
    recording = pd.DataFrame({"time": t, **slip, "tread_temperature": warm, "speed": 16.7})
    noise = rng.normal(0.0, 20.0, (2, t.size))
    found, even, said = located(model, recording.assign(fx=forces.fx + noise[0], fy=forces.fy + noise[1]))
    lateral = [f for f in found if f.output == "fy" and f.along_force]
    assert lateral[0].axis == "slip_ratio"
    assert even == {}
    assert said.lower().startswith("at slip ratio")
    assert "temperature" not in said
