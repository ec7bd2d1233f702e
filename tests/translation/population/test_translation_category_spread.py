"""What categories do to what is a tire's own, and what kind of tire it is."""

import numpy as np
import pytest

from tire_pipeline.translation.population.category_spread import Residuals, category_spreads, shared_cells
from tire_pipeline.translation.population.kinds import TireKinds, with_kinds

SPREAD = np.array([1.0, 0.7, 1.3])
ALONE = np.array([0.05, 0.05, 1.0])
OWN, NOISE, WIDTH = 2.0, 0.05, 0.2


def _measured(rng, shared, single):
    """Gaps of ``shared`` tires that all three measured and ``single`` ones of each."""
    count = shared + 3 * single
    own = rng.normal(0.0, np.sqrt(OWN), count)
    tire = np.concatenate([np.repeat(np.arange(shared), 3), np.arange(shared, count)])
    category = np.concatenate([np.tile(np.arange(3), shared), np.repeat(np.arange(3), single)])
    gap = SPREAD[category] * own[tire] + rng.normal(size=tire.size) * np.sqrt(ALONE[category] + NOISE)
    columns = (tire[:, None] == np.arange(shared)[None, :]).astype(float)
    return Residuals(gap, category, np.full(tire.size, NOISE), shared_cells(columns, category, 3))


def test_spread_and_what_is_alone_are_told_apart_by_tires_that_several_measured(rng):
    spread, alone = category_spreads(_measured(rng, 60, 60), OWN, 0.2, WIDTH)
    np.testing.assert_allclose(spread / spread[0], SPREAD, rtol=0.12)
    assert alone[2] == pytest.approx(1.0, rel=0.5)
    assert (alone[:2] < 0.2).all()


def test_without_such_tires_only_the_sum_is_known_and_what_is_alone_stays_as_expected(rng):
    spread, alone = category_spreads(_measured(rng, 0, 400), OWN, 0.2, WIDTH)
    np.testing.assert_allclose(alone, 0.2, rtol=0.05)
    np.testing.assert_allclose(OWN * spread**2 + alone, OWN * SPREAD**2 + ALONE, rtol=0.25)


def test_three_such_tires_do_not_tell_what_is_alone(rng):
    found = _measured(rng, 3, 100)
    alone = category_spreads(found, OWN, 0.2, WIDTH)[1]
    np.testing.assert_allclose(alone, 0.2, rtol=0.05)


def test_a_fit_that_went_astray_hardly_counts(rng):
    found = _measured(rng, 30, 60)
    spread, alone = category_spreads(found, OWN, 0.2, WIDTH)
    found.gap[found.shared[0, 0]] += 30.0
    again = category_spreads(found, OWN, 0.2, WIDTH)
    np.testing.assert_allclose(again[0], spread, rtol=0.1)
    assert again[1][0] < alone[0] + 0.3


def test_the_narrower_the_width_the_more_alike_categories_spread(rng):
    found = _measured(rng, 8, 20)
    free, held = (category_spreads(found, OWN, 0.2, width)[0] for width in (WIDTH, 0.02))
    assert np.log(held).std() < 0.25 * np.log(free).std()
    assert np.log(held).std() > 0.0


def test_kinds_of_tires_follow_from_expectation_and_from_what_is_measured(rng):
    blocks = {"metadata": rng.normal(size=(50, 3)), "category": np.eye(2)[rng.integers(0, 2, 50)]}
    kinds = TireKinds.find(np.array([0, 1]), blocks["metadata"], rng.normal(size=(3, 2)), 2)
    none = np.zeros((50, 2))
    kind = kinds.of(blocks, none)
    np.testing.assert_allclose(kind.mean(axis=0), 0.0, atol=1e-12)
    np.testing.assert_allclose(kind.T @ kind / 50, np.eye(2), atol=1e-9)
    own = rng.normal(size=(50, 2))
    np.testing.assert_allclose(kinds.of(blocks, own) - kind, own @ kinds.turn, atol=1e-12)
    both = with_kinds(blocks, kind)["category_kind"]
    organisation = blocks["category"].argmax(axis=1)
    np.testing.assert_allclose(both.reshape(50, 2, 2)[np.arange(50), organisation], kind)
    again = TireKinds.from_state(kinds.to_state())
    np.testing.assert_array_equal(again.of(blocks, own), kinds.of(blocks, own))
