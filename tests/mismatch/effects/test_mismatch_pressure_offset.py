"""An absolute pressure that was read as gauge has a name, and is no other stiffness."""

import numpy as np
import pytest
from weighed import beside, named_sets

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.model.forces import simulate
from tire_pipeline.mismatch.recording.prepare import prepare

ATMOSPHERE = 101325.0


@pytest.fixture(scope="module")
def inflated(tire):
    """The small rig's tire, with a file that answers to pressure."""
    return TireModel.from_coefficients(
        {**tire.coefficients, "NOMPRES": 2.2e5, "PPY1": 0.5, "PPY2": 0.3, "PPY3": -0.08, "PKY4": 2.0},
        version="6.1",
    )


@pytest.fixture(scope="module")
def recorded(inflated, record):
    """Sweeps at three pressures, with noise."""
    run = record()
    inputs = {n: run[n].to_numpy() for n in ("slip_angle", "normal_load", "pressure")}
    noise = np.random.default_rng(5).normal(0.0, 25.0, len(run))
    return run.assign(fy=np.asarray(inflated.forces(**inputs, limits="ignore").fy) + noise)


def test_the_effect_takes_the_offset_off(inflated, recorded):
    data = prepare(inflated, recorded.assign(pressure=recorded["pressure"] + ATMOSPHERE)).data
    right = prepare(inflated, recorded).data.simulation.base["fy"]
    assert np.abs(data.simulation.base["fy"] - right).max() > 0.02 * np.abs(right).max()
    found = simulate(data, [("pressure_offset", {"offset": ATMOSPHERE})])["fy"]
    np.testing.assert_allclose(found, right, atol=1e-6 * np.abs(right).max())
    same = simulate(data, [("pressure_offset", {"offset": 0.0})])["fy"]
    np.testing.assert_array_equal(same, data.simulation.base["fy"])


@pytest.mark.slow
@pytest.mark.parametrize("offset", [ATMOSPHERE, -ATMOSPHERE])
@beside("pressure_offset", "inflation_pressure", "stiffness_scale", "friction_scale", "temperature")
def test_a_wrong_zero_of_the_pressure_has_its_name(inflated, recorded, offset, without):
    wrong = recorded.assign(pressure=recorded["pressure"] + offset)
    sets = named_sets(inflated, wrong, without)
    assert len(sets) == 1
    assert "pressure_offset" in sets[0]


@pytest.mark.slow
@beside("pressure_offset", "inflation_pressure", "stiffness_scale", "friction_scale", "temperature")
def test_another_stiffness_is_no_wrong_zero_of_the_pressure(inflated, recorded, without):
    inputs = {n: recorded[n].to_numpy() for n in ("slip_angle", "normal_load", "pressure")}
    soft = inflated.replace(LKY=0.9)
    rest = recorded["fy"] - inflated.forces(**inputs, limits="ignore").fy
    sets = named_sets(inflated, recorded.assign(fy=soft.forces(**inputs, limits="ignore").fy + rest), without)
    assert "stiffness_scale" in sets[0]


def test_a_file_that_does_not_answer_to_pressure_says_nothing_of_it(tire, record):
    effect, data = catalogue()["pressure_offset"], prepare(tire, record()).data
    assert effect.absent(data) == "the model does not answer to pressure"
