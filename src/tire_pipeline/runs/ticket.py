"""One run's ticket: a numbered note in ``<data>/.runs`` that others can take away.

The number is the fencing number. It grows with every run on the data folder. While a run is alive it holds
the system's lock on ``<number>.lock`` and moves the date of ``<number>.json`` on every few seconds. A run
that finds its note gone has been declared dead by another and writes nothing more.
"""

from __future__ import annotations

import contextlib
import datetime
import json
import os
import re
import socket
import threading
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from filelock import FileLock

from tire_pipeline.errors import DomainError
from tire_pipeline.runs.system_lock import Held, system_lock

BEAT_SECONDS = 5.0
KEPT_TICKETS = 50
"""Notes of so many runs before the newest stay."""
_STEP_NS = 2_000_000_000  # two seconds, the coarsest date of a file system
ENDED, TAKEN, CLEARED = "ended", "taken", "cleared"
"""What a note becomes: its run ended; was declared dead; was, and what it was writing is gone, too."""
_FILE_NAME = re.compile(rf"(\d+)\.(json|lock|{ENDED}|{TAKEN}|{CLEARED})").fullmatch


class LostTicketError(DomainError):
    """Another run has declared this one dead."""


@dataclass(frozen=True)
class Note:
    """What a run says about itself.

    Attributes
    ----------
    number : int
        The fencing number.
    run : str
        Version of its results.
    host : str
    boot : str
        Which start of which system, the same for all containers on it; empty where that cannot be told.
    device : int
        Of the folder of notes. Two processes of one boot that see one device see the same locks.
    pid : int
        In the run's own process namespace: for the reader only, nothing is decided by it.
    started : str
        By the run's own clock: for the reader only.
    locked : bool
        Whether it holds the system's lock.
    alongside : bool
        It does not ask to be alone.
    beat_seconds : float
        How often it moves its note's date on.
    places : tuple of str
        Folders of its results, relative to the data folder where they lie in it.
    """

    number: int
    run: str = ""
    host: str = ""
    boot: str = ""
    device: int = -1
    pid: int = 0
    started: str = ""
    locked: bool = False
    alongside: bool = False
    beat_seconds: float = BEAT_SECONDS
    places: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """The number as it stands in names of files."""
        return f"{self.number:06d}"

    def to_json(self) -> bytes:
        """Bytes of the note."""
        return json.dumps(asdict(self), indent=1).encode()

    @classmethod
    def from_json(cls, number: int, content: bytes) -> Note:
        """A note as it was written; one that is damaged or half-written tells its number only."""
        try:
            data = json.loads(content)
            places = tuple(str(place) for place in data.pop("places"))
            note = cls(**{**data, "places": places, "number": number})
            return replace(note, beat_seconds=float(note.beat_seconds), device=int(note.device))
        except (ValueError, KeyError, TypeError, AttributeError):
            return cls(number)

    def __str__(self) -> str:
        if not self.run:
            return f"run number {self.number}, whose note cannot be read,"
        return f"run {self.run} (number {self.number}, host {self.host}, process {self.pid} there)"


