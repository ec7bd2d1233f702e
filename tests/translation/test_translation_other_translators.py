"""Agents, networks, the greedy forest and doing nothing, on the same small fleet."""

import pandas as pd
import pytest

from tire_pipeline.errors import DomainError
from tire_pipeline.representations.coefficients import LATERAL_WITHOUT_CAMBER
from tire_pipeline.translation.base import judging, make_translator, translator_from_state
from tire_pipeline.translation.learned import CuriousAgent, CycleConsistent, LikelihoodAgent
from tire_pipeline.translation.result import LEFT_ALONE, TRANSLATED
from tire_pipeline.translation.simple.greedy_forest import GreedyForest

pytestmark = pytest.mark.slow


def test_agents_learn_and_come_back(training, made, hidden):
    agent, again = (LikelihoodAgent(updates=4).fit(training, target="D", seed=3, made=made) for _ in range(2))
    translated = agent.translate(hidden)
    pd.testing.assert_frame_equal(translated, again.translate(hidden), check_exact=True)
    back = translator_from_state(agent.to_state())
    pd.testing.assert_frame_equal(translated, back.translate(hidden), check_exact=True)
    curious = CuriousAgent(updates=4).fit(training, target="D", seed=3, made=made)
    assert not curious.translate(hidden).equals(translated)
    strict = agent.with_verdict(farthest=0.5)
    assert (type(strict), strict.categories, strict.target) == (LikelihoodAgent, agent.categories, "D")
    assert (
        strict.translation(hidden, bands=False)
        .report["distance"]
        .equals(agent.translation(hidden, bands=False).report["distance"])
    )


def test_cycle_consistent_networks_move_tires_and_come_back(training, made, hidden):
    found = CycleConsistent(rounds=10).fit(training, target="D", seed=1, made=made)
    translated = found.translate(hidden)
    assert not translated.equals(hidden)
    pd.testing.assert_frame_equal(translated, translator_from_state(found.to_state()).translate(hidden))


def test_greedy_forest_raises_the_probability(training, hidden):
    found = GreedyForest().fit(training, target="D", seed=1)
    translated = found.translate(hidden)
    names = list(LATERAL_WITHOUT_CAMBER)
    before, after = (found.probability(t[names].to_numpy(float)) for t in (hidden, translated))
    assert (after >= before).all()
    assert after.mean() > before.mean() + 0.1
    pd.testing.assert_frame_equal(translated, translator_from_state(found.to_state()).translate(hidden))


@pytest.mark.parametrize("name", ["no_change", "mixed_model", "greedy_forest"])
def test_impossible_targets_are_named(name, training):
    with pytest.raises(DomainError, match=r"target category 'Z'.*one of .*D"):
        make_translator(name).fit(training, target="Z", seed=0)


@pytest.mark.parametrize(("name", "verdict"), [("no_change", LEFT_ALONE), ("greedy_forest", TRANSLATED)])
def test_every_translator_gives_a_verdict(name, verdict, training, hidden, paired):
    found = make_translator(name).fit(training, target="D", seed=0)
    result = found.translation(hidden)
    pd.testing.assert_frame_equal(result.table, found.translate(hidden))
    assert (result.report["verdict"] == verdict).all()
    assert result.report["expected_rms_ratio"].isna().all()
    assert list(result.report) == list(paired.translation(hidden, bands=False).report)


def test_doing_nothing_gives_a_copy(training, hidden):
    found = make_translator("no_change").fit(training, target="D", seed=0)
    assert found.translate(hidden) is not hidden
    pd.testing.assert_frame_equal(found.translate(hidden), hidden)


@pytest.mark.parametrize("name", ["no_change", "greedy_forest"])
def test_a_translator_without_a_model_of_the_bias_is_no_judge(name, training):
    with pytest.raises(DomainError, match=f"{name} gives no verdicts"):
        judging(make_translator(name).fit(training, target="D", seed=0))


def test_a_mixed_model_is_a_judge_and_knows_its_categories(mixed, training):
    assert judging(mixed) is mixed
    assert set(mixed.categories) == set(training["category"])
    with pytest.raises(DomainError, match="not fitted"):
        judging(make_translator("mixed_model"))
