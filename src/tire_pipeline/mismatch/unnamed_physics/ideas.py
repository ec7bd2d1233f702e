"""Ideas to test: physics from a wider list whose drivers and mechanism resemble what was found."""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import cache
from importlib.resources import files
from typing import Any

from tire_pipeline.mismatch.unnamed_physics.found import Idea
from tire_pipeline.mismatch.unnamed_physics.library import Term

_MOST_IDEAS = 3


@cache
def wider_list() -> tuple[dict[str, Any], ...]:
    """Physics with its drivers, ways to act, shape, experiment and source (``ideas.json``)."""
    text = files("tire_pipeline.mismatch.unnamed_physics").joinpath("ideas.json").read_text(encoding="utf-8")
    return tuple(json.loads(text))


def matching(drivers: frozenset[str], terms: Sequence[Term]) -> list[Idea]:
    """Return what resembles the drivers and a way to act, the same drivers first.

    Parameters
    ----------
    drivers : frozenset of str
    terms : sequence of Term
        Of the equation.
    """
    ways = {t.way for t in terms}
    ranked = []
    for entry in wider_list():
        closeness = max(_closeness(drivers, set(d)) for d in entry["drivers"])
        acts = bool(ways & set(entry["ways"]))
        if closeness >= 0.5 and acts:
            too = f"; it depends on {', '.join(sorted(drivers))}, too" if drivers else ""
            why = f"{entry['shape']}{too}"
            ranked.append((closeness, Idea(entry["name"], why, entry["experiment"], entry["source"])))
    ranked.sort(key=lambda pair: -pair[0])
    return [idea for _, idea in ranked[:_MOST_IDEAS]]


def _closeness(found: frozenset[str], listed: set[str]) -> float:
    """Drivers that both have, over those that either has; 1 where neither has any."""
    return len(found & listed) / len(found | listed) if found | listed else 1.0