class Ticket:
    """This process's own note. Take one with :meth:`draw`, give it back with :meth:`end`."""

    def __init__(self, folder: Path, note: Note, lock: FileLock | None) -> None:
        self.folder = folder
        self.note = note
        self._lock = lock
        self._stop = threading.Event()
        self._beats = int(time.time()) * 1_000_000_000
        threading.Thread(target=self._keep_beating, name="run ticket", daemon=True).start()

    @classmethod
    def draw(
        cls,
        folder: Path,
        *,
        run: str,
        places: Sequence[str] = (),
        alongside: bool = False,
        beat_seconds: float = BEAT_SECONDS,
    ) -> Ticket:
        """Take the next number.

        Parameters
        ----------
        folder : Path
            Of the notes; made if it is absent.
        run, places, alongside, beat_seconds
            As in :class:`Note`.
        """
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except FileExistsError as error:
            raise DomainError(
                "this is no folder, and runs keep their tickets in one", where=str(folder), todo="take it out"
            ) from error
        while True:
            number = max(numbers(folder), default=0) + 1
            try:
                lock = system_lock(folder / f"{number:06d}.lock")
            except Held:
                time.sleep(0.01)
                continue
            note = Note(
                number=number,
                run=run,
                host=socket.gethostname(),
                boot=boot_id(),
                device=folder.stat().st_dev,
                pid=os.getpid(),
                started=datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds"),
                locked=lock is not None,
                alongside=alongside,
                beat_seconds=beat_seconds,
                places=tuple(places),
            )
            try:
                _write_new(folder / f"{number:06d}.json", note.to_json())
            except FileExistsError:
                if lock is not None:
                    lock.release()
                continue
            return cls(folder, note, lock)

    @property
    def path(self) -> Path:
        """Of the note."""
        return self.folder / f"{self.note.name}.json"

    def check(self) -> None:
        """Make sure that this run may still write.

        Raises
        ------
        LostTicketError
            Another run has taken the data folder over.
        """
        try:
            with self.path.open("rb"):  # opening asks a network file system's server, too
                return
        except FileNotFoundError as error:
            raise LostTicketError(
                f"another run has taken this data folder over, as this one (number {self.note.number}) "
                "showed no sign of life",
                where=str(self.folder.parent),
                todo="run again; this run has stored nothing since",
            ) from error

    def end(self) -> None:
        """Give the ticket back. The number stays taken."""
        self._stop.set()
        retire(self.folder, self.note.number, ENDED)
        if self._lock is not None:
            self._lock.release()
        prune(self.folder)

    def _keep_beating(self) -> None:
        while not self._stop.wait(self.note.beat_seconds):
            self._beats += _STEP_NS
            try:
                os.utime(self.path, ns=(self._beats, self._beats))
            except FileNotFoundError:
                return
            except OSError:  # a server that does not answer now may do so at the next beat
                continue


def boot_id() -> str:
    """Which start of which system this is; empty where the system does not tell."""
    with contextlib.suppress(OSError):
        return Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii").strip()
    return ""


def numbers(folder: Path) -> list[int]:
    """All numbers that are or were taken, as far as they are remembered."""
    return [int(found[1]) for name in os.listdir(folder) if (found := _FILE_NAME(name))]


def open_notes(folder: Path, below: int) -> list[Note]:
    """Notes of runs that have not ended, with numbers below one's own."""
    notes = []
    for name in sorted(os.listdir(folder)):
        found = _FILE_NAME(name)
        if found and found[2] == "json" and int(found[1]) < below and (folder / name).is_file():
            with contextlib.suppress(FileNotFoundError):  # it has ended since
                notes.append(Note.from_json(int(found[1]), (folder / name).read_bytes()))
    return notes


def retire(folder: Path, number: int, state: str) -> bool:
    """Take a note away; its number stays remembered under another ending, with what the note says.

    Returns
    -------
    bool
        False if another was faster. Whoever takes the note away decides what became of the run.
    """
    try:
        (folder / f"{number:06d}.json").rename(folder / f"{number:06d}.{state}")
    except FileNotFoundError:
        return False
    return True


def prune(folder: Path) -> None:
    """Forget all but the last runs that have ended.

    Some are remembered so that a run that was slow to take its number cannot take one from before.
    """
    oldest = max(numbers(folder), default=0) - KEPT_TICKETS
    for name in os.listdir(folder):
        found = _FILE_NAME(name)
        if found and int(found[1]) < oldest and found[2] != "json":
            if found[2] == "lock" and (folder / f"{found[1]}.json").exists():
                continue
            (folder / name).unlink(missing_ok=True)


def _write_new(path: Path, content: bytes) -> None:
    handle = os.open(path, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o644)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
    except OSError:  # the disk is full: no empty note stays
        path.unlink(missing_ok=True)
        raise
