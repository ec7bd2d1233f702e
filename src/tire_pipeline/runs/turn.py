"""A run's turn on a data folder: what is dead is cleared away, what is alive is named or waited for."""

from __future__ import annotations

import contextlib
import logging
import os
import shutil
import time
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from tire_pipeline.errors import DomainError
from tire_pipeline.files.atomic import remove_temporary
from tire_pipeline.runs.system_lock import is_held
from tire_pipeline.runs.ticket import CLEARED, TAKEN, Note, Ticket, open_notes, prune, retire

_LOG = logging.getLogger(__name__)
EXPIRY_SECONDS = 30.0
_POLL_SECONDS = 0.5
_BEATS = 4.0  # a run is not declared dead before it has missed so many of its own beats
ALIVE, DEAD, UNDECIDED = "alive", "dead", "undecided"


@dataclass
class Beats:
    """Tells from the beats of runs alone whether they live: they move, or stand still for long enough.

    Parameters
    ----------
    expiry_seconds : float
    monotonic : callable
        For tests.
    """

    expiry_seconds: float
    monotonic: Callable[[], float]
    _seen: dict[int, tuple[Hashable, float, bool]] = field(default_factory=dict)

    def state(self, note: Note, beat: Hashable) -> str:
        """ALIVE, DEAD or UNDECIDED, from what the beat of a run is now."""
        now = self.monotonic()
        before, since, moved = self._seen.get(note.number, (beat, now, False))
        if beat != before:
            before, since, moved = beat, now, True
        self._seen[note.number] = (before, since, moved)
        if now - since >= max(self.expiry_seconds, _BEATS * note.beat_seconds):
            return DEAD
        return ALIVE if moved else UNDECIDED


@dataclass
class Watch:
    """Tells dead runs from living ones.

    A run whose lock is held is alive. One whose lock is free is dead if it took the lock on the same boot and
    device, because there the system would still hold it. Of all others (another machine, a file system
    without locks) the note's date tells: alive if it moves, dead if it stands still for ``expiry_seconds`` of
    this process's own monotonic clock. No clock of another machine and no process number counts.

    Parameters
    ----------
    folder : Path
        Of the notes.
    own : Note
    expiry_seconds : float
    monotonic : callable
        For tests.
    """

    folder: Path
    own: Note
    expiry_seconds: float = EXPIRY_SECONDS
    monotonic: Callable[[], float] = time.monotonic
    _beats: Beats = field(init=False)

    def __post_init__(self) -> None:
        self._beats = Beats(self.expiry_seconds, self.monotonic)

    def look(self) -> list[tuple[Note, str]]:
        """Every note with a lower number and whether its run is ALIVE, DEAD or still UNDECIDED."""
        return [(note, self._state(note)) for note in open_notes(self.folder, self.own.number)]

    def _state(self, note: Note) -> str:
        held = is_held(self.folder / f"{note.number:06d}.lock")
        if held:
            return ALIVE
        here = (self.own.boot, self.own.device)
        if held is False and note.locked and note.boot and (note.boot, note.device) == here:
            return DEAD
        return self._by_beats(note)

    def _by_beats(self, note: Note) -> str:
        try:
            with (self.folder / f"{note.number:06d}.json").open("rb") as file:
                stamp = os.fstat(file.fileno()).st_mtime_ns
        except FileNotFoundError:
            return DEAD  # it has ended since the notes were listed
        return self._beats.state(note, stamp)


class OtherRuns(Protocol):
    """What other runs on a data folder say of themselves, and what becomes of the dead."""

    @property
    def where(self) -> str:
        """The data folder."""
        ...

    def look(self) -> list[tuple[Note, str]]:
        """Every note with a lower number and whether its run is ALIVE, DEAD or still UNDECIDED."""
        ...

    def declare_dead(self, note: Note) -> None:
        """Take a dead run's results back, unless it has ended meanwhile."""
        ...

    def again(self) -> None:
        """Delete what runs wrote after they were declared dead by mistake."""
        ...


class OwnTicket(Protocol):
    """A run's own ticket, wherever it lies."""

    @property
    def note(self) -> Note:
        """What it says."""
        ...

    def check(self) -> None:
        """Raise if another run has taken over."""
        ...


