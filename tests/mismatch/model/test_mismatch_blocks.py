"""Sweeps to one side, and whole ones."""

import numpy as np
import pytest

from tire_pipeline.mismatch.model.blocks import whole_sweeps


@pytest.mark.parametrize(
    ("sides", "whole"),
    [
        ([0, 0, 1, 1, 2, 3, 3], [0, 0, 0, 0, 1, 1, 1]),
        ([0, 1, 2, 3, 4], [0, 0, 1, 1, 2]),
        ([0, 1, 2], [0, 1, 2]),
        ([0, 0], [0, 0]),
    ],
)
def test_both_sides_of_a_sweep_are_one_unless_there_are_fewer_than_two(sides, whole):
    np.testing.assert_array_equal(whole_sweeps(np.array(sides)), whole)
