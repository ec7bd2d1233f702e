"""Who is alive is told by locks and by notes that move, never by process numbers or other clocks."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from dataclasses import asdict, replace
from pathlib import Path

import pytest

from tire_pipeline.datasets.storage.one_at_a_time import locked
from tire_pipeline.errors import DomainError
from tire_pipeline.files.atomic import check_before_replacing, replaced_file, replaced_folder
from tire_pipeline.runs import LostTicketError, Note, Ticket, system_lock, take_turn, turn
from tire_pipeline.runs import ticket as tickets
from tire_pipeline.runs.system_lock import is_held

STEP = 0.5
OLD_RUN = """
import sys
from pathlib import Path
from tire_pipeline.runs import Ticket

ticket = Ticket.draw(Path(sys.argv[1]), run="old", places=["table.csv/old"])
print("drawn", flush=True)
sys.stdin.read()
"""


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


def _left(runs: Path, number: int = 1, **more) -> Note:
    """The note and results of a run that is no more."""
    note = Note(number, run="old", host="elsewhere", boot="another", device=1, locked=True)
    note = replace(note, places=("table.csv/old",), **more)
    runs.mkdir(parents=True, exist_ok=True)
    (runs / f"{number:06d}.json").write_bytes(note.to_json())
    (runs.parent / "table.csv/old").mkdir(parents=True)
    return note


def _turn(ticket: Ticket, clock: Clock | None = None, **more) -> None:
    clock = clock or Clock()
    take_turn(ticket, monotonic=clock.monotonic, sleep=clock.sleep, **more)


def _replace(page: Path, meanwhile) -> None:
    with replaced_file(page) as temporary:
        temporary.write_text("new")
        meanwhile()


def test_numbers_grow_and_are_never_given_twice(draw, runs):
    found = []
    for _ in range(60):
        ticket = draw()
        found.append(ticket.note.number)
        ticket.end()
    assert found == list(range(1, 61))
    assert len(list(runs.iterdir())) <= 2 * 52


def test_a_second_run_says_who_holds_the_folder_and_leaves_everything(draw, runs):
    first = draw("2026-01-01", places=["table.csv/2026-01-01"])
    (runs.parent / "table.csv/2026-01-01").mkdir(parents=True)
    _turn(first)
    with pytest.raises(DomainError, match=r"run 2026-01-01 \(number 1, host .* is alive.*wait_seconds"):
        _turn(draw("second"))
    first.check()
    assert (runs.parent / "table.csv/2026-01-01").exists()


@pytest.mark.slow
def test_a_second_run_waits_if_asked_to(draw):
    first = draw("first")
    clock = Clock(lambda now: first.end() if now > 1010 else None)
    second = draw("second")
    _turn(second, clock, wait_seconds=20.0)
    assert 1010 < clock.now < 1012
    second.check()


def test_a_run_that_ends_while_it_is_looked_at_keeps_its_results(draw, runs, monkeypatch):
    """Its note was listed, and its lock is free: that is how a run ends well, too."""
    first = draw("good", places=["table.csv/good"])
    (runs.parent / "table.csv/good").mkdir(parents=True)

    def ends_meanwhile(path: Path) -> bool | None:
        first.end()
        return is_held(path)

    monkeypatch.setattr("tire_pipeline.runs.turn.is_held", ends_meanwhile)
    _turn(draw("next"))
    assert (runs.parent / "table.csv/good").exists()


def test_the_first_come_is_served_first(draw):
    first, second, third = draw("first"), draw("second"), draw("third")
    first.end()
    with pytest.raises(DomainError, match="run second"):
        _turn(third)
    _turn(second)


@pytest.mark.slow
def test_runs_alongside_neither_wait_nor_are_waited_for(draw):
    one, two, whole = draw("1", alongside=True), draw("2", alongside=True), draw("whole")
    _turn(two)
    _turn(whole)
    _turn(draw("3", alongside=True))
    one.check()


def test_a_lock_that_is_free_on_the_same_boot_tells_at_once_that_the_run_is_dead(draw, runs):
    command = [sys.executable, "-c", OLD_RUN, str(runs)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as run:
        assert run.stdout.readline() == b"drawn\n"
        run.kill()
    (runs.parent / "table.csv/old").mkdir(parents=True)
    clock = Clock()
    _turn(draw("next"), clock)
    assert clock.now == 1000.0
    assert not (runs.parent / "table.csv").exists()


@pytest.mark.parametrize("change", [{}, {"boot": ""}, {"locked": False}])
def test_elsewhere_a_note_that_stands_still_is_dead_after_the_expiry_and_not_before(draw, runs, change):
    own = draw("own")
    if change:  # on this system, but with locks that tell nothing
        change = {"boot": own.note.boot, "device": own.note.device, **change}
    own.end()
    _left(runs, 2, **change)
    clock = Clock()
    _turn(draw("next"), clock, expiry_seconds=30.0)
    assert clock.now == 1030.0
    assert not (runs.parent / "table.csv").exists()


@pytest.mark.parametrize("direction", [-1, 1])
def test_elsewhere_a_note_whose_date_moves_is_alive_whatever_the_date(draw, runs, direction):
    _left(runs)
    path = runs / "000001.json"

    def beat(now: float) -> None:
        if now % 5 == 0:
            date = 10**9 * (10**9 + direction * int(now))
            os.utime(path, ns=(date, date))

    with pytest.raises(DomainError, match=r"run old .*elsewhere"):
        _turn(draw("next"), Clock(beat), expiry_seconds=30.0)
    assert (runs.parent / "table.csv/old").exists()


def test_a_run_is_not_dead_before_it_missed_its_own_beats(draw, runs):
    _left(runs, beat_seconds=50.0)
    clock = Clock()
    _turn(draw("next"), clock, expiry_seconds=30.0)
    assert clock.now == 1200.0


def test_a_ticket_beats(draw):
    ticket = draw(beat_seconds=0.02)
    before = ticket.path.stat().st_mtime_ns
    end = time.monotonic() + 20
    while ticket.path.stat().st_mtime_ns <= before:
        assert time.monotonic() < end
        time.sleep(0.01)


def test_who_lost_the_folder_writes_nothing_more(draw, no_locks, tmp_path):
    first = draw("first", beat_seconds=1e9)  # stands still from here on
    _turn(first)
    stop = check_before_replacing(first.check)
    try:
        page = tmp_path / "page.html"
        with replaced_file(page) as temporary:
            temporary.write_text("old")
        # declared dead while it writes
        with pytest.raises(LostTicketError, match="taken this data folder over"):
            _replace(page, first.path.unlink)
        with pytest.raises(LostTicketError):
            _replace(page, lambda: None)
        with pytest.raises(LostTicketError):
            replaced_folder(tmp_path / "folder").__enter__()
    finally:
        stop()
    assert page.read_text() == "old"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["data", "page.html"]


def test_without_locks_a_living_run_is_left_alone(draw, no_locks):
    first = draw("first", beat_seconds=0.05)
    with pytest.raises(DomainError, match="run first"):
        take_turn(draw("second"), expiry_seconds=30.0)
    first.check()


def test_what_a_dead_run_ends_writing_later_is_taken_back_by_the_run_after(draw, runs):
    _left(runs)
    second = draw("second")
    _turn(second)
    second.end()
    (runs.parent / "table.csv/old").mkdir(parents=True)  # the sleeper woke in the middle of a write
    _turn(draw("third"))
    assert not (runs.parent / "table.csv").exists()


KILLED_WRITER = """
import os, sys
from pathlib import Path
from tire_pipeline.files.atomic import check_before_replacing, replaced_file, replaced_folder
from tire_pipeline.runs import Ticket

