"""What a report says of a parameter: its interval lies where the parameter can be, and doubts are said."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.linearised_set import BySweep, Fit
from tire_pipeline.mismatch.report.contents import EffectReport


def fit_of(effect, parameter, value, error, prior=1e3):
    """One parameter; ``prior`` is how wide its prior is."""
    by_sweep = BySweep(np.zeros((1, 1, 1)), np.zeros((1, 1)), np.array([prior**-2]), np.zeros(1))
    return Fit(
        [(effect, {parameter: value})],
        [(parameter,)],
        np.array([[error**2]]),
        [(0, parameter)],
        sweeps=by_sweep,
    )


CASES = [(n, p.name) for n, e in catalogue().items() for p in e.parameters if np.isfinite(p.high - p.low)]


@pytest.mark.parametrize(("effect", "parameter"), CASES)
@pytest.mark.parametrize("error", [1e-6, 0.1, 1e7])
def test_an_interval_holds_the_value_and_ends_within_the_bounds(effect, parameter, error):
    p = catalogue()[effect].parameter(parameter)
    for value in (p.low, 0.5 * (p.low + p.high), p.high):
        ((low, high),) = fit_of(effect, parameter, value, error).intervals
        assert p.low <= low <= value <= high <= p.high


def test_what_moves_by_factors_is_never_negative_and_even_in_its_logarithm():
    ((low, high),) = fit_of("combined_slip", "RBX1", 10.0, 4.0).intervals
    assert low * high == pytest.approx(100.0)
    assert low > 0.5


@pytest.mark.parametrize(("error", "prior", "left"), [(0.1, 1.0, False), (0.6, 1.0, False), (0.8, 1.0, True)])
def test_a_parameter_is_undetermined_where_its_prior_says_more_than_the_recording(error, prior, left):
    """Precisions add up: half the variance of the prior is as much from the recording as from it."""
    assert fit_of("friction_scale", "friction", -0.1, error, prior).undetermined == [left]


REPORT = EffectReport(
    "inflation_pressure", "physics", "", (), 0.98, "fy", {}, [], 0.9, "", "", {"friction": (-0.1, 0.02, "1")}
)


@pytest.mark.parametrize(
    ("ends", "undetermined", "said"),
    [
        ((-0.14, -0.06), (), ""),
        ((-0.2, 0.05), (), "may be 0"),
        ((-0.2, 0.05), ("friction",), "not determined by this recording"),
    ],
)
def test_a_doubt_about_a_parameter_is_said_beside_its_interval(ends, undetermined, said):
    report = replace(REPORT, intervals={"friction": ends}, undetermined=undetermined)
    ((name, value, interval, doubt),) = report.rows()
    assert (name, value, doubt) == ("friction", "-10.0%", said)
    assert interval == f"{100 * ends[0]:.1f}% to {100 * ends[1]:.1f}%"
    assert "±" not in repr(report)
