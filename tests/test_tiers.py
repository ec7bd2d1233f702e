"""Lists of tests, by which they run in one tier or early: each line names a test that is there."""

from __future__ import annotations

import re
import time
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

HERE = Path(__file__).parent


def _named() -> set[tuple[str, str]]:
    """Files and tests in them, as the lists have them; no test where a line stands for a file."""
    lines = [line for name in ("ci_only.txt", "known_misses.txt") for line in _lines(HERE / name)]
    first = re.findall(r'^    "([\w/]+\.py)",$', _text(HERE / "conftest.py"), re.MULTILINE)
    assert len(first) > 40
    tests = (line.removeprefix("tests/").partition("[")[0].partition("::") for line in lines)
    return {(file, test) for file, _, test in tests} | {(file, "") for file in first}


def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8")


def _lines(path: Path) -> list[str]:
    return [line for line in _text(path).splitlines() if line.startswith("tests/")]


@pytest.mark.parametrize(("file", "test"), sorted(_named()))
def test_what_a_list_names_is_there(file, test):
    assert (f"def {test}(" if test else "def test_") in _text(HERE / file)


@given(st.just(0.3))
@settings(max_examples=1)
def test_no_example_fails_for_the_time_that_it_takes(seconds):
    time.sleep(seconds)
