"""A clock that is turned by hand, and what a run that is no more has left."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from tire_pipeline.runs import Note, Ticket, take_turn


class Clock:
    """Monotonic seconds that pass only while somebody sleeps; something may happen meanwhile."""

    def __init__(self, meanwhile=lambda now: None):
        self.now = 1000.0
        self.meanwhile = meanwhile

    def monotonic(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.now += seconds
        self.meanwhile(self.now)


def left_by_a_dead_run(runs: Path, number: int = 1, **more) -> Note:
    """The note and results of a run that is no more."""
    note = Note(number, run="old", host="elsewhere", boot="another", device=1, locked=True)
    note = replace(note, places=("table.csv/old",), **more)
    runs.mkdir(parents=True, exist_ok=True)
    (runs / f"{number:06d}.json").write_bytes(note.to_json())
    (runs.parent / "table.csv/old").mkdir(parents=True)
    return note


def wait_for_turn(ticket: Ticket, clock: Clock | None = None, **more) -> None:
    clock = clock or Clock()
    take_turn(ticket, monotonic=clock.monotonic, sleep=clock.sleep, **more)
