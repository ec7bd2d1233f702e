"""Explanations without what takes most of their time: the proof, and what could have been seen."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tire_pipeline.mismatch import Explainer, MismatchReport
from tire_pipeline.mismatch.effects import catalogue


def all_but(*names: str) -> set[str]:
    """All of the catalogue but some effects, to leave out: sets of these few alone are weighed."""
    return set(catalogue()) - set(names)


def beside(*rivals: str):
    """Return a decorator that gives a test ``without``: all but the rivals, and in CI nothing."""
    return pytest.mark.parametrize(
        "without",
        [
            pytest.param(all_but(*rivals), id="rivals"),
            pytest.param(set(), id="catalogue", marks=[pytest.mark.ci, pytest.mark.slow]),
        ],
    )


def named_sets(tire, recording, without=()) -> list[set[str]]:
    """Return the sets of names as ``report.sets`` has them: faults that need no fit, then the posterior's."""
    explained = Explainer(without=set(without)).weigh(tire, recording)
    found = [{finding.name} for finding in explained.prepared.findings]
    return [*found, *(set(names) for names, _ in explained.answer.sets)]


def named(tire, recording, without=()) -> list[str]:
    """Return the names as ``report.effects`` has them: faults that need no fit, then the posterior's."""
    explained = Explainer(without=set(without)).weigh(tire, recording)
    return [*(finding.name for finding in explained.prepared.findings), *explained.answer.names]


def without_visible(report: MismatchReport) -> MismatchReport:
    """Return the report without what could have been seen, which ``test_mismatch_visible.py`` tests."""
    return replace(report, find_visible=list)
