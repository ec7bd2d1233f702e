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
from tire_pipeline.mismatch.model.residual import residual, rms
from tire_pipeline.mismatch.proof.held_out import prove
from tire_pipeline.mismatch.proof.never_worse import confirmed_part, guarded
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.mismatch.report.assemble import assembled
from tire_pipeline.mismatch.report.next_experiment import next_experiment


@pytest.fixture(scope="module")
def softer(tire, record):
    few = all_but("friction_scale", "force_offset", "stiffness_scale")
    return Explainer(without=few).weigh(tire, record(3, friction=0.7))


def test_what_is_put_in_was_named_and_leaves_less_of_unseen_sweeps(softer):
    allowed = guarded(softer.analysis, softer.sets, LEVEL)
    before = residual(softer.analysis.data, [])
    assert allowed.fit.names == softer.analysis.fit.names != []
    assert 0.5 < allowed.part <= 1.0
    assert np.std(allowed.left["fy"]) < np.std(before["fy"])


def test_the_error_after_it_is_of_what_is_added(softer):
    """What open explanations do not agree on was taken for noise of the rows: 86 N became "99 N"."""
    allowed = guarded(softer.analysis, softer.sets, LEVEL)
    before, size = residual(softer.analysis.data, [])["fy"], softer.analysis.data.size
    for share in (0.0, 0.5, 1.0):
        part = replace(allowed, agreed={"fy": np.full(size, share)})
        proved = prove(softer.analysis, part, {"fy": 1.0})["fy"]
        left = (1.0 - share) * before + share * allowed.left["fy"]
        assert proved.rms_after == pytest.approx(rms(left))
        assert proved.rms_after_low <= proved.rms_after <= proved.rms_after_high
        if share == 0.0:
            assert proved.rms_condition_after == pytest.approx(proved.rms_condition_before)


@pytest.mark.parametrize("offset", [300.0, 1500.0])
def test_what_makes_them_worse_is_withheld_and_the_rest_is_put_in(softer, offset):
    """An offset that is not there: with 300 N both together still leave less than nothing does."""
    analysis, fit = softer.analysis, softer.analysis.fit
    changes = [*fit.changes, ("force_offset", {"fy": offset, "fx": 0.0})]
    worse = linearised(analysis.system, changes, [*fit.free, ()], fit.covariance, fit.weight, fit.prior)
    assert guarded(replace(analysis, fit=worse), softer.sets, LEVEL).fit.names == fit.names


def parts(true, sweeps, seed, predicted=1.0):
    """Part that is confirmed of a change that should be multiplied, where the formula is off by sweep."""
    rng = np.random.default_rng(seed)
    sweep = np.repeat(np.arange(sweeps), 50)
    change = predicted * np.sin(np.linspace(0.0, 40.0, sweep.size)) * (sweep % 2 == 0)
    misfit = (rng.normal(size=sweeps)[sweep]) * np.sin(np.linspace(0.0, 40.0, sweep.size) + 0.5)
    before = {"fy": true * change / predicted + misfit}
    after = {"fy": before["fy"] - change}
    return confirmed_part(before, after, {"fy": 1.0}, sweep)


def test_a_part_is_below_the_true_multiple_in_five_of_six():
    found = np.array([parts(0.6, 24, seed) for seed in range(400)])
    below = float(np.mean(found <= 0.6))
    assert 0.78 < below < 0.90  # 84%, of 400 draws


def test_sweeps_that_a_change_leaves_alone_say_nothing_of_it():
    """A gain of 0 in half of the sweeps is no evidence against a change that acts in the others."""
    rng = np.random.default_rng(3)
    change, misfit = np.repeat(rng.normal(size=12), 10), rng.normal(size=120)
    before = {"fy": change + 0.5 * misfit}
    alone = confirmed_part(before, {"fy": 0.5 * misfit}, {"fy": 1.0}, np.arange(120) // 10)
    more = {"fy": np.concatenate([before["fy"], rng.normal(size=120)])}
    after = {"fy": np.concatenate([0.5 * misfit, more["fy"][120:]])}
    assert confirmed_part(more, after, {"fy": 1.0}, np.arange(240) // 10) == pytest.approx(alone)


@pytest.mark.parametrize(("true", "most"), [(-1.0, 0.0), (0.0, 0.5), (1.0, 1.0)])
def test_a_change_that_is_not_there_is_confirmed_by_nothing(true, most):
    found = [parts(true, 40, seed) for seed in range(20)]
    assert np.mean(found) <= most
    assert (np.mean(found) > 0.5) == (true == 1.0)


def test_one_sweep_alone_confirms_nothing():
    change = np.ones(10)
    assert confirmed_part({"fy": change}, {"fy": 0.0 * change}, {"fy": 1.0}, np.zeros(10, int)) == 0.0


def test_a_pressure_that_varied_is_expected_where_the_file_has_no_coefficient_of_it(tire, record):
    data = prepare(tire, record(4)).data
    effect = catalogue()["inflation_pressure"]
    assert effect.expected(data)
    able = tire.to_version("6.1").replace(PPY1=0.5)
    assert effect.expected(prepare(able, record(4)).data)  # ... and no nominal pressure
    assert not effect.expected(prepare(able.replace(NOMPRES=2.2e5), record(4)).data)


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


def test_a_lag_in_distance_is_told_from_one_in_time_by_another_speed_only(tire, record):
    """At the recorded speed each may have the size at which it does what the other one does."""
    it = Explainer(without=all_but("time_delay", "relaxation_length")).weigh(tire, record(5, delay=0.15))
    plain = CorrectedModel(tire, (), it.analysis.data.outputs, Reference(it.analysis.data.states.scales))
    both = replace(it.answer, sets=((("relaxation_length", "time_delay"), 0.9),))
    assert not it.analysis.data.varies("speed")
    assert next_experiment(it.analysis, both, plain).endswith("at half the speed.")


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


def test_sets_that_would_do_stand_beside_something_unnamed(softer):
    alone = {(): 0.2, ("wear",): 0.1, ("camber",): 0.3, ("compliance",): 0.01}
    answer = replace(softer.answer, sets=(), unnamed=0.6, agreement=0.0, alone=alone)
    assert answer.beside_unnamed == ((), ("camber",), ("wear",))
    assert replace(answer, alone={(): 1.0}).beside_unnamed == ()
    assert softer.answer.beside_unnamed == ()


def test_probabilities_in_the_report_hold_95_percent_and_no_more_sets_than_that_takes(softer):
    probabilities = [p for _, p in assembled(softer).probabilities]
    assert 0.95 < sum(probabilities) <= 1.0 + 1e-9
    assert sum(probabilities[:-1]) <= 0.95
    assert np.all(np.diff(probabilities) <= 0.0)


def test_a_sweep_is_said_to_separate_only_what_it_separates(tire, record):
    """Another speed tells the lags apart, and says nothing of which gain is wrong."""
    lags, gains = ("relaxation_length", "time_delay"), ("force_gain", "load_gain")
    it = Explainer(without=all_but(*lags, *gains)).weigh(tire, record(5, delay=0.15))
    plain = CorrectedModel(tire, (), it.analysis.data.outputs, Reference(it.analysis.data.states.scales))
    both = replace(it.answer, sets=((gains, 0.99), (lags, 0.9)))
    said = next_experiment(it.analysis, both, plain)
    assert said.startswith("To separate relaxation length from ")
    assert "gain" not in said
    only = replace(it.answer, sets=((gains, 0.99),))
    assert next_experiment(it.analysis, only, plain).startswith("Hang a known weight")
