"""Tickets of runs of one data folder."""

from __future__ import annotations

import pytest

from tire_pipeline.runs import Ticket
from tire_pipeline.runs import ticket as tickets


@pytest.fixture
def runs(tmp_path):
    return tmp_path / "data" / ".runs"


@pytest.fixture
def draw(runs):
    drawn = []

    def draw(run="run", **more) -> Ticket:
        drawn.append(Ticket.draw(runs, run=run, **more))
        return drawn[-1]

    yield draw
    for each in drawn:
        each.end()


@pytest.fixture
def no_locks(monkeypatch):
    """A file system that has no locks."""
    monkeypatch.setattr(tickets, "system_lock", lambda *_, **__: None)
    monkeypatch.setattr("tire_pipeline.runs.turn.is_held", lambda path: None)
