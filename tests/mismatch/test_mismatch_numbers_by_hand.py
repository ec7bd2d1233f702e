"""Numbers that are set by hand in the explanation engine: each has a name and says what it is."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

SCRIPT = Path(__file__).parents[2] / "tools" / "numbers_by_hand.py"
MOST = 99
"""As docs/decisions/explanation_engine.md says; the goal is ten."""


def _listed():
    spec = importlib.util.spec_from_file_location("numbers_by_hand", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = sys.modules[spec.name] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.numbers()


def test_each_number_by_hand_has_a_name_and_says_what_it_is():
    assert [f"{n.file}:{n.line}" for n in _listed() if not n.name or not n.why] == []


def test_there_are_no_more_numbers_by_hand():
    assert 0 < len(_listed()) <= MOST
