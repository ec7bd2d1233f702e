"""Classes of tires that no metadata names."""

from dataclasses import replace

import numpy as np
import pytest

from tire_pipeline.translation.population.classes.search import find_classes, refined_classes, with_classes
from tire_pipeline.translation.population.classes.search_input import ClassSearchInput
from tire_pipeline.translation.population.classes.search_starts import starts
from tire_pipeline.translation.population.classes.tire_classes import TireClasses, fit_shares, log_density
from tire_pipeline.translation.population.mixed_effects import Design, MarginalLikelihood, posterior_weights

pytestmark = pytest.mark.slow
VARIANCES = {
    "level": 100.0,
    "metadata": 0.3,
    "size": 0.05,
    "category": 0.5,
    "tire": 1.0,
    "tire_category": 0.005,
    "noise": 0.01,
}
CENTRES = np.array([[-1.5, -1.5, -1.5], [0.0, 0.0, 0.0], [1.8, 1.8, 1.8]])
BIAS = np.array([[0.0, 0.0, 0.0], [0.7, -0.5, 0.2]])


def _question(rng, *, grouped, tires=240):
    """No tire is measured by both categories; which tires a category gets is chance and hence unbalanced."""
    organisation = rng.integers(0, 2, tires)
    x = rng.normal(size=(tires, 1))
    kind = np.digitize(0.5 * x[:, 0] + rng.normal(size=tires), [-0.5, 0.5])
    response = BIAS[organisation] + 0.3 * rng.normal(size=(tires, 3))
    response += CENTRES[kind] if grouped else rng.normal(size=(tires, 3))
    blocks = {
        "level": np.ones((tires, 1)),
        "metadata": x,
        "size": np.zeros((tires, 1)),
        "category": np.eye(2)[organisation],
    }
    question = ClassSearchInput(
        Design(blocks, np.zeros((tires, 0)), np.ones(tires)),
        response,
        np.arange(tires),
        x,
        np.full(3, 0.01),
        np.full(3, 0.005),
        (VARIANCES,) * 3,
        np.arange(3),
        np.eye(3, dtype=bool),
    )
    return question, kind


def test_classes_are_found():
    question, kind = _question(np.random.default_rng(4), grouped=True)
    classes, probability = find_classes(question)
    assert classes is not None
    assert classes.count == 3
    found = probability.argmax(axis=1)
    order = np.argsort([question.response[found == k].mean() for k in range(classes.count)])
    assert (np.argsort(order)[found] == kind).mean() > 0.95


def _bias_error(design, response, variances):
    weights = [posterior_weights(design, y, variances).mean for y in response.T]
    return [w[4] - w[3] - true for w, true in zip(weights, BIAS[1] - BIAS[0], strict=True)]


def test_classes_make_the_bias_sharper():
    plain, sharp = [], []
    for seed in range(3):
        question, _ = _question(np.random.default_rng(seed), grouped=True)
        classes, probability = find_classes(question)
        blocks = with_classes(question.design.blocks, classes.coded(probability))
        design = Design(blocks, question.design.tire, question.design.files)
        plain += _bias_error(question.design, question.response, VARIANCES)
        known = {**VARIANCES, "tire": 0.1, "class": 1.0, "category_class": 0.01}
        sharp += _bias_error(design, question.response, known)
    assert np.std(sharp) < 0.5 * np.std(plain)


@pytest.mark.parametrize("seed", [0, *(pytest.param(n, marks=pytest.mark.long) for n in (1, 2))])
def test_a_category_that_moves_its_classes_past_each_other_is_laid_over_the_others(seed):
    """Groups of all tires together put the second category's first and last class over each other's."""
    question, kind = _question(np.random.default_rng(seed), grouped=True)
    second = question.design.blocks["category"][:, 1]
    passing = np.array([[1.5, 1.5, 0.0], [0.0, 0.0, 0.0], [-1.8, -1.8, 0.0]])
    question = replace(question, response=question.response + second[:, None] * passing[kind])
    classes, probability = find_classes(question)
    assert classes is not None
    assert classes.count == 3
    first, found = second == 0.0, probability.argmax(axis=1)
    name = np.array([np.bincount(kind[first & (found == k)]).argmax() for k in range(3)])
    assert (name[found] == kind)[second > 0.0].mean() > 0.95


