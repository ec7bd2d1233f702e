import subprocess
import sys

import numpy as np
import pytest
import torch

from tire_pipeline.errors import DomainError
from tire_pipeline.representations.coefficients import LATERAL_WITHOUT_CAMBER
from tire_pipeline.state_files import pack_state, unpack_state
from tire_pipeline.tire_table.bins import Binning
from tire_pipeline.translation import make_translator, translator_from_state
from tire_pipeline.translation.thesis.batch_environment import BatchEnv
from tire_pipeline.translation.thesis.policy import GreedyPolicy
from tire_pipeline.translation.thesis.roll_out import roll_out
from tire_pipeline.translation.thesis.rules import REWARDS, Rules
from tire_pipeline.translation.thesis.training import make_model, train_agent


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
    greedy = GreedyPolicy.from_model(model, 10)
    expected, _ = model.predict(binned, deterministic=True)
    np.testing.assert_array_equal(greedy.actions(binned), expected)


def test_bin_policy_computes_what_mlp_policy_computes(binned, forest):
    from stable_baselines3 import PPO

    rules = Rules(11, 10, target=2)
    ours = make_model(BatchEnv(binned, forest, rules, n_envs=4, seed=0), algorithm="PPO", seed=3)
    theirs = PPO("MlpPolicy", BatchEnv(binned, forest, rules, n_envs=4, seed=0), seed=3)
    expected = dict(theirs.policy.named_parameters())
    for name, part in ours.policy.mlp_parameters().items():
        assert torch.equal(part, expected.pop(name))
    assert not expected
    with torch.no_grad():  # larger weights, so that tanh saturates somewhere
        ours.policy.weights *= 8
        for part in theirs.policy.parameters():
            part *= 8
    states = torch.as_tensor(binned[:64])
    actions = torch.arange(64).float() % rules.n_actions
    losses = []
    for policy in (ours.policy, theirs.policy):
        values, logs, entropy = policy.evaluate_actions(states, actions)
        losses.append((values.flatten() * 2 + logs + 3 * entropy).square().mean())
        losses[-1].backward()
    torch.testing.assert_close(losses[0], losses[1], rtol=1e-5, atol=1e-7)
    got = ours.policy.mlp_parameters(ours.policy.weights.grad)
    for name, part in theirs.policy.named_parameters():
        scale = float(part.grad.abs().max())
        torch.testing.assert_close(got[name], part.grad, rtol=1e-4, atol=1e-5 * scale)
    torch.testing.assert_close(ours.policy.predict_values(states), theirs.policy.predict_values(states))
    for a, b in zip(ours.policy(states, True), theirs.policy(states, True), strict=True):
        torch.testing.assert_close(a, b)


def test_flat_adam_is_torchs_adam():
    from tire_pipeline.translation.thesis.flat_adam import FlatAdam

    start = torch.linspace(-2, 2, 500)
    made = []
    for cls in (FlatAdam, torch.optim.Adam):
        weights = torch.nn.Parameter(start.clone())
        optimizer = cls([weights], lr=3e-2, eps=1e-5)
        for step in range(30):
            optimizer.zero_grad()
            ((weights - 0.3).pow(4) * (1 + step % 3)).sum().backward()
            optimizer.step()
        made.append(weights.detach())
    assert (made[0] - start).abs().max() > 0.5
    torch.testing.assert_close(made[0], made[1], rtol=1e-4, atol=1e-5)


@pytest.mark.parametrize("entropy_weight", [0.0, 0.05])
def test_compiled_update_is_that_of_stable_baselines3(binned, forest, entropy_weight):
    from stable_baselines3 import PPO

    from tire_pipeline.translation.thesis.bin_policy import BinPolicy
    from tire_pipeline.translation.thesis.compiled_update import CompiledPPO
    from tire_pipeline.translation.thesis.flat_adam import FlatAdam

    rules = Rules(11, 10, target=2)
    trained, start = [], None
    for cls in (CompiledPPO, PPO):
        optimizer = {"optimizer_class": FlatAdam} if cls is CompiledPPO else {}
        env = BatchEnv(binned, forest, rules, n_envs=4, seed=0)
        options = {"n_steps": 90, "ent_coef": entropy_weight, "seed": 3, "learning_rate": 3e-3}
        model = cls(BinPolicy, env, policy_kwargs=optimizer, **options)
        start = model.policy.weights.detach().clone()
        # one roll-out of 360 rows: ten epochs of five full minibatches and one of 40
        model.learn(360)
        trained.append(model.policy.weights.detach())
    assert (trained[1] - start).abs().max() > 0.05
    torch.testing.assert_close(trained[0], trained[1], rtol=0, atol=2e-4)


def test_bin_policy_draws_actions_as_often_as_they_are_probable(binned, forest):
    rules = Rules(11, 10, target=2)
    model = make_model(BatchEnv(binned, forest, rules, n_envs=4, seed=0), algorithm="A2C", seed=3)
    with torch.no_grad():
        model.policy.weights *= 5
    state = torch.as_tensor(binned[:1]).repeat(40_000, 1)
    actions, _, logs = model.policy(state)
    share = torch.bincount(actions, minlength=rules.n_actions) / len(actions)
    probability = torch.zeros(rules.n_actions)
    probability[actions] = logs.exp()
    assert probability.sum() > 0.999
    torch.testing.assert_close(share, probability, rtol=0, atol=0.012)


@pytest.mark.parametrize("reward", REWARDS)
@pytest.mark.parametrize("algorithm", ["PPO", "A2C"])
def test_same_seed_same_agent(binned, forest, algorithm, reward):
    rules = Rules(11, 10, target=1, reward=reward)
    first, again = (
        train_agent(binned, forest, rules, algorithm=algorithm, total_steps=1_500, seed=4) for _ in range(2)
    )
    for (w, b), (w2, b2) in zip(first.policy.layers, again.policy.layers, strict=True):
        np.testing.assert_array_equal(w, w2)
        np.testing.assert_array_equal(b, b2)
    assert first.learning_curve.equals(again.learning_curve)


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
