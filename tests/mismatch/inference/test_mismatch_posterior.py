"""The posterior over sets of effects: likelihood, background, priors, answers, and what is learnt."""

import dataclasses
import pickle
from dataclasses import replace
from functools import partial

import numpy as np
import pandas as pd
import pytest
from scipy.stats import multivariate_normal, norm
from small_rig import rig_force, schedule
from weighed import all_but

from tire_pipeline.calibration.learning import CalibrateMismatchParameters, learn_sizes, weigh_cases
from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch import Explainer
from tire_pipeline.mismatch.discrepancy.background import principal
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.analysis import analyse
from tire_pipeline.mismatch.inference.evidence.hypotheses import hypotheses, log_posterior, log_prior, plain
from tire_pipeline.mismatch.inference.evidence.likelihood import Weights
from tire_pipeline.mismatch.inference.learn_sizes import Tuning, learn, log_scores, pruned
from tire_pipeline.mismatch.inference.learnt.sizes import learnt
from tire_pipeline.mismatch.inference.one_sided import log_possible
from tire_pipeline.mismatch.inference.priors import prior
from tire_pipeline.mismatch.inference.sets import enumerate as enumerate_module
from tire_pipeline.mismatch.inference.sets.answer import answered
from tire_pipeline.mismatch.inference.sets.enumerate import enumerate_sets, screened_recording
from tire_pipeline.mismatch.inference.sets.fitting import fitted
from tire_pipeline.mismatch.inference.sets.objective import negative_log_posterior
from tire_pipeline.mismatch.recording.prepare import prepare

OTHERS = all_but("friction_scale", "stiffness_scale", "force_offset", "force_gain", "inflation_pressure")
"""Effects that are not weighed here: what holds of sets of a few holds of all (all of them: ``rates``)."""


@pytest.fixture(scope="module")
def analyses(tire, record):
    """A recording without anything, and one with 30% less friction; with 12%: ``rates``."""
    return {
        names: analyse(prepare(tire, record(**how)).data, OTHERS)
        for names, how in (((), {}), (("friction_scale",), {"friction": 0.7}))
    }


@pytest.fixture(scope="module")
def cases(analyses):
    return {
        names: enumerate_sets(a, learnt(), [names] if names else []).case for names, a in analyses.items()
    }


def test_what_is_never_known_is_integrated_out():
    """Reduced products are those of the precision matrix of a normal distribution."""
    rng = np.random.default_rng(0)
    columns, y, scale = rng.normal(size=(40, 3)), rng.normal(size=40), np.array([0.3, 2.0, 0.01])
    gram = columns.T @ columns / 40.0 * scale[:, None] * scale[None, :]
    values, vectors = np.linalg.eigh(gram)
    weights = Weights(25.0, values, scale[:, None] * vectors)
    found = weights.reduced(np.array([[y @ y / 40.0]]), (columns.T @ y / 40.0)[:, None])[0, 0]
    covariance = np.eye(40) * 40.0 / 25.0 + (columns * scale**2) @ columns.T
    told = multivariate_normal.logpdf(y, cov=covariance) - multivariate_normal.logpdf(0 * y, cov=covariance)
    assert -0.5 * found == pytest.approx(told, rel=1e-9)


@pytest.mark.parametrize("mean", [(0.3, -0.8), (-3.0, 1.0), (-2.0, -3.0)])
@pytest.mark.parametrize("correlation", [0.0, 0.6, -0.4])
def test_what_physics_lets_lie_on_one_side_counts_on_this_side_alone(mean, correlation):
    """Against the distribution function of a normal distribution; a third coefficient may be negative."""
    spread = np.array([0.7, 1.5])
    covariance = np.outer(spread, spread) * np.array([[1.0, correlation], [correlation, 1.0]])
    whole = np.full((3, 3), 0.2)
    whole[:2, :2] = covariance
    found = log_possible(np.r_[mean, 4.0], whole, np.array([True, True, False]))
    told = multivariate_normal.cdf(np.zeros(2), mean=-np.array(mean), cov=covariance)
    assert found - 2.0 * np.log(2.0) == pytest.approx(np.log(told), abs=0.15)
    one = log_possible(np.r_[mean, 4.0], whole, np.array([True, False, False]))
    assert one == pytest.approx(np.log(2.0) + norm.logcdf(mean[0] / spread[0]), rel=1e-9)


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


def test_a_prior_is_a_share_of_what_it_says(analyses):
    data = analyses[()].data
    offset, friction = catalogue()["force_offset"], catalogue()["friction_scale"]
    assert offset.usual(data, "fy") == pytest.approx((0.0, offset.parameter("fy").prior * 4000.0))
    off, wide = prior(data, [("friction_scale", {"friction": -0.1})], [(0, "friction")])
    assert off == pytest.approx([-0.1])
    assert wide == pytest.approx([friction.parameter("friction").prior])


def test_probabilities_are_of_all_sets_together(cases):
    for case in cases.values():
        mass = np.exp(log_posterior(case, learnt()))
        assert mass.sum() == pytest.approx(1.0)
        forms = sum(len(each.forms) for each in case.sets)
        assert mass.size == len(hypotheses(case)) == 2 * len(case.sets) + forms
        assert case.sets[0].names == ()


