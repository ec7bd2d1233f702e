"""What a verdict says has the right direction: who measures more, where, and how far a tire is."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
from one_tire import TIRE

from tire_pipeline.translation.curves.features import LOADS, encode
from tire_pipeline.translation.judge.bias_band import NEGLIGIBLE, BiasBand
from tire_pipeline.translation.judge.reach import beyond_judged_loads
from tire_pipeline.translation.judge.words import describe_bias


def said(**changed: float) -> str:
    """What is said of a tire as its source measures it, and as the target does."""
    before, after = (encode(pd.DataFrame([{**TIRE, **more}])) for more in ({}, changed))
    return describe_bias(before, after, np.ones((1, 4), dtype=bool), np.array(["A"]), "D")[0]


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"PKY1": 1.1 * TIRE["PKY1"]}, "D measures 10.0% more cornering stiffness than A ("),
        ({"PKY1": 0.9 * TIRE["PKY1"]}, "D measures 10.0% less cornering stiffness than A ("),
        ({"PKX1": 1.1 * TIRE["PKX1"], "PKX2": 1.1 * TIRE["PKX2"]}, "D measures 10.0% more slip stiffness"),
        ({"PKY2": 2.2}, "less cornering stiffness than A, most at low load ("),
        ({"PKY2": 1.5}, "more cornering stiffness than A, most at low load ("),
        ({"PDY2": -0.3}, "more lateral grip than A, most at low load ("),
        ({"PDY1": 1.2, "PDY2": 0.05}, "more lateral grip than A, most at high load ("),
        ({"PDX1": 0.9, "PDX2": -0.3}, "less longitudinal grip than A, most at high load ("),
        ({"PVY1": 0.03}, "of the grip more residual side force"),
        ({"PVY1": 0.0, "PHY1": 0.0, "PHY2": 0.0, "PVY2": 0.0}, "of the grip less residual side force"),
        ({"QDZ1": 0.13}, "more aligning torque"),
        ({"QDZ1": 0.09}, "less aligning torque"),
        ({"PVY3": -0.2}, "more camber thrust"),
        ({"PVY3": -0.05}, "less camber thrust"),
    ],
)
def test_who_measures_more_and_where(changed: dict[str, float], words: str):
    assert words in said(**changed)


def test_nothing_is_said_of_the_same():
    assert said() == ""


@pytest.mark.parametrize(
    ("low", "high", "zero", "negligible"),
    [
        (-0.01, 0.02, True, True),
        (-NEGLIGIBLE, NEGLIGIBLE, True, True),
        (-0.08, 0.01, True, False),
        (-0.01, 0.08, True, False),
        (0.01, 0.02, False, False),
        (-0.02, -0.01, False, False),
    ],
)
def test_a_bias_is_negligible_if_its_band_holds_zero_and_little_to_either_side(low, high, zero, negligible):
    """Of each part: one that is not decides."""
    ends = [np.array([[0.0, 0.0, 0.0, 0.0], [0.0, end, 0.0, 0.0]]) for end in (low, high)]
    band = BiasBand(*ends)
    assert band.contains_zero.tolist() == [True, zero]
    assert band.negligible.tolist() == [True, negligible]
    assert f"lateral friction {low:+.1%} to {high:+.1%}" in band.in_words(1)


def test_loads_below_and_above_those_compared_are_outside_by_their_ratio():
    loads = np.array([LOADS.min() / 4.0, LOADS.min(), 5000.0, LOADS.max(), 2.5 * LOADS.max()])
    assert beyond_judged_loads(loads) == pytest.approx([4.0, 1.0, 0.625, 1.0, 2.5])
