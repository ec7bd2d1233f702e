"""The environment in which the agent learns."""

import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from tire_pipeline.translation.predict.curiosity import Curiosity
from tire_pipeline.translation.predict.likelihood_environment import (
    LONGEST_MOVE,
    STEPS,
    BatchLikelihoodEnvironment,
    LikelihoodEnvironment,
    Situation,
    potential,
)


def _situation(tires=20, scores=4):
    rng = np.random.default_rng(2)
    return Situation(
        rng.normal(size=(tires, scores)),
        rng.normal(size=(tires, scores)),
        rng.normal(size=(tires, 3)),
        np.ones(scores),
    )


@pytest.mark.filterwarnings("ignore:.*A Box observation space:UserWarning")  # scores have no bounds
def test_gymnasium_accepts_it():
    check_env(LikelihoodEnvironment(_situation()), skip_render_check=True)


def test_the_best_move_is_the_difference_of_expectations():
    situation = _situation()
    rows = np.arange(20)
    best = potential(situation.target, situation, rows)
    rng = np.random.default_rng(4)
    for _ in range(5):
        other = situation.target + 0.2 * rng.normal(size=situation.target.shape)
        assert (potential(other, situation, rows) < best).all()


def test_the_batch_plays_by_the_same_rules():
    situation = _situation()
    batch = BatchLikelihoodEnvironment(situation, 6, seed=1)
    seen = batch.reset()
    single = LikelihoodEnvironment(situation)
    single.reset(seed=0)
    rows = batch.rows.copy()
    rng = np.random.default_rng(0)
    actions = rng.uniform(-1.5, 1.5, size=(STEPS, 6, 4))
    rewards = []
    for step in range(STEPS):
        seen, reward, done, infos = batch.step(actions[step])
        rewards.append(reward)
    assert done.all()
    single.row, single.moved, single.left = rows[[2]], np.zeros((1, 4)), STEPS
    for step in range(STEPS):
        last, reward, over, _, _ = single.step(actions[step, 2])
        np.testing.assert_allclose(reward, rewards[step][2], rtol=1e-4, atol=1e-5)
    assert over
    np.testing.assert_allclose(last, infos[2]["terminal_observation"], rtol=1e-6)
    assert LONGEST_MOVE > 0
    assert seen.shape == (6, situation.observation_size)


def test_what_was_seen_often_is_no_longer_strange():
    curiosity = Curiosity(5, seed=0)
    rng = np.random.default_rng(1)
    known, new = rng.normal(size=(64, 5)), 3.0 + rng.normal(size=(64, 5))
    first = float(curiosity(known).mean() * curiosity.usual)
    for _ in range(300):
        curiosity(known)
    assert curiosity(known).mean() * curiosity.usual < 0.5 * first
    assert curiosity(new).mean() > 2.0 * curiosity(known).mean()