def test_all_unnamed_forms_together_are_as_likely_as_one_effect(cases):
    case, sizes = cases[()], learnt()
    odds = log_prior(case, sizes)
    alone = [k for k, h in enumerate(hypotheses(case)) if not h.names and h.form is not None]
    single = next(k for k, h in enumerate(hypotheses(case)) if len(h.names) == 1 and not h.unnamed)
    assert len(alone) == len(case.sets[0].forms) > 5
    assert np.exp(odds[alone]).sum() == pytest.approx(np.exp(odds[single]))


def test_a_form_beside_a_set_has_the_columns_of_both(cases):
    each = next(s for s in cases[("friction_scale",)].sets if s.names == ("friction_scale",))
    own, size = each.parameters + each.errors, each.products.own["fy"].shape[0] - 1
    taken = [each.columns(form=k)[own:] for k in range(len(each.forms))]
    assert all(np.array_equal(each.columns(form=k)[:own], each.columns()) for k in range(len(taken)))
    assert np.concatenate([each.columns(wide=True), *taken]).tolist() == list(range(size))


def test_a_fit_is_held_by_the_priors_that_weigh_it(tire):
    """In a short, noisy recording the width of the prior tells where a fit ends."""
    t, slip_angle, load, _ = schedule(seconds=30.0, rate=2.0)
    without_noise = rig_force(tire, slip_angle, load, friction=0.7)
    for seed in range(2):
        force = without_noise + np.random.default_rng(seed).normal(0.0, 400.0, t.size)
        channels = {"time": t, "slip_angle": slip_angle, "normal_load": load, "fy": force}
        analysis, found = analyse(prepare(tire, pd.DataFrame(channels)).data, OTHERS), []
        for width in (0.1, 3.0):
            sets = enumerate_sets(analysis, replace(learnt(), prior=width), [("friction_scale",)]).case.sets
            changes = next(each.changes for each in sets if each.names == ("friction_scale",))
            found.append(changes[0][1]["friction"])
        assert found[1] < found[0] < 0.0


def test_what_is_missing_takes_the_odds_from_agreement(cases):
    """How often a recording that lacks nothing is said to agree: ``rates``."""
    without, missing = (answered(case, learnt()).agreement for case in cases.values())
    assert missing < 1e-6 < without


def test_a_missing_friction_is_among_the_names(cases):
    answer = answered(cases[("friction_scale",)], learnt())
    assert len(answer.sets) == 1
    names, probability = answer.sets[0]
    assert "friction_scale" in names
    assert 0.5 < probability <= 1.0


def test_a_name_is_said_from_the_level_on_that_is_asked_for(cases):
    case = cases[("friction_scale",)]
    sure = answered(case, learnt()).sets[0][1]
    assert answered(case, learnt(), level=min(sure + 1e-6, 1.0)).sets == ()


def test_the_fit_finds_the_friction(cases):
    case = cases[("friction_scale",)]
    changes = next(each.changes for each in case.sets if each.names == ("friction_scale",))
    assert changes[0][1]["friction"] == pytest.approx(-0.3, abs=0.01)


def test_what_looks_like_the_likeliest_is_fitted_even_if_the_screen_leaves_it_out(analyses, monkeypatch):
    """A large compliance was lost: the screen sees small sizes, at which it has another shape."""
    screened = enumerate_module.screen

    def narrow(*given):
        found = screened(*given)
        forms = {name: each for name, each in found.forms.items() if name != "inflation_pressure"}
        return replace(found, forms=forms, kept=("friction_scale",), beside={})

    monkeypatch.setattr(enumerate_module, "screen", narrow)
    fitted_sets = enumerate_sets(analyses[("friction_scale",)], learnt()).case.sets
    names = {each.names for each in fitted_sets}
    assert ("force_gain",) in names  # of one family
    assert ("force_offset",) not in names


@pytest.mark.parametrize("away", [-5.0, 5.0])
def test_the_moment_of_a_step_is_found_from_the_start_beside_the_nearest(tire, record, away):
    """Starts are 6 s apart. On real sweeps the likeliest was not the nearest, and the step out of reach."""
    friction = np.where(np.arange(3750) / 25.0 < 81.0, 1.0, 0.8)
    analysis = analyse(prepare(tire, record(friction=friction)).data, all_but("surface_change"))
    looked = screened_recording(analysis, learnt())
    begun = next(v for v in analysis.variants if "moment" in v.free)
    begun = replace(begun, start={**begun.start, "moment": 81.0 + away})
    ((_, found),) = fitted(looked.products, looked.guess, [begun]).changes
    assert found["moment"] == pytest.approx(81.0, abs=0.1)
    assert found["friction"] == pytest.approx(-0.2, abs=0.03)


