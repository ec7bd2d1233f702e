"""The true bias between organisations, on tires whose bias is put in by hand."""

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.evaluation.bias_truth import bias_beside_truth, measured_bias, regime_differences

LOADS = np.array([2000.0, 4000.0])
BASE = {"FNOMIN": 4000.0, "UNLOADED_RADIUS": 0.32, "PCY1": 1.4, "PDY1": 1.0, "PDY2": -0.1}
BASE |= {"PEY1": -0.5, "PKY1": -20.0, "PKY2": 1.8} | dict.fromkeys(
    ["PEY2", "PHY1", "PHY2", "PVY1", "PVY2"], 0.0
)


def sealed(stiffness: float, friction: float) -> pd.DataFrame:
    """Three tires, measured by A as they are and by B with other stiffness and friction."""
    rows = []
    for number, own in enumerate((0.9, 1.0, 1.2)):
        for organisation, k, mu in (("A", 1.0, 1.0), ("B", stiffness, friction)):
            tire = {**BASE, "PKY1": BASE["PKY1"] * own * k, "PDY1": own * mu, "PDY2": BASE["PDY2"] * own * mu}
            rows.append(
                {
                    "file": f"hidden/{organisation}/{number}.tir",
                    "category": organisation,
                    "version": "5.2",
                    **tire,
                }
            )
    return pd.DataFrame(rows)


def test_the_bias_put_in_comes_out():
    bias = measured_bias(sealed(1.10, 0.95), LOADS).set_index("region")
    assert set(bias["organisation"]) == {"B"}
    assert set(bias["reference"]) == {"A"}
    assert len(bias) == 4
    for load in ("2000 N", "4000 N"):
        assert bias.loc[f"cornering stiffness, {load}", "true_bias"] == pytest.approx(0.10, abs=1e-6)
        assert bias.loc[f"friction level, {load}", "true_bias"] == pytest.approx(-0.05, abs=1e-3)
    np.testing.assert_allclose(bias["true_error"], 0.0, atol=1e-3)


def test_reported_intervals_hold_the_truth_or_do_not():
    reported = pd.DataFrame(
        {
            "organisation": "B",
            "reference": "A",
            "output": ["lateral", "lateral", "longitudinal"],
            "region": ["cornering stiffness, 2000 N", "friction level, 2000 N", "friction level, 2000 N"],
            "low": [0.05, -0.03, -0.9],
            "high": [0.15, 0.03, 0.9],
        }
    )
    both = bias_beside_truth(reported, measured_bias(sealed(1.10, 0.95), LOADS))
    assert both[["region", "inside"]].to_numpy().tolist() == [
        ["cornering stiffness, 2000 N", True],
        ["friction level, 2000 N", False],
    ]


def test_what_two_protocols_do_differently():
    regimes = {"A/old": {"speed": 16.7, "preheat": 68.0}, "B/old": {"speed": 16.7, "preheat": 52.0}}
    table = regime_differences(regimes, "B", "A")
    assert table.to_dict("records") == [{"field": "preheat", "B": 52.0, "A": 68.0}]
