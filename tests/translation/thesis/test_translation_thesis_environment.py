import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from tire_pipeline.errors import DomainError
from tire_pipeline.translation.thesis.batch_environment import BatchEnv
from tire_pipeline.translation.thesis.environment import TranslationEnv
from tire_pipeline.translation.thesis.rules import REWARDS, Rules

pytestmark = pytest.mark.slow

FEATURES, BINS = 11, 10


def some_unreal(rng):
    lookup = rng.uniform(size=(2, BINS, BINS, BINS)) < 0.8
    return {"real_features": np.array([[0, 3, 6], [1, 4, 7]]), "real_lookup": lookup}


def staircase(states):
    """A classifier one can do in the head: the target's probability is state[0] / 10."""
    p = np.asarray(states)[:, 0] / 10
    return np.stack([1 - p, p], axis=1)


def simple(reward, start, **options):
    rules = Rules(n_features=2, n_bins=10, target=1, reward=reward, **options)
    env = TranslationEnv(np.array([start]), staircase, rules)
    env.reset(seed=0)
    return env


DOWN_0, UP_0, DOWN_1, UP_1 = range(4)


@pytest.mark.parametrize("reward", REWARDS)
def test_gymnasium_accepts_the_environment(binned, forest, reward):
    rules = Rules(FEATURES, BINS, target=2, reward=reward)
    check_env(TranslationEnv(binned, forest.sums, rules), skip_render_check=True)


def test_reach_target_fast_by_hand():
    env = simple("reach_target_fast", [3, 0])
    state, reward, terminated, truncated, _ = env.step(UP_0)
    assert (list(state), reward, terminated, truncated) == ([4, 0], -0.01, False, False)
    assert env.step(DOWN_1)[1:4] == (-1.0, False, False)
    for _ in range(7):  # wandering does not end the episode
        env.step(UP_1)
    assert env.step(UP_0)[1:4] == (-0.01, False, False)  # 0.5: argmax takes the first class
    assert env.step(UP_0)[1:4] == (1.0, True, False)


def test_maximize_reward_by_hand():
    env = simple("maximize_reward", [3, 5])
    assert env.step(UP_0)[1] == pytest.approx(-0.01 + 0.1)
    assert env.step(DOWN_0)[1] == pytest.approx(-0.01)
    assert env.step(UP_0)[1] == pytest.approx(-0.01)  # only above the best one seen
    assert env.step(UP_0)[1:3] == (pytest.approx(-0.01 + 0.1), False)
    ends = [env.step(UP_1)[2] for _ in range(5)]
    assert ends == [False, False, False, False, True]


def test_out_of_bounds_costs_one_and_stays():
    env = simple("maximize_reward", [9, 0])
    for action, ends in ((UP_0, False), (DOWN_1, False), (UP_0, False), (UP_0, False), (UP_0, True)):
        state, reward, terminated, _, _ = env.step(action)
        assert list(state) == [9, 0]
        assert reward == -1.0
        assert terminated is ends


def test_imaginary_state_costs_a_hundredth_even_at_the_target():
    lookup = np.ones((1, 10, 10, 10), dtype=bool)
    lookup[0, 6] = False
    for reward in REWARDS:
        rules = Rules(3, 10, target=1, reward=reward, real_features=np.array([[0, 1, 2]]), real_lookup=lookup)
        env = TranslationEnv(np.array([[5, 0, 0]]), staircase, rules)
        env.reset(seed=0)
        state, got, terminated, _, _ = env.step(UP_0)
        assert (state[0], got, terminated) == (6, -0.01, False)
        gained = 1.0 if reward == "reach_target_fast" else pytest.approx(-0.01 + 0.2)
        assert env.step(UP_0)[1] == gained


def test_episode_is_cut_off_after_max_steps():
    env = simple("reach_target_fast", [0, 5], max_steps=3)
    assert [env.step(a)[2:4] for a in (UP_1, DOWN_1, UP_1)] == [
        (False, False),
        (False, False),
        (False, True),
    ]


@pytest.mark.parametrize("reward", REWARDS)
@pytest.mark.parametrize("unreal", [False, True])
def test_batch_does_what_the_single_environment_does(binned, forest, rng, reward, unreal):
    rules = Rules(
        FEATURES, BINS, target=2, reward=reward, max_steps=30, **(some_unreal(rng) if unreal else {})
    )
    n = 4
    batch = BatchEnv(binned, forest, rules, n_envs=n, seed=7)
    singles = [TranslationEnv(binned, forest.sums, rules) for _ in range(n)]
    states = batch.reset()
    for index, env in enumerate(singles):
        start, _ = env.reset(options={"row": int(batch.rows[index])})
        np.testing.assert_array_equal(start, states[index])
    ended = 0
    for _ in range(600):
        actions = rng.integers(0, rules.n_actions, n)
        states, rewards, dones, infos = batch.step(actions)
        for index, env in enumerate(singles):
            state, reward_, terminated, truncated, _ = env.step(actions[index])
            assert rewards[index] == pytest.approx(reward_, abs=1e-12)
            assert dones[index] == (terminated or truncated)
            if dones[index]:
                ended += 1
                np.testing.assert_array_equal(infos[index]["terminal_observation"], state)
                assert infos[index]["TimeLimit.truncated"] == truncated
                state, _ = env.reset(options={"row": int(batch.rows[index])})
            np.testing.assert_array_equal(states[index], state)
    assert ended > 20
    assert len(batch.episodes) == ended


def test_unknown_reward_is_refused():
    with pytest.raises(DomainError, match="maximize_reward"):
        Rules(2, 10, target=0, reward="be_good")
