"""What stands beside an equation of unnamed physics: drivers with evidence, alternatives, intervals."""

from dataclasses import replace

import numpy as np
import pytest
from unnamed_problem import by_memory, by_speed, problem

from tire_pipeline.mismatch.unnamed_physics.found import from_sidecar
from tire_pipeline.mismatch.unnamed_physics.language.grammar import EquationError, evaluate, parse
from tire_pipeline.mismatch.unnamed_physics.problems.unexplained import of_force
from tire_pipeline.mismatch.unnamed_physics.search import find

NOISE = 5.0


@pytest.fixture(scope="module")
def of_speed():
    return find(problem(by_speed, noise=NOISE))


@pytest.fixture(scope="module")
def of_each_force():
    """Three causes of fx, which take up the common equation, and one of fy: each force has its own."""
    seen = problem(by_speed, noise=NOISE)
    x = seen.table.columns
    more = 0.3 * x["fx"] * (x["h"] + x["L"] + np.abs(x["s"]) / 0.06)
    seen = replace(seen, rest={**seen.rest, "fx": seen.rest["fx"] + more})
    return seen, find(seen)


def test_alternatives_are_of_the_forces_that_their_search_saw():
    """The search of fy alone was never compared with what fx does."""
    seen = problem(by_speed, noise=NOISE)
    x = seen.table.columns
    strong = 0.3 * x["fx"] * (x["g"] / 0.04) + 0.3 * x["F0"] * x["h"] + 0.3 * x["fx"] * x["L"]
    found = find(replace(seen, rest={**seen.rest, "fx": seen.rest["fx"] + strong}))
    assert set(found.physics.equations) == {"fy"}
    assert found.alternatives
    assert all(set(other.equations) == {"fy"} for other in found.alternatives)


def test_each_force_with_an_equation_of_its_own_has_its_alternatives(of_each_force):
    seen, found = of_each_force
    assert set(found.physics.equations) == {"fx", "fy"}
    assert found.alternatives
    for other in found.alternatives:
        for o, text in other.equations.items():
            left = seen.rest[o] - evaluate(parse(text), seen.table)
            assert np.mean(left**2) < np.mean(seen.rest[o] ** 2)


@pytest.mark.parametrize("added", [by_speed, by_memory])
def test_no_alternative_repeats_the_equation_with_other_numbers_or_times_a_constant(added):
    """|camber| is one number here, so that g^2 times the equation is the equation."""
    found = find(problem(added, noise=NOISE))
    form = {"by_speed": ("v^2",), "by_memory": ("lag(abs(s)", "fy*")}[added.__name__]
    assert all(part in found.physics.equations["fy"] for part in form)
    texts = [other.equations["fy"] for other in found.alternatives]
    assert not [text for text in texts if all(part in text for part in form)]
    assert not [text for text in texts if "g^2" in text or "abs(g)" in text]


def test_the_drivers_of_each_force_have_the_probability_of_their_own_search(of_each_force):
    seen, found = of_each_force
    own = find(of_force(seen, "fy")).drivers
    assert own["speed"] < 1.0
    assert found.drivers["speed"] == pytest.approx(own["speed"])
    assert all(found.drivers[name] >= p - 1e-12 for name, p in own.items())


def test_a_factor_that_does_not_move_is_no_driver(of_speed):
    """Camber is 0.04 rad to either side: nothing was compared with its size."""
    assert of_speed.drivers.get("camber", 0.0) < 0.05


def test_the_report_says_on_what_the_residual_does_not_depend():
    found = find(problem(by_memory, noise=NOISE))
    assert "tread_temperature" in found.independent_of
    assert all(p < 0.05 for p in found.independent_of.values())
    for name in found.independent_of:
        assert found.drivers.get(name, 0.0) < 0.05
    assert "slip_angle" not in found.independent_of, "its memory is in the equation"
    assert "pressure" not in found.independent_of, "it was held"
    assert "camber" not in found.independent_of, "its size was held"


def test_the_intervals_of_the_coefficients_hold_the_truth_and_go_into_the_sidecar(of_speed):
    (size,) = of_speed.physics.coefficients["fy"]
    assert size.low < size.value < size.high
    assert size.low < -0.05 < size.high
    assert f"{size.value:.9g}" in of_speed.physics.equations["fy"]
    entry = of_speed.physics.to_sidecar()
    assert entry["coefficients"] == {"fy": [{"value": size.value, "low": size.low, "high": size.high}]}
    assert from_sidecar(entry).coefficients == of_speed.physics.coefficients
    del entry["coefficients"]
    assert from_sidecar(entry).coefficients == {}


@pytest.mark.parametrize(
    "coefficients",
    [
        5,
        {"fx": []},
        {"fy": [{"value": 1.0, "low": 2.0, "high": 3.0}]},
        {"fy": [{"value": 1.0, "low": float("-inf"), "high": 3.0}]},
        {"fy": [{"value": 1.0, "low": 0.0}]},
        {"fy": [{"value": 1.0, "low": 0.0, "high": 3.0}] * 3000},
    ],
)
def test_intervals_that_are_none_are_refused(of_speed, coefficients):
    with pytest.raises(EquationError):
        from_sidecar({**of_speed.physics.to_sidecar(), "coefficients": coefficients})