def test_a_step_is_weighed_by_how_far_its_moment_may_move(tire, record):
    """At zero slip friction changes nothing: the slope at the moment does not say how far it may move."""
    friction = np.where(np.arange(3750) / 25.0 < 82.5, 1.0, 0.9)  # where the slip is zero
    analysis = analyse(prepare(tire, record(friction=friction)).data, all_but("surface_change"))
    looked = screened_recording(analysis, learnt())
    begun = next(v for v in analysis.variants if "moment" in v.free)
    found = fitted(looked.products, looked.guess, [replace(begun, start={**begun.start, "moment": 82.0})])
    ((name, p),) = found.changes
    moments = p["moment"] + np.arange(-12.0, 12.0, 0.02)
    moved = [[(name, {**p, "moment": float(m)})] for m in moments]
    cost = np.array([negative_log_posterior(looked.products, looked.guess, c, [("moment",)]) for c in moved])
    mass = np.trapezoid(np.exp(cost.min() - cost), moments)
    wide = prior(analysis.data, found.changes, [(0, "moment")])[1][0]
    narrow = wide * plain(looked.guess, found).covariance[1, 1] ** 0.5
    assert found.spread == pytest.approx(np.log(mass / narrow / np.sqrt(2.0 * np.pi)), abs=0.5)
    assert found.spread < -0.3  # there the slope is flatter than on either side


def test_a_steady_change_lasts_the_whole_recording(tire, record):
    friction = 1.0 - 0.2 * np.linspace(0.0, 1.0, 3750)
    analysis = analyse(prepare(tire, record(friction=friction)).data, all_but("surface_change"))
    looked = screened_recording(analysis, learnt())
    begun = next(v for v in analysis.variants if "moment" not in v.free)
    ((_, found),) = fitted(looked.products, looked.guess, [begun]).changes
    assert found["moment"] == begun.start["moment"]
    assert found["friction"] == pytest.approx(-0.2, abs=0.03)


@pytest.fixture(scope="module")
def tuning(cases):
    """The cases with what is right in each, every one a source of its own, pruned."""
    return [
        pruned(Tuning(case, str(names), names, (names,) if names else ((),)), learnt())
        for names, case in cases.items()
    ]


def test_learning_betters_the_log_score(tuning):
    found = learn(tuning, replace(learnt(), error=0.03), step=1.6)
    assert log_scores(tuning, found.sizes).mean() == pytest.approx(found.score)
    assert found.score > found.start
    assert set(found.curvature) >= {"error", "side", "effect"}


def test_the_nodes_learn_what_one_call_learns(tuning):
    """Evidence that is worked out case by case, by any worker, and stored; a stopped case is passed over."""
    parameters = CalibrateMismatchParameters()
    stored = [*(pickle.dumps(each) for each in tuning), pickle.dumps(None)]
    reduced = {f"code/{k}.pkl": partial(bytes, each) for k, each in enumerate(stored)}
    work = weigh_cases(reduced, parameters)
    assert len({name.rsplit("/", 1)[-1] for name in work}) == 3
    weighed = {name: partial(bytes, pickle.loads(pickle.dumps(make))()) for name, make in work.items()}
    made, table = learn_sizes(reduced, weighed, parameters)
    told = learn(tuning, learnt(), step=parameters.step)
    assert made["sizes"] == told.sizes.to_dict()
    assert made["provenance"]["log_score"] == pytest.approx(told.score)
    assert list(table["source"]) == sorted(each.source for each in tuning)


def test_a_source_that_is_left_out_teaches_nothing(tuning):
    nothing, friction = tuning
    without = learn(tuning, learnt(), step=1.0).without[friction.source]
    assert without.effect == pytest.approx(learn([nothing], learnt(), step=1.0).sizes.effect)
    assert without.effect != pytest.approx(learn(tuning, learnt(), step=1.0).sizes.effect)


def test_hypotheses_without_mass_change_no_score(cases, tuning):
    for each, kept in zip(cases.values(), tuning, strict=True):
        assert len(kept.kept) < len(hypotheses(each))
        whole = Tuning(each, kept.source, kept.truth, kept.right)
        assert log_scores([kept], learnt()) == pytest.approx(log_scores([whole], learnt()), abs=1e-3)


@pytest.mark.parametrize("seed", [2, *(pytest.param(seed, marks=pytest.mark.long) for seed in (3, 4))])
def test_a_prior_of_the_user_takes_the_place_of_the_stated_one(tire, record, seed):
    recording, alone = record(seed, friction=0.88), ("friction_scale",)
    stated = Explainer(without=OTHERS).weigh(tire, recording).answer
    priors = {"friction_scale": {"friction": 1e-4}}
    narrow = Explainer(without=OTHERS, priors=priors).weigh(tire, recording).answer
    assert stated.probabilities[alone] > 0.9
    assert narrow.probabilities.get(alone, 0.0) < 1e-3


def test_a_prior_of_what_the_catalogue_lacks_is_refused(tire, record):
    with pytest.raises(RecordingError, match="the catalogue has no warp"):
        Explainer(priors={"warp": {}}).weigh(tire, record(2))


def test_what_is_learnt_is_named_and_finite():
    for field in dataclasses.fields(learnt()):
        value = getattr(learnt(), field.name)
        assert np.all(np.isfinite(list(value.values()) if field.name == "background" else [value]))
