import subprocess
import sys
import tempfile

import numpy as np
import pytest
from scipy.special import softmax

from tire_pipeline.errors import DomainError
from tire_pipeline.files.state_files import pack_state, unpack_state
from tire_pipeline.representations.coefficients import LATERAL_WITHOUT_CAMBER
from tire_pipeline.tire_table.binning import Binning
from tire_pipeline.translation import make_translator, translator_from_state
from tire_pipeline.translation.thesis.batch_environment import BatchEnv
from tire_pipeline.translation.thesis.policy import GreedyPolicy
from tire_pipeline.translation.thesis.roll_out import roll_out
from tire_pipeline.translation.thesis.rules import Rules
from tire_pipeline.translation.thesis.training import make_model, train_agent

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def translator(table):
    made = make_translator("agent", n_bins=10, total_steps=20_000)
    return made.fit(table, target="C", seed=0)


def test_agent_learns(translator):
    rewards = translator.learning_curve["reward"]
    assert rewards.tail(100).mean() > rewards.head(100).mean() + 0.3


def test_agent_raises_the_probability_of_the_target(translator, table):
    source = table[table["category"] != "C"]
    result = translator.follow(source)
    assert (result.valuations >= result.start_valuations).all()
    assert result.reached.mean() > 0.5
    assert result.action_counts.sum() > 0
    assert len(translator.action_names) == len(result.action_counts) == 22


def test_only_what_moved_changes(translator, table):
    source = table[table["category"] != "C"].head(50)
    translated = translator.translate(source)
    names = list(LATERAL_WITHOUT_CAMBER)
    others = [c for c in table.columns if c not in names]
    assert translated[others].equals(source[others])
    bins = Binning.fit(table[names].to_numpy(), 10)
    steps = translator.follow(source).states - bins.transform(source[names].to_numpy())
    expected = source[names].to_numpy() + steps * (bins.high - bins.low) / 10
    np.testing.assert_allclose(translated[names].to_numpy(), expected, rtol=1e-12)
    still = steps == 0
    np.testing.assert_array_equal(translated[names].to_numpy()[still], source[names].to_numpy()[still])
    assert not still.all()


def test_stored_translator_translates_the_same(translator, table):
    again = translator_from_state(unpack_state(pack_state(translator.to_state())))
    source = table.head(40)
    assert again.translate(source).equals(translator.translate(source))