class OtherRunsInFolder:
    """The notes in a folder of a local or mounted disk."""

    def __init__(
        self, ticket: Ticket, expiry_seconds: float, monotonic: Callable[[], float] = time.monotonic
    ) -> None:
        self._folder = ticket.folder
        self._watch = Watch(ticket.folder, ticket.note, expiry_seconds, monotonic)
        self.where = str(ticket.folder.parent)

    def look(self) -> list[tuple[Note, str]]:
        """As :meth:`Watch.look`."""
        return self._watch.look()

    def declare_dead(self, note: Note) -> None:
        """As in :class:`OtherRuns`."""
        _declare_dead(self._folder, note)

    def again(self) -> None:
        """As in :class:`OtherRuns`."""
        _take_back_again(self._folder)


def take_turn(
    ticket: OwnTicket,
    *,
    others: OtherRuns | None = None,
    wait_seconds: float = 0.0,
    expiry_seconds: float = EXPIRY_SECONDS,
    monotonic: Callable[[], float] = time.monotonic,
    sleep: Callable[[float], None] = time.sleep,
) -> None:
    """Return when this run may begin; by then, the results of dead runs are deleted.

    Runs that are ``alongside`` others neither wait nor are waited for.

    Parameters
    ----------
    ticket : Ticket or ObjectTicket
        This run's own.
    others : OtherRuns, optional
        Of the other runs; that of the ticket's folder if left out.
    wait_seconds : float
        How long to wait for a living run.
    expiry_seconds : float
        As in :class:`Watch`.
    monotonic, sleep : callable
        For tests.

    Raises
    ------
    DomainError
        A living run holds the data folder.
    LostTicketError
        This process stood still for so long that another run has taken over.
    """
    if others is None:
        assert isinstance(ticket, Ticket)
        others = OtherRunsInFolder(ticket, expiry_seconds, monotonic)
    last = monotonic() + wait_seconds
    said: set[str] = set()
    while True:
        states = others.look()
        for note in (note for note, state in states if state == DEAD):
            others.declare_dead(note)
        living = [n for n, state in states if state == ALIVE and not (n.alongside or ticket.note.alongside)]
        undecided = [note for note, state in states if state == UNDECIDED]
        if not living and not undecided:
            ticket.check()
            others.again()
            return
        if living and monotonic() >= last:
            raise _refusal(living[0], others.where)
        line = f"Waiting for {living[0]} to end." if living else f"Is {undecided[0]} still alive? Watching."
        if line not in said:
            said.add(line)
            _LOG.warning(line)
        sleep(_POLL_SECONDS)


def take_back(data: Path, note: Note) -> None:
    """Delete the versions that a run wrote."""
    for place in note.places:
        folder = data / place  # an absolute place stays what it is
        if not note.run or folder.name != note.run:  # a damaged note must not delete anything else
            continue
        shutil.rmtree(folder, ignore_errors=True)
        with contextlib.suppress(OSError):
            folder.parent.rmdir()  # only if no version is left


def _declare_dead(folder: Path, note: Note) -> None:
    """Remove a dead run's note, then its results. A run that is alive after all sees that its note is gone.

    A run that ended while it was being looked at has taken its note away itself: its results stay.
    """
    if not retire(folder, note.number, TAKEN):
        return
    _LOG.warning("An earlier run (%s) was killed; its results are removed.", note.run or note.number)
    take_back(folder.parent, note)


def _take_back_again(folder: Path) -> None:
    """A run that stood still in the middle of a write ends that write when it wakes: take that back, too.

    What dead runs were writing when they died goes as well, wherever it lies in the data folder. That takes a
    walk through all of it, so it is done once for each of them: their notes say so when it is finished. A
    run that lives on after all removes what it was writing by itself.
    """
    for path in sorted([*folder.glob(f"*.{TAKEN}"), *folder.glob(f"*.{CLEARED}")]):
        with contextlib.suppress(FileNotFoundError):
            take_back(folder.parent, Note.from_json(0, path.read_bytes()))
    taken = list(folder.glob(f"*.{TAKEN}"))
    remove_temporary(folder.parent, {path.stem for path in taken})
    for path in taken:
        with contextlib.suppress(FileNotFoundError):  # another run was faster
            path.rename(path.with_suffix(f".{CLEARED}"))
    prune(folder)


def _refusal(note: Note, data: str) -> DomainError:
    since = f" since {note.started}" if note.started else ""
    return DomainError(
        f"{note} has held this data folder{since} and is alive",
        where=data,
        todo="wait for it to end, or let this run wait: --params one_run_at_a_time.wait_seconds=600",
    )
