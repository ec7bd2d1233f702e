from importlib import import_module

import pytest

from tire_pipeline.errors import DomainError
from tire_pipeline.files.state_files import prefixed, without_prefix
from tire_pipeline.translation.base import TRANSLATORS, make_translator

RELEASED = (
    "agent",
    "no_change",
    "mixed_model",
    "greedy_forest",
    "likelihood_agent",
    "curious_agent",
    "cycle_consistent",
)
"""What a stored translator says of its class. Modules may move: no state names one. These names stay."""

FORMER = {
    "paired_mixed_model": "pairs: true, learn_from_batch: false",
    "batch_mixed_model": "pairs: false, learn_from_batch: true",
    "paired_batch_mixed_model": "pairs: true, learn_from_batch: true",
}


def test_prefixes_nest():
    state = {**prefixed("a", {"x": 1}), **prefixed("ab", {"x": 2})}
    assert without_prefix("a", state) == {"x": 1}
    assert without_prefix("ab", state) == {"x": 2}


@pytest.mark.parametrize("name", RELEASED)
def test_names_in_stored_translators_lead_to_their_class(name):
    module, cls = TRANSLATORS[name]
    assert getattr(import_module(module), cls).name == name


@pytest.mark.parametrize("name", FORMER)
def test_a_former_name_says_what_to_write_instead(name):
    with pytest.raises(DomainError) as caught:
        make_translator(name)
    assert caught.value.todo == f"write translator: mixed_model with {FORMER[name]}"
