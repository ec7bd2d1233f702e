"""The one guard beside the posterior, expected effects, and the next experiment."""

from dataclasses import replace

import numpy as np
import pytest

from tire_pipeline.mismatch import CorrectedModel, Explainer, explain_mismatch
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.linearised_set import linearised
from tire_pipeline.mismatch.inference.sets.answer import LEVEL
from tire_pipeline.mismatch.model.residual import residual
from tire_pipeline.mismatch.proof.never_worse import harmless
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.mismatch.report.assemble import assembled
from tire_pipeline.mismatch.report.next_experiment import next_experiment


@pytest.fixture(scope="module")
def softer(tire, record):
    return Explainer().weigh(tire, record(3, friction=0.9))


@pytest.fixture(scope="module")
def report(softer):
    return assembled(softer)


def test_what_makes_unseen_sweeps_better_is_put_in(softer):
    fit, left = harmless(softer.analysis, softer.sets, LEVEL)
    assert fit.names == softer.analysis.fit.names == ["friction_scale"]
    assert np.std(left["fy"]) < 0.5 * np.std(residual(softer.analysis.data, [])["fy"])


def test_what_makes_them_worse_is_withheld_and_keeps_its_name(softer):
    """The same effect with twice the size on top of what was found: the others stay."""
    analysis, fit = softer.analysis, softer.analysis.fit
    changes = [*fit.changes, ("force_offset", {"fy": 300.0, "fx": 0.0})]
    worse = linearised(analysis.system, changes, [*fit.free, ()], fit.covariance, fit.weight, fit.prior)
    assert harmless(replace(analysis, fit=worse), softer.sets, LEVEL)[0].names == ["friction_scale"]


def test_a_pressure_that_varied_is_expected_where_the_file_has_no_coefficient_of_it(tire, record):
    data = prepare(tire, record(4)).data
    effect = catalogue()["inflation_pressure"]
    assert effect.expected(data)
    knows = prepare(tire.replace(PPY1=0.5), record(4)).data
    assert not effect.expected(knows)


@pytest.mark.parametrize(
    ("low", "high", "expected"),
    [
        (2900.0, 3100.0, True),
        (1800.0, 5500.0, False),
        (1500.0, 4000.0, False),
        (0.0, 0.0, False),
        (5500.0, 1800.0, False),
    ],
)
def test_another_change_with_load_is_expected_of_a_file_fitted_at_one_load(tire, record, low, high, expected):
    """The recording's loads are 1.8 to 5.5 kN. Ends of no range at all are placeholders, and say nothing."""
    data = prepare(tire.replace(FZMIN=low, FZMAX=high), record(4)).data
    assert catalogue()["load_sensitivity"].expected(data) == expected


def test_nothing_else_is_expected(tire, record):
    data = prepare(tire, record(4)).data
    names = {n for n, e in catalogue().items() if e.absent(data) is None and e.expected(data)}
    assert names <= {"inflation_pressure", "camber"}


def test_the_next_experiment_separates_what_is_open(tire, record):
    """A lag in distance and one in time at one speed: a sweep that tells them apart is named."""
    it = Explainer().weigh(tire, record(5, delay=0.06))
    names = sorted(
        {each.names[0] for each in it.sets.sets if len(each.names) == 1} & {"time_delay", "low_pass"}
    )
    assert len(names) == 2
    plain = CorrectedModel(tire, (), {"scales": it.analysis.data.scales}, it.analysis.data.outputs)
    both = replace(it.answer, sets=((tuple(names), 0.9),))
    assert next_experiment(it.analysis, both, plain).startswith("To separate ")
    one = replace(it.answer, sets=((("time_delay",), 0.9),))
    assert next_experiment(it.analysis, one, plain) == ""


def test_probabilities_in_the_report_hold_95_percent(report):
    total = sum(p for _, p in report.probabilities)
    assert 0.95 < total <= 1.0 + 1e-9
    assert report.probabilities[0][0] == ("friction_scale",)
    assert np.all(np.diff([p for _, p in report.probabilities]) <= 0.0)


def test_a_correction_from_one_side_says_that_nothing_proves_it_on_the_other(tire, record, report):
    both = record(3, friction=0.9)
    one_side = explain_mismatch(tire, both[both["slip_angle"] > -0.01])
    assert ["to one side" in " ".join(each.notes) for each in (one_side, report)] == [True, False]
