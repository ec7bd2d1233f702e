"""Errors of stiffness and shape of one fit belong together, and prediction makes use of it."""

import numpy as np
import pytest

from tire_pipeline.translation.population.fit_links import Deviations, FitLinks, find_links, linked_blocks
from tire_pipeline.translation.population.mixed_effects import Fitted
from tire_pipeline.translation.population.score_prediction import CategoryReading, predict_block

SLICES = {
    "cornering stiffness": slice(0, 1),
    "lateral friction": slice(1, 2),
    "lateral shape": slice(2, 3),
    "slip stiffness": slice(3, 4),
    "longitudinal shape": slice(4, 5),
}
OWN, ERROR, TOLD = 1.0, 0.3, 0.7  # variances, and correlation of the errors of stiffness and shape


def _correlated(rng, rows, correlation, variance):
    """Two scores that belong together, and three that do not."""
    covariance = np.eye(5)
    covariance[0, 2] = covariance[2, 0] = correlation
    return rng.multivariate_normal(np.zeros(5), variance * covariance, rows)


def _deviations(rng, cells=4000, repeats=400, shared=48):
    own = _correlated(rng, cells, -0.4, OWN)
    return Deviations(
        own + _correlated(rng, cells, TOLD, ERROR),
        _correlated(rng, repeats, TOLD, ERROR),
        _correlated(rng, shared, TOLD, ERROR),
        np.full(5, OWN),
        np.full(5, ERROR),
    )


def test_every_score_stands_in_one_block_and_friction_alone():
    blocks = linked_blocks(SLICES)
    assert sorted(np.concatenate(blocks)) == [0, 1, 2, 3, 4]
    assert [list(block) for block in blocks] == [[0, 2], [3, 4], [1]]


def test_both_correlations_are_found(rng):
    links = find_links(_deviations(rng), linked_blocks(SLICES))
    assert links.error[0, 2] == pytest.approx(TOLD, abs=0.12)
    assert links.own[0, 2] == pytest.approx(-0.4, abs=0.15)
    assert abs(links.error[3, 4]) < 0.12
    assert (links.error[1, [0, 2, 3, 4]] == 0.0).all()


@pytest.mark.parametrize(("repeats", "shared"), [(400, 0), (0, 48)])
def test_either_sort_of_rows_tells_the_errors(rng, repeats, shared):
    links = find_links(_deviations(rng, repeats=repeats, shared=shared), linked_blocks(SLICES))
    assert links.error[0, 2] == pytest.approx(TOLD, abs=0.25)


def test_outliers_count_by_their_rank_only(rng):
    found = _deviations(rng)
    found.repeats[:8, 0] *= 200.0
    links = find_links(found, linked_blocks(SLICES))
    assert links.error[0, 2] == pytest.approx(TOLD, abs=0.15)


def test_without_rows_nothing_is_linked(rng):
    links = find_links(_deviations(rng, repeats=5, shared=5), linked_blocks(SLICES))
    np.testing.assert_array_equal(links.error, np.eye(5))
    np.testing.assert_array_equal(links.own, np.eye(5))


def test_a_state_from_before_there_were_links_has_none(rng):
    links = find_links(_deviations(rng), linked_blocks(SLICES))
    again = FitLinks.from_state(links.to_state(), 5)
    np.testing.assert_array_equal(again.error, links.error)
    np.testing.assert_array_equal(FitLinks.from_state({}, 5).own, np.eye(5))


def _fitted(shift):
    """Level and source's bias are known: regressors are a 1 and whether the source measures."""
    variances = {"tire": OWN, "tire_category": 0.1, "noise": ERROR - 0.1}
    return tuple(Fitted(variances, np.array([0.0, one]), np.zeros((2, 2))) for one in shift)


def _predict(source, own_link, error_link, trust=1.0):
    n = len(source)
    here, there = np.tile([1.0, 1.0], (n, 1)), np.tile([1.0, 0.0], (n, 1))
    same = np.zeros(n, dtype=bool)
    ones, alone = np.ones((n, 2)), np.full((n, 2), 0.1)
    reading = CategoryReading(ones, np.ones(2), alone, alone[0], same, own_link, error_link)
    return predict_block(_fitted([2.0, -1.0]), source, [here], [there], np.ones((n, 1)), trust, reading)


def test_shape_tells_of_the_stiffness_error_and_the_stated_variance_is_the_errors(rng):
    links = np.array([[1.0, TOLD], [TOLD, 1.0]])
    own_link = np.array([[1.0, -0.4], [-0.4, 1.0]])
    own = rng.multivariate_normal(np.zeros(2), OWN * own_link, 20000)
    source, target = (own + rng.multivariate_normal(np.zeros(2), ERROR * links, 20000) for _ in range(2))
    source += np.array([2.0, -1.0])
    error = {}
    for name, found in (
        ("linked", _predict(source, own_link, links)),
        ("alone", _predict(source, np.eye(2), np.eye(2))),
    ):
        error[name] = ((found[2] - target) ** 2).mean(axis=0)
        if name == "linked":
            np.testing.assert_allclose(found[3].mean(axis=0), error[name], rtol=0.03)
    slopes = np.linalg.lstsq(source - [2.0, -1.0], target, rcond=None)[0]
    best = ((target - (source - [2.0, -1.0]) @ slopes) ** 2).mean(axis=0)
    np.testing.assert_allclose(error["linked"], best, rtol=0.01)
    assert (error["linked"] < 0.95 * error["alone"]).all()


def test_unlinked_scores_are_drawn_by_as_much_as_they_are_error():
    source = np.array([[3.0, 0.0]])
    shift, _, target, variance, surprise, expected = _predict(source, np.eye(2), np.eye(2))
    np.testing.assert_allclose(shift, [[-2.0, 1.0]])
    np.testing.assert_allclose(expected, 0.0)
    share = OWN / (OWN + ERROR)
    np.testing.assert_allclose(target, [[share, share]])
    np.testing.assert_allclose(variance, OWN + ERROR - share * OWN)
    np.testing.assert_allclose(surprise, np.array([[1.0, 1.0]]) / np.sqrt(OWN + ERROR))


def test_without_trust_a_file_keeps_what_is_its_own():
    links = np.array([[1.0, TOLD], [TOLD, 1.0]])
    target = _predict(np.array([[3.0, 0.5]]), links, links, trust=0.0)[2]
    np.testing.assert_allclose(target, [[1.0, 1.5]])


def test_files_without_any_noise_have_no_correlation_of_errors():
    """Scores that repeat each other exactly, and one that is the same everywhere, end in numbers."""
    rng = np.random.default_rng(3)
    cells = _correlated(rng, 60, -0.4, OWN)
    cells[:, 2] = 0.0
    still = Deviations(
        cells, np.zeros((30, 5)), np.zeros((30, 5)), np.array([1.0, 1.0, 0.0, 1.0, 1.0]), np.zeros(5)
    )
    links = find_links(still, linked_blocks(SLICES))
    np.testing.assert_array_equal(links.own, np.eye(5))
    np.testing.assert_array_equal(links.error, np.eye(5))
