"""Where a recording leaves the model: the place named first is the largest that is sure."""

import numpy as np
import pytest
from located_mismatch import located
from real_at_rates import flat_belt, free_drive, second_session


@pytest.mark.parametrize("gain", [0.85, 1.1, 1.3])
def test_a_gain_of_a_real_force_is_everywhere(gain):
    """It was "between 45 and 90 s, at load above 4.23 kN"."""
    tire, given, _ = flat_belt(20)
    _, even, said = located(tire, given.assign(fy=gain * given["fy"]))
    assert even["fy"].share == pytest.approx(gain - 1.0, abs=0.03)
    assert "throughout" in said
    assert " s," not in said


@pytest.mark.parametrize("offset", [-300.0, 150.0])
def test_an_offset_of_a_real_force_is_everywhere(offset):
    """It was "at slip angle between -4.97 and -3.72 deg"."""
    tire, given, _ = flat_belt(20)
    _, even, said = located(tire, given.assign(fy=given["fy"] + offset))
    assert not np.isfinite(even["fy"].share)
    assert even["fy"].mean == pytest.approx(offset, abs=30.0)
    assert f"Fy differs from the model by {even['fy'].mean:+,.3g} N throughout" in said
    assert "deg" not in said


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
