"""A recording at one pressure, which is not the one at which its file says that it is right."""

import numpy as np
import pytest
from small_rig import rig_force, schedule
from weighed import beside, named_sets

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch.model.nominal import levels
from tire_pipeline.mismatch.recording.prepare import prepare

FILE, RECORDED = 2.5e5, 1.9e5


@pytest.fixture(scope="module")
def stated(tire) -> TireModel:
    """The tire as a file of MF 6.1 that was measured at 2.5 bar and has no coefficient of pressure."""
    return TireModel.from_coefficients({**tire.coefficients, "NOMPRES": FILE}, version="6.1")


@pytest.fixture(scope="module")
def softer(tire, record):
    """Recorded at 1.9 bar: friction and stiffness are those of a softer tire."""
    t, alpha, load, _ = schedule()
    pressure = np.full(t.size, RECORDED)
    d = (RECORDED - FILE) / FILE
    force = rig_force(tire, alpha, load, 1.0 - 0.3 * d, 1.0 + 0.8 * d)
    noise = 25.0 * np.random.default_rng(5).standard_normal(t.size)
    return record().assign(pressure=pressure, fy=force + noise)


@beside("inflation_pressure", "friction_scale", "stiffness_scale", "load_gain", "force_gain")
def test_another_pressure_than_the_files_is_among_the_causes(stated, softer, without):
    assert "inflation_pressure" in set().union(*named_sets(stated, softer, without))


def test_the_files_own_pressure_is_no_cause(stated, softer):
    data = prepare(stated, softer.assign(pressure=FILE)).data
    assert not data.nominal.off_pressure


def test_a_file_without_a_pressure_says_nothing_of_another_one(tire, softer):
    data = prepare(tire, softer).data
    assert data.nominal.pressure_of_file is None
    assert not data.nominal.off_pressure


def test_the_levels_of_pressure_do_not_go_by_the_order_of_the_runs():
    """Three runs at 2, 2.5 and 3 bar: only the most common and the first were tried, whichever came first."""
    noise = 500.0 * np.random.default_rng(0).standard_normal(600)
    for order in ((2.5e5, 2.0e5, 3.0e5), (3.0e5, 2.5e5, 2.0e5), (2.0e5, 3.0e5, 2.5e5)):
        found = levels(np.repeat(order, 200) + noise, least=7.5e3)
        assert sorted(found) == pytest.approx([2.0e5, 2.5e5, 3.0e5], rel=0.01)


def test_a_pressure_that_drifts_is_one_level():
    assert levels(np.linspace(2.0e5, 2.6e5, 600), least=7.5e3) == pytest.approx([2.3e5])
