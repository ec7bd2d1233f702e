"""Mixed effects: gradient of the marginal likelihood, what is found, what shrinks."""

import numpy as np
import pytest

from tire_pipeline.translation.population.mixed_effects import (
    Design,
    MarginalLikelihood,
    fit_mixed_effects,
    posterior_weights,
)


def _design(rng, effect, tires=60):
    organisation = rng.integers(0, 3, tires)
    x = rng.normal(size=(tires, 2))
    indicators = np.eye(3)[organisation]
    response = x @ [0.6, -0.4] + indicators @ np.array([0.0, effect, -effect]) + 0.3 * rng.normal(size=tires)
    blocks = {"level": np.ones((tires, 1)), "metadata": x, "category": indicators}
    return Design(blocks, np.zeros((tires, 0)), rng.integers(1, 5, tires).astype(float)), response


GUESS = {"level": 100.0, "metadata": 0.1, "category": 0.1, "tire": 0.2, "tire_category": 0.02}


def test_gradient_of_the_marginal_likelihood():
    rng = np.random.default_rng(3)
    design, response = _design(rng, 0.5)
    shared = np.zeros((60, 2))
    shared[:2, 0] = shared[2:4, 1] = 1.0
    marginal = MarginalLikelihood(Design(design.blocks, shared, design.files), response, 0.05)
    logs = np.log([5.0, 0.3, 0.2, 0.1, 0.04])
    _, slope = marginal.value_and_gradient(logs)
    for k in range(logs.size):
        step = np.zeros(logs.size)
        step[k] = 1e-5
        up, down = (marginal.value_and_gradient(logs + sign * step)[0] for sign in (1, -1))
        assert slope[k] == pytest.approx((up - down) / 2e-5, rel=1e-4, abs=1e-6)


def test_an_effect_that_is_there_is_found_and_one_that_is_not_shrinks_to_nothing():
    rng = np.random.default_rng(5)
    design, response = _design(rng, 1.0)
    found = fit_mixed_effects(design, response, noise=0.05, guess=GUESS, tire_category=0.02)
    np.testing.assert_allclose(found.mean[4] - found.mean[5], 2.0, atol=0.4)
    design, response = _design(rng, 0.0)
    none = fit_mixed_effects(design, response, noise=0.05, guess=GUESS, tire_category=0.02)
    assert none.variances["category"] < 0.05 * found.variances["category"]
    assert np.abs(none.mean[3:6]).max() < 0.1


def test_known_variances_give_the_same_weights():
    rng = np.random.default_rng(6)
    design, response = _design(rng, 0.7)
    found = fit_mixed_effects(design, response, noise=0.05, guess=GUESS, tire_category=0.02)
    again = posterior_weights(design, response, found.variances)
    np.testing.assert_allclose(again.mean, found.mean, atol=1e-9)
