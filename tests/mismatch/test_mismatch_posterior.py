"""The posterior over sets of effects: evidence, background, priors and answers."""

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from tire_pipeline.mismatch.discrepancy.background import principal
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.posterior.answer import answered
from tire_pipeline.mismatch.inference.posterior.calibrate import START, Tuning, learn, log_scores, pruned
from tire_pipeline.mismatch.inference.posterior.enumerate import enumerated
from tire_pipeline.mismatch.inference.posterior.evidence import gaussian, hypotheses, log_posterior
from tire_pipeline.mismatch.inference.posterior.priors import prior, spread
from tire_pipeline.mismatch.inference.posterior.sizes import learnt
from tire_pipeline.mismatch.inference.search_state import begin
from tire_pipeline.mismatch.recording.checks import prepare


@pytest.fixture(scope="module")
def searches(tire, record):
    """A recording without anything, and one with 12% less friction."""
    return {
        names: begin(prepare(tire, record(**how)).data)
        for names, how in (((), {}), (("friction_scale",), {"friction": 0.88}))
    }


@pytest.fixture(scope="module")
def cases(searches):
    return {names: enumerated(search, START, [names] if names else []) for names, search in searches.items()}


def test_the_evidence_is_that_of_a_normal_distribution():
    rng = np.random.default_rng(0)
    columns, scale = rng.normal(size=(40, 3)), np.array([0.3, 2.0, 0.01])
    y = columns @ np.array([0.5, -1.0, 0.2]) + rng.normal(size=40)
    both = np.column_stack([columns, y])
    covariance = np.eye(40) + (columns * scale**2) @ columns.T
    wanted = multivariate_normal.logpdf(y, cov=covariance) + 20.0 * np.log(2.0 * np.pi)
    assert gaussian((both.T @ both)[None], scale)[0] == pytest.approx(wanted, rel=1e-10)


def test_directions_of_the_background_have_the_size_of_the_largest_force():
    rng = np.random.default_rng(1)
    x = rng.normal(size=(500, 1))
    columns = [{"fy": x * 3.0}, {"fy": np.hstack([x * 0.1, x**2])}]
    found = principal(columns, {"fy": 2000.0})["fy"]
    assert np.sum(np.mean(found**2, axis=0)) == pytest.approx(2000.0**2, rel=1e-6)
    assert principal([{"fy": np.zeros((500, 2))}], {"fy": 2000.0}) is None


@pytest.mark.parametrize("name", [n for n, e in catalogue().items() if e.parameters])
def test_an_effect_says_its_family_and_where_its_priors_come_from(name):
    effect = catalogue()[name]
    assert effect.family
    assert effect.prior_source
    assert any(p.prior > 0.0 for p in effect.parameters)
    assert all(p.prior < p.high - p.low for p in effect.parameters if not p.prior_in)


def test_a_prior_is_a_share_of_what_it_says(searches):
    data = searches[()].data
    parameter = catalogue()["force_offset"].parameter("fy")
    assert spread(data, parameter) == pytest.approx(parameter.prior * 4000.0)
    off, wide = prior(data, [("friction_scale", {"friction": -0.1})], [(0, "friction")])
    assert off == pytest.approx([-0.1])
    assert wide == pytest.approx([catalogue()["friction_scale"].parameter("friction").prior])


def test_probabilities_are_of_all_sets_together(cases):
    for case in cases.values():
        mass = np.exp(log_posterior(case, learnt()))
        assert mass.sum() == pytest.approx(1.0)
        assert mass.size == len(hypotheses(case)) == 2 * len(case.sets)
        assert case.sets[0].names == ()


def test_nothing_missing_is_agreement(cases):
    answer = answered(cases[()], learnt())
    assert answer.sets == ()
    assert answer.agreement > 0.5


def test_a_missing_friction_is_among_the_names(cases):
    answer = answered(cases[("friction_scale",)], learnt())
    assert len(answer.sets) == 1
    names, probability = answer.sets[0]
    assert "friction_scale" in names
    assert 0.5 < probability <= 1.0
    assert answer.agreement < 0.05


def test_the_fit_finds_the_friction(cases):
    case = cases[("friction_scale",)]
    changes = next(each.changes for each in case.sets if each.names == ("friction_scale",))
    assert changes[0][1]["friction"] == pytest.approx(-0.12, abs=0.01)


def test_learning_betters_the_log_score(cases):
    tuning = [
        pruned(Tuning(case, "rig", names, (names,) if names else ((),))) for names, case in cases.items()
    ]
    before = log_scores(tuning, START).mean()
    after = log_scores(tuning, learn(tuning, START, steps=())).mean()
    assert after > before