def test_half_a_stored_translator_is_refused(translator):
    stored = pack_state(translator.to_state())
    with pytest.raises(DomainError, match="damaged"):
        unpack_state(stored[: len(stored) // 2])


@pytest.mark.parametrize("representation", ["key_attributes", "power_series", "latent"])
def test_other_representations_train_and_translate(table, representation):
    options = {"epochs": 3} if representation == "latent" else {}
    made = make_translator(
        "agent",
        representation=representation,
        representation_options=options,
        reward="maximize_reward",
        algorithm="A2C",
        n_bins=10,
        total_steps=2_000,
    ).fit(table, target="A", seed=1)
    translated = made.translate(table.head(10))
    assert np.isfinite(translated[list(LATERAL_WITHOUT_CAMBER)].to_numpy()).all()
    assert made.translate_curves(table.head(10)).shape == (10, 3, 100)


def test_power_series_knows_its_imaginary_states(table):
    from tire_pipeline.representations import make_representation
    from tire_pipeline.translation.thesis.real_states import real_states

    representation = make_representation("power_series").fit(table)
    features = representation.encode(table)
    bins = Binning.fit(features, 12)
    groups, lookup = real_states(representation, bins)
    assert 0 < lookup.mean() < 1
    rules = Rules(12, 12, target=0, real_features=groups, real_lookup=lookup)
    states = np.random.default_rng(0).integers(0, 12, size=(500, 12))
    expected = representation.is_real(bins.inverse(states))
    assert 0 < expected.mean() < 1
    assert [rules.is_real(state) for state in states] == list(expected)


def test_greedy_policy_is_that_of_stable_baselines3(binned, forest):
    rules = Rules(11, 10, target=2)
    env = BatchEnv(binned, forest, rules, n_envs=4, seed=0)
    model = make_model(env, algorithm="PPO", seed=0)
    model.policy.action_net.weight.data.mul_(100.0)  # a policy that has learnt nothing has logits of 0.01
    greedy = GreedyPolicy.from_model(model, 10)
    expected, _ = model.predict(binned, deterministic=True)
    np.testing.assert_array_equal(greedy.actions(binned), expected)
    observed, _ = model.policy.obs_to_tensor(binned)
    probabilities = model.policy.get_distribution(observed).distribution.probs.detach().numpy()
    np.testing.assert_allclose(softmax(greedy.scores(binned), axis=1), probabilities, rtol=1e-5)


@pytest.mark.parametrize(
    ("algorithm", "reward"),
    [
        ("PPO", "reach_target_fast"),
        ("A2C", "maximize_reward"),
        pytest.param("PPO", "maximize_reward", marks=pytest.mark.long),
        pytest.param("A2C", "reach_target_fast", marks=pytest.mark.long),
    ],
)
def test_same_seed_same_agent(binned, forest, algorithm, reward):
    rules = Rules(11, 10, target=1, reward=reward)
    first, again = (
        train_agent(binned, forest, rules, algorithm=algorithm, total_steps=1_500, seed=4) for _ in range(2)
    )
    for (w, b), (w2, b2) in zip(first.policy.layers, again.policy.layers, strict=True):
        np.testing.assert_array_equal(w, w2)
        np.testing.assert_array_equal(b, b2)
    assert first.learning_curve.equals(again.learning_curve)


def test_training_leaves_nothing_in_the_systems_folder(binned, forest, tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    train_agent(binned, forest, Rules(11, 10, target=1), algorithm="PPO", total_steps=1_300, seed=4)
    assert not list(tmp_path.glob("SB3*"))


def test_roll_out_keeps_the_best_state(binned, forest):
    class AlwaysUp:
        def actions(self, states):
            return np.full(len(states), 1)

    rules = Rules(11, 10, target=2, reward="maximize_reward")
    result = roll_out(AlwaysUp(), binned[:60], forest, rules)
    for start, end, valuation in zip(binned[:60], result.states, result.valuations, strict=True):
        path = np.repeat(start[None], 12, axis=0)
        path[:, 0] = np.minimum(start[0] + np.arange(12), 9)
        seen = forest.sums(path)[:, 2]
        assert list(end[1:]) == list(start[1:])
        assert valuation <= seen.max() + 1e-12
        assert valuation >= seen[:5].max() - 1e-12


def test_tire_at_the_target_stays_with_reach_target_fast(translator, table):
    names = list(LATERAL_WITHOUT_CAMBER)
    own = table[table["category"] == "C"]
    at_target = own[translator.follow(own).start_valuations > 0.5]
    assert len(at_target) > 20
    assert translator.translate(at_target)[names].equals(at_target[names])


def test_bad_targets_and_names(table):
    with pytest.raises(DomainError, match="A, B, C"):
        make_translator("agent").fit(table, target="Z", seed=0)
    with pytest.raises(DomainError, match="at least one other"):
        make_translator("agent").fit(table[table["category"] == "A"], target="A", seed=0)
    with pytest.raises(DomainError, match="agent"):
        make_translator("crystal ball")
    with pytest.raises(DomainError, match="PPO, A2C"):
        make_translator("agent", algorithm="DQN", n_bins=10).fit(table, target="A", seed=0)
    with pytest.raises(DomainError, match="not trained"):
        make_translator("agent").translate(table)


def test_import_needs_nothing_heavy():
    code = (
        "import sys, tire_pipeline.translation, tire_pipeline.translation.thesis.translator;"
        "sys.exit(bool({'torch', 'stable_baselines3', 'sklearn'} & set(sys.modules)))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
