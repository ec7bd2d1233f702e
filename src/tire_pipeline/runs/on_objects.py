"""Tickets of runs whose data lies in an object store, where there are neither locks nor renaming.

Of each run there are up to three objects in ``<data>/.runs``: ``<number>.json`` is its note, written only if
that number is free; ``<number>.beat`` changes while it lives; ``<number>.over`` is written once, by the run
when it ends or by another that declares it dead: the first to write it decides.
"""

from __future__ import annotations

import contextlib
import logging
import os
import re
import socket
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime

from tire_pipeline.files.objects import ConflictError, Objects
from tire_pipeline.runs.ticket import BEAT_SECONDS, ENDED, KEPT_TICKETS, TAKEN, LostTicketError, Note
from tire_pipeline.runs.turn import Beats

_LOG = logging.getLogger(__name__)
TICKETS = ".runs"
_OBJECT_NAME = re.compile(rf"{re.escape(TICKETS)}/(\d+)\.(json|beat|over)").fullmatch


class ObjectTicket:
    """This process's own note. Take one with :meth:`draw`, give it back with :meth:`end`."""

    def __init__(self, data: Objects, note: Note) -> None:
        self.data = data
        self.note = note
        self._stop = threading.Event()
        threading.Thread(target=self._keep_beating, name="run ticket", daemon=True).start()

    @classmethod
    def draw(
        cls,
        data: Objects,
        *,
        run: str,
        places: Sequence[str] = (),
        alongside: bool = False,
        beat_seconds: float = BEAT_SECONDS,
    ) -> ObjectTicket:
        """Take the next number.

        Parameters
        ----------
        data : Objects
            The data folder.
        run, places, alongside, beat_seconds
            As in :class:`.ticket.Note`.
        """
        while True:
            note = Note(
                number=max(_states(data), default=0) + 1,
                run=run,
                host=socket.gethostname(),
                pid=os.getpid(),
                started=datetime.now(UTC).isoformat(timespec="seconds"),
                alongside=alongside,
                beat_seconds=beat_seconds,
                places=tuple(places),
            )
            with contextlib.suppress(ConflictError):
                data.create(_name(note.number, "json"), note.to_json())
                return cls(data, note)

    def check(self) -> None:
        """Make sure that this run may still write.

        Raises
        ------
        LostTicketError
            Another run has taken the data folder over; maybe so long ago that nothing of this ticket is left.
        """
        own = self.note.number
        if self.data.exists(_name(own, "over")) or not self.data.exists(_name(own, "json")):
            raise LostTicketError(
                f"another run has taken this data folder over, as this one (number {self.note.number}) "
                "showed no sign of life",
                where=str(self.data),
                todo="run again; this run has stored nothing since",
            )

    def end(self) -> None:
        """Give the ticket back. The number stays taken."""
        self._stop.set()
        with contextlib.suppress(ConflictError):
            self.data.create(_name(self.note.number, "over"), ENDED.encode())
        prune(self.data)

    def _keep_beating(self) -> None:
        beats = 0
        while not self._stop.wait(self.note.beat_seconds):
            beats += 1
            with contextlib.suppress(Exception):  # a store that does not answer now may do so at the next
                self.data.write(_name(self.note.number, "beat"), str(beats).encode())


@dataclass
class OtherRunsOnObjects:
    """What other runs say of themselves, and what becomes of the dead.

    A run is alive if its beat changes, and dead if it stands still for ``expiry_seconds`` of this process's
    own monotonic clock.

    Parameters
    ----------
    ticket : ObjectTicket
    expiry_seconds : float
    monotonic : callable
        For tests.
    """

    ticket: ObjectTicket
    expiry_seconds: float
    monotonic: Callable[[], float] = time.monotonic
    _beats: Beats = field(init=False)

    def __post_init__(self) -> None:
        self._beats = Beats(self.expiry_seconds, self.monotonic)

    @property
    def where(self) -> str:
        """The data folder."""
        return str(self.ticket.data)

    def look(self) -> list[tuple[Note, str]]:
        """Every open note with a lower number and whether its run is ALIVE, DEAD or still UNDECIDED."""
        data, found = self.ticket.data, []
        for number, states in sorted(_states(data).items()):
            if "over" in states or "json" not in states or number >= self.ticket.note.number:
                continue
            with contextlib.suppress(FileNotFoundError):
                note = Note.from_json(number, data.read(_name(number, "json")))
                found.append((note, self._state(note)))
        return found

    def _state(self, note: Note) -> str:
        try:
            beat = self.ticket.data.read(_name(note.number, "beat"))
        except FileNotFoundError:
            beat = b""
        return self._beats.state(note, beat)

    def declare_dead(self, note: Note) -> None:
        """Declare a run dead first, so that it finds out if it is not; then its results go."""
        try:
            self.ticket.data.create(_name(note.number, "over"), TAKEN.encode())
        except ConflictError:  # it has ended meanwhile, or another was faster
            return
        _LOG.warning("An earlier run (%s) was killed; its results are removed.", note.run or note.number)
        take_back_objects(self.ticket.data, note)

    def again(self) -> None:
        """A run that stood still in the middle of a write ends it when it wakes: take that back, too."""
        data = self.ticket.data
        over = {_name(n, "over"): n for n, states in _states(data).items() if {"over", "json"} <= states}
        said = data.read_many(over, most=len(TAKEN))  # many at once: each request takes a while
        for number in (n for name, n in over.items() if said[name] == TAKEN.encode()):
            with contextlib.suppress(FileNotFoundError):
                take_back_objects(data, Note.from_json(number, data.read(_name(number, "json"))))
        prune(data)


def take_back_objects(data: Objects, note: Note) -> None:
    """Delete the versions that a run wrote; a damaged note deletes nothing."""
    for place in note.places:
        if note.run and place.rsplit("/", 1)[-1] == note.run:
            data.delete(data.names(place))


def prune(data: Objects) -> None:
    """Forget all but the last runs that are over."""
    states = _states(data)
    oldest = max(states, default=0) - KEPT_TICKETS
    old = [n for n, kinds in states.items() if n < oldest and "over" in kinds]
    data.delete(_name(number, kind) for number in old for kind in sorted(states[number]))


def _states(data: Objects) -> dict[int, set[str]]:
    """Number -> which of its three objects are there."""
    found: dict[int, set[str]] = {}
    for name in data.names(TICKETS):
        if match := _OBJECT_NAME(name):
            found.setdefault(int(match[1]), set()).add(match[2])
    return found


def _name(number: int, kind: str) -> str:
    return f"{TICKETS}/{number:06d}.{kind}"
