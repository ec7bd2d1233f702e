"""Whether a category measures otherwise than the target: told by evidence, apart from what its tires are."""

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from tire_pipeline.translation.population.evidence import CATEGORY_BLOCKS, log_odds_of_difference
from tire_pipeline.translation.population.mixed_effects import Design, fit_mixed_effects

GUESS = {"level": 100.0, "category": 0.1, "category_metadata": 0.01, "population": 0.03}
GUESS |= {"tire": 0.2, "tire_category": 0.02}


def _measured(rng, bias, makes=(0.0, 0.0, 0.0), shared=10, alone=60):
    """Scores of tires that one of three categories measured, and of some that all did."""
    category = np.concatenate([np.repeat(np.arange(3), alone), np.tile(np.arange(3), shared)])
    tire = np.concatenate([np.arange(3 * alone), np.repeat(3 * alone + np.arange(shared), 3)])
    own = 0.5 * rng.normal(size=3 * alone + shared)
    own[: 3 * alone] += np.repeat(makes, alone)
    response = own[tire] + np.array(bias)[category] + 0.1 * rng.normal(size=len(category))
    links = (tire[:, None] == (3 * alone + np.arange(shared))[None, :]).astype(float)
    member, x = np.eye(3)[category], rng.normal(size=(tire.max() + 1, 1))[tire]
    blocks = {
        "level": np.ones((len(category), 1)),
        "category": member,
        "category_metadata": member * x,
        "population": member * (links.sum(axis=1) == 0)[:, None],
    }
    return Design(blocks, links, np.ones(len(category))), response


def _fit(design, response):
    guess = {name: GUESS[name] for name in (*design.blocks, "tire", "tire_category")}
    return fit_mixed_effects(design, response, noise=0.01, guess=guess)


COLUMNS = {"category": slice(1, 4), "category_metadata": slice(4, 7)}


def test_the_odds_are_the_density_of_an_equal_effect_before_over_after():
    found = _fit(*_measured(np.random.default_rng(1), (0.0, 0.2, 0.0)))
    contrast = np.zeros((2, found.mean.size))
    contrast[0, [2, 1]] = contrast[1, [5, 4]] = 1.0, -1.0
    before = np.diag([2.0 * found.variances[name] for name in CATEGORY_BLOCKS[:2]])
    after = contrast @ found.covariance @ contrast.T
    odds = multivariate_normal.logpdf(np.zeros(2), np.zeros(2), before)
    odds -= multivariate_normal.logpdf(np.zeros(2), contrast @ found.mean, after)
    assert log_odds_of_difference(found, COLUMNS, 3, 1, 0) == pytest.approx(odds, abs=1e-6)


def test_the_one_that_measures_as_the_target_is_told_from_one_that_does_not():
    odds = []
    for seed in range(8):
        found = _fit(*_measured(np.random.default_rng(seed), (0.0, 0.0, 0.6)))
        odds.append([log_odds_of_difference(found, COLUMNS, 3, k, 0) for k in (1, 2)])
    same, other = np.transpose(odds)
    assert np.median(same) < -0.5
    assert other.min() > 3.0


def test_a_supplier_that_makes_other_tires_is_not_taken_for_one_that_measures_otherwise():
    gaps = {True: [], False: []}
    for seed in range(8):
        design, response = _measured(np.random.default_rng(seed), (0.0, 0.0, 0.0), (0.0, 0.4, -0.4))
        for apart in gaps:
            blocks = {k: v for k, v in design.blocks.items() if apart or k != "population"}
            mean = _fit(Design(blocks, design.tire, design.files), response).mean
            gaps[apart].append(np.abs(mean[2:4] - mean[1]).mean())
    assert np.mean(gaps[True]) < 0.05
    assert np.mean(gaps[False]) > 2.0 * np.mean(gaps[True])