def _with_shared_tires(question, rng, shared=10):
    """The first category's first tires, measured by the second one, too."""
    design = question.design
    own = np.flatnonzero(design.blocks["category"][:, 0])[:shared]
    blocks = {name: np.concatenate([block, block[own]]) for name, block in design.blocks.items()}
    blocks["category"][-shared:] = [0.0, 1.0]
    tire = np.concatenate([question.tire, question.tire[own]])
    moved = question.response[own] + BIAS[1] - BIAS[0] + 0.02 * rng.normal(size=(shared, 3))
    columns = (tire[:, None] == tire[own][None, :]).astype(float)
    return replace(
        question,
        design=Design(blocks, columns, np.ones(len(tire))),
        response=np.concatenate([question.response, moved]),
        tire=tire,
        metadata=np.concatenate([question.metadata, question.metadata[own]]),
        noise=np.full(3, 4e-4),
        alone=np.full(3, 1e-4),
    ), own


def test_tires_that_two_categories_measured_do_not_draw_the_classes_together():
    """Their noise is small: one effect of such a tire for all classes would leave these no room to differ."""
    rng = np.random.default_rng(11)
    question, kind = _question(rng, grouped=True)
    question, own = _with_shared_tires(question, rng)
    kind = np.concatenate([kind, kind[own]])
    unsure = 0.7 * np.eye(3)[kind] + 0.1
    assert (refined_classes(question, unsure).probability.argmax(axis=1) == kind).mean() > 0.95


@pytest.mark.parametrize("count", [1, 2, 3])
def test_every_start_gives_each_tire_probabilities(count):
    question, _ = _question(np.random.default_rng(10), grouped=True)
    fewer = np.eye(2)[np.arange(240) % 2]
    every = starts(question, count, fewer if count == 3 else None, 0)
    assert len(every) == {1: 1, 2: 4, 3: 6}[count]
    for start in every:
        assert start.shape == (240, count)
        np.testing.assert_allclose(start.sum(axis=1), 1.0)


def test_tires_without_groups_are_of_one_class():
    question, _ = _question(np.random.default_rng(5), grouped=False)
    classes, probability = find_classes(question)
    assert classes is None
    assert probability.shape == (len(question.response), 1)


def test_few_tires_tell_no_classes():
    question, _ = _question(np.random.default_rng(6), grouped=True, tires=20)
    assert find_classes(question)[0] is None


def test_classes_come_back_from_their_state():
    rng = np.random.default_rng(7)
    classes = TireClasses(np.array([2, 5]), rng.normal(size=(3, 2)), np.array([0.4, 0.6]), np.eye(2))
    back = TireClasses.from_state(classes.to_state())
    metadata, gap = rng.normal(size=(4, 2)), rng.normal(size=(4, 2, 2))
    first, again = (c.probability(metadata, gap, np.ones((4, 2))) for c in (classes, back))
    np.testing.assert_array_equal(first, again)
    np.testing.assert_allclose(first.sum(axis=1), 1.0)


def test_density_is_that_of_a_gaussian():
    own, alone = np.array([[1.0, 0.3], [0.3, 0.5]]), np.array([[0.1, 0.2]])
    gaps = np.array([[[0.4, -0.2], [0.0, 0.0]]])
    covariance = own + np.diag(alone[0])
    expected = -0.5 * gaps[0, 0] @ np.linalg.inv(covariance) @ gaps[0, 0]
    found = log_density(gaps, own, alone)[0]
    assert found[0] - found[1] == pytest.approx(expected)
    assert found[1] == pytest.approx(-0.5 * np.log(np.linalg.det(covariance)))


def test_shares_follow_the_metadata():
    rng = np.random.default_rng(8)
    x = rng.normal(size=(400, 1))
    likely = 1.0 / (1.0 + np.exp(-2.0 * x[:, 0]))
    weights = fit_shares(x, np.stack([1.0 - likely, likely], axis=1))
    assert weights[1, 1] - weights[1, 0] == pytest.approx(2.0, abs=0.15)


def test_a_row_that_counts_twice_is_two_rows():
    rng = np.random.default_rng(9)
    x, y = rng.normal(size=(12, 2)), rng.normal(size=12)
    logs = np.log([0.5, 0.2, 0.1])
    once = Design({"metadata": x}, np.zeros((12, 0)), np.ones(12), np.r_[2.0, np.ones(11)])
    twice = Design({"metadata": np.r_[x[:1], x]}, np.zeros((13, 0)), np.ones(13))
    one, two = (
        MarginalLikelihood(d, v, 0.05).value_and_gradient(logs)
        for d, v in ((once, y), (twice, np.r_[y[:1], y]))
    )
    assert one[0] == pytest.approx(two[0])
    np.testing.assert_allclose(one[1], two[1])
