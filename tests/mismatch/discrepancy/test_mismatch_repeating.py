"""What repeats every so many metres, and is no turn of the wheel."""

import numpy as np
import pytest

from tire_pipeline.mismatch.discrepancy.repeating import strongest_length
from tire_pipeline.mismatch.recording.prepare import prepare


def _seam(data, length):
    """Narrow pulses, one every so many metres."""
    return np.exp(-0.5 * (((data.states.distance / length) % 1.0 - 0.5) / 0.06) ** 2)


@pytest.mark.parametrize("length", [4.3, 6.7, 9.1])
def test_what_repeats_every_so_many_metres_is_found_with_its_length(tire, record, length):
    data = prepare(tire, record(5, rate=50.0)).data
    noise = np.random.default_rng(5).normal(0.0, 1.0, data.size)
    assert strongest_length(data, _seam(data, length) + 0.5 * noise) == pytest.approx(length, rel=1e-3)


def test_what_the_wheel_does_once_a_turn_does_not_repeat_at_twice_its_length(tire, record):
    data = prepare(tire, record(5, rate=50.0)).data
    noise = np.random.default_rng(5).normal(0.0, 1.0, data.size)
    turn = 2.0 * np.pi * 0.97 * data.nominal.radius
    found = strongest_length(data, 20.0 * np.cos(2.0 * np.pi * data.states.distance / turn) + noise)
    assert abs(found / (2.0 * turn) - 1.0) > 5e-3


def test_a_short_way_says_nothing_about_what_repeats(tire, record):
    data = prepare(tire, record(5, rate=50.0).iloc[:600]).data
    assert strongest_length(data, _seam(data, 6.7)) is None
