"""The one guard beside the posterior, expected effects, and the next experiment."""

from dataclasses import replace

import numpy as np
import pytest
from weighed import all_but

from tire_pipeline.mismatch import CorrectedModel, Explainer
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.linearised_set import linearised
from tire_pipeline.mismatch.inference.sets.answer import LEVEL
from tire_pipeline.mismatch.model.nominal import Reference
from tire_pipeline.mismatch.model.residual import residual
from tire_pipeline.mismatch.proof.never_worse import harmless
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.mismatch.report.assemble import assembled
from tire_pipeline.mismatch.report.next_experiment import next_experiment


@pytest.fixture(scope="module")
def softer(tire, record):
    few = all_but("friction_scale", "force_offset", "stiffness_scale")
    return Explainer(without=few).weigh(tire, record(3, friction=0.7))


def test_what_is_put_in_was_named_and_leaves_less_of_unseen_sweeps(softer):
    fit, left = harmless(softer.analysis, softer.sets, LEVEL)
    before = residual(softer.analysis.data, [])
    assert set(fit.names) <= set(softer.analysis.fit.names)
    assert (np.std(left["fy"]) < np.std(before["fy"])) == bool(fit.names)


@pytest.mark.parametrize("offset", [300.0, 1500.0])
def test_what_makes_them_worse_is_withheld_and_the_rest_is_put_in(softer, offset):
    """An offset that is not there: with 300 N both together still leave less than nothing does."""
    analysis, fit = softer.analysis, softer.analysis.fit
    changes = [*fit.changes, ("force_offset", {"fy": offset, "fx": 0.0})]
    worse = linearised(analysis.system, changes, [*fit.free, ()], fit.covariance, fit.weight, fit.prior)
    assert harmless(replace(analysis, fit=worse), softer.sets, LEVEL)[0].names == fit.names


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
    it = Explainer(without=all_but("time_delay", "low_pass")).weigh(tire, record(5, delay=0.06))
    names = sorted(
        {each.names[0] for each in it.sets.sets if len(each.names) == 1} & {"time_delay", "low_pass"}
    )
    assert len(names) == 2
    plain = CorrectedModel(tire, (), it.analysis.data.outputs, Reference(it.analysis.data.states.scales))
    both = replace(it.answer, sets=((tuple(names), 0.9),))
    assert next_experiment(it.analysis, both, plain).startswith("To separate ")
    one = replace(it.answer, sets=((("time_delay",), 0.9),))
    assert next_experiment(it.analysis, one, plain) == ""
    shares = dict.fromkeys([(name,) for name in names], 0.5)
    neither = replace(it.answer, sets=(), agreement=0.0, unnamed=0.0, probabilities=shares)
    assert {each.names for each in neither.rivals} == set(shares)
    assert next_experiment(it.analysis, neither, plain).startswith("To tell the explanations apart, record ")


def test_a_choice_is_repeated_among_sets_with_mass_and_parts_of_the_named_one(softer):
    assert [each.names for each in softer.sets.with_mass({(): 1.0}, ()).sets] == [()]
    named = softer.answer.named.names
    kept = {each.names for each in softer.sets.with_mass(softer.answer.probabilities, named).sets}
    assert {(), named} <= kept
    assert kept <= {each.names for each in softer.sets.sets}


def test_what_may_be_unnamed_or_nothing_has_no_rivals(softer):
    answer = replace(softer.answer, sets=())
    assert answer.rivals
    assert not replace(answer, agreement=0.3, unnamed=0.3).rivals
    assert not softer.answer.rivals


def test_probabilities_in_the_report_hold_95_percent_and_no_more_sets_than_that_takes(softer):
    probabilities = [p for _, p in assembled(softer).probabilities]
    assert 0.95 < sum(probabilities) <= 1.0 + 1e-9
    assert sum(probabilities[:-1]) <= 0.95
    assert np.all(np.diff(probabilities) <= 0.0)
