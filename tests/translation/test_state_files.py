from importlib import import_module

import pytest

from tire_pipeline.state_files import prefixed, without_prefix
from tire_pipeline.translation import TRANSLATORS

RELEASED = (
    "agent",
    "no_change",
    "mixed_model",
    "greedy_forest",
    "likelihood_agent",
    "curious_agent",
    "cycle_consistent",
    "paired_mixed_model",
    "batch_mixed_model",
    "paired_batch_mixed_model",
)
"""What a stored translator says of its class. Modules may move: no state names one. These names stay."""


def test_prefixes_nest():
    state = {**prefixed("a", {"x": 1}), **prefixed("ab", {"x": 2})}
    assert without_prefix("a", state) == {"x": 1}
    assert without_prefix("ab", state) == {"x": 2}


@pytest.mark.parametrize("name", RELEASED)
def test_names_in_stored_translators_lead_to_their_class(name):
    module, cls = TRANSLATORS[name]
    assert getattr(import_module(module), cls).name == name