data = Path(sys.argv[1])
ticket = Ticket.draw(data / ".runs", run="old", alongside=True)
check_before_replacing(ticket.check, owner=ticket.note.name)
with replaced_file(data / "03_primary/a.csv") as file, replaced_folder(data / "07" / sys.argv[2]) as folder:
    file.write_text("half")
    (folder / "page.html").write_text("half")
    print("written", flush=True)
    sys.stdin.read()
    os._exit(0)
"""


def _writer(data: Path, name: str) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-c", KILLED_WRITER, str(data), name]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert process.stdout.readline() == b"written\n"
    return process


def _temporary(data: Path) -> list[str]:
    return sorted(path.parent.name for path in data.rglob("*.part"))


def test_what_a_killed_run_was_writing_is_removed_and_nothing_of_others(draw, runs):
    data = runs.parent
    killed, living = _writer(data, "killed"), _writer(data, "living")
    try:
        (data / "03_primary/.of the user.part").write_text("mine")
        with replaced_file(data / "03_primary/by a command.csv") as file:
            killed.kill()
            killed.wait()
            assert _temporary(data) == ["03_primary"] * 4 + ["07"] * 2  # this one, the user's, both runs'
            following = draw("next")
            _turn(following)
            following.end()
            assert file.exists()
        assert (data / "03_primary/.of the user.part").exists()
        assert _temporary(data) == ["03_primary"] * 2 + ["07"]
        assert living.poll() is None
    finally:
        for each in (killed, living):
            each.kill()
            each.communicate()
    _turn(draw("the one after"))
    assert _temporary(data) == ["03_primary"]


def test_the_data_folder_is_walked_once_for_a_dead_run_and_again_if_that_walk_is_killed(
    draw, runs, monkeypatch
):
    half = runs.parent / "03/.tire_pipeline-000001-abcdefgh.part"
    half.parent.mkdir(parents=True)
    half.touch()
    _left(runs)
    walked = []
    remove = turn.remove_temporary

    def killed_at_first(folder: Path, owners: set[str]) -> None:
        walked.append(owners)
        if len(walked) == 1:
            raise KeyboardInterrupt
        remove(folder, owners)

    monkeypatch.setattr(turn, "remove_temporary", killed_at_first)
    clearing = draw("killed while it clears")
    with pytest.raises(KeyboardInterrupt):
        _turn(clearing)
    clearing.end()
    assert half.exists()
    for name in ("second", "third", "fourth"):
        own = draw(name)
        _turn(own)
        own.end()
        assert not half.exists()
    assert walked[:2] == [{"000001"}, {"000001"}]
    assert not any(walked[2:])


def test_a_folder_that_a_killed_run_had_moved_aside_is_put_back(draw, runs):
    old = runs.parent / ".pages.tire_pipeline-000001-abcdefgh.old"
    _left(runs)
    for each in (old, old.with_suffix(".part")):
        each.mkdir()
        (each / "page.html").write_text(each.suffix)
    _turn(draw("next"))
    assert [path.name for path in runs.parent.iterdir() if path != runs] == ["pages"]
    assert (runs.parent / "pages/page.html").read_text() == ".old"


@pytest.mark.parametrize("what", [replaced_file, replaced_folder])
def test_who_lost_the_folder_and_what_it_was_writing_is_told_so(draw, no_locks, runs, what):
    first = draw("first", beat_seconds=1e9)
    stop = check_before_replacing(first.check, owner=first.note.name)

    def lose_it_while_writing():
        with what(runs.parent / "page"):
            first.path.rename(first.path.with_suffix(".taken"))
            _turn(draw("second"))

    try:
        with pytest.raises(LostTicketError):
            lose_it_while_writing()
    finally:
        stop()
    assert [path for path in runs.parent.iterdir() if path != runs] == []


@pytest.mark.parametrize("content", [b"", b"{", b"[]", b'{"places": [], "unknown": 1}', b"\xff"])
def test_a_damaged_note_is_watched_and_deletes_nothing(draw, runs, content):
    _left(runs)
    (runs / "000001.json").write_bytes(content)
    clock = Clock()
    _turn(draw("next"), clock, expiry_seconds=30.0)
    assert clock.now == 1030.0
    assert (runs.parent / "table.csv/old").exists()


def test_a_note_cannot_have_anything_deleted_but_versions_of_its_run(draw, runs):
    note = _left(runs)
    (runs.parent / "models").mkdir()
    bad = {**asdict(note), "places": ["", ".", "models", "../data", str(runs.parent / "models")]}
    (runs / "000001.json").write_text(json.dumps(bad))
    _turn(draw("next"))
    assert (runs.parent / "models").exists()


def test_the_folder_of_notes_is_no_place_for_strangers(draw, runs):
    runs.mkdir(parents=True)
    (runs / "notes.txt").write_text("mine")
    ticket = draw()
    _turn(ticket)
    ticket.end()
    assert (runs / "notes.txt").exists()


@pytest.mark.parametrize("number", ["ENOSYS", "ENOTSUP", "ENOLCK"])
def test_a_file_system_without_locks_is_no_error(tmp_path, monkeypatch, number):
    import errno

    def refuse(*_):
        raise OSError(getattr(errno, number), "no locks")

    monkeypatch.setattr("fcntl.flock", refuse)
    assert system_lock.system_lock(tmp_path / "lock") is None
    assert system_lock.is_held(tmp_path / "lock") is None
    with locked(tmp_path / "store"):
        pass
