"""Tests known to fail stand in ``known_misses.txt``; what `make quick` leaves out is marked slow."""

from __future__ import annotations

from pathlib import Path

import pytest

_KNOWN = Path(__file__).with_name("known_misses.txt")
_REASON = "known miss since 2026-11-23 (tests/known_misses.txt): other verdicts with the misfit of real tires"

_HERE = Path(__file__).parent
_SLOW_FOLDERS = frozenset(
    ("cluster", "concealed", "mismatch", "notebooks", "object_storage", "pipelines", "thesis", "viz")
)
"""Whole runs, browsers, simulators and explanations. Elsewhere the slow files say so themselves."""


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Do not import the slow folders where no slow test is wanted."""
    slow = collection_path.parent == _HERE and collection_path.name in _SLOW_FOLDERS
    return True if slow and "not slow" in config.option.markexpr else None


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark the known misses as expected failures, and the slow folders as slow."""
    known = {line for line in _KNOWN.read_text(encoding="utf-8").splitlines() if line.startswith("tests/")}
    for item in items:
        if item.nodeid in known:
            item.add_marker(pytest.mark.xfail(reason=_REASON, strict=False))
        folder = item.path.relative_to(_HERE).parts[0]
        if folder in _SLOW_FOLDERS:
            item.add_marker(pytest.mark.slow)
