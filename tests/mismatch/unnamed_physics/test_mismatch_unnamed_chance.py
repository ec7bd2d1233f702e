"""The chance that sweeps gain as much from an equation that does nothing."""

import numpy as np
import pytest

from tire_pipeline.mismatch.unnamed_physics.prove import chance_of_no_gain


def test_a_few_large_gains_do_not_hide_that_all_sweeps_gain():
    gain = np.r_[np.full(20, 0.1), 9.0, 4.0, 6.0, 5.0]
    as_often_lost = gain * np.where(np.arange(gain.size) % 2, -1.0, 1.0)
    assert chance_of_no_gain(gain) < 0.001
    assert chance_of_no_gain(as_often_lost) > 0.1


@pytest.mark.parametrize("size", [5, 12, 40])
def test_where_nothing_gains_the_chance_is_as_often_small_as_it_says(size):
    """Gains with heavy tails, symmetric about zero."""
    rng = np.random.default_rng(size)
    chances = np.array([chance_of_no_gain(rng.standard_t(2, size)) for _ in range(600)])
    assert np.mean(chances < 0.05) <= 0.05 + 3.0 * np.sqrt(0.05 * 0.95 / 600)


def test_few_sweeps_can_prove_something_too():
    """The signs of six sweeps have a chance of 1/64 at least."""
    assert chance_of_no_gain(np.array([1.0, 1.1, 0.9, 1.05, 0.95, 1.0])) < 1e-4
    assert chance_of_no_gain(np.array([1.0])) == 1.0


def test_the_answer_is_the_same_each_time():
    gain = np.random.default_rng(1).standard_normal(30) + 0.3
    assert chance_of_no_gain(gain) == chance_of_no_gain(gain)
