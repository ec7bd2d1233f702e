"""Who is alive is told by locks and by notes that move, never by process numbers or other clocks."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest
from turns import Clock, left_by_a_dead_run, wait_for_turn

from tire_pipeline.datasets.storage.one_at_a_time import locked
from tire_pipeline.errors import DomainError
from tire_pipeline.runs import system_lock, take_turn
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
    wait_for_turn(first)
    with pytest.raises(DomainError, match=r"run 2026-01-01 \(number 1, host .* is alive.*wait_seconds"):
        wait_for_turn(draw("second"))
    first.check()
    assert (runs.parent / "table.csv/2026-01-01").exists()


@pytest.mark.slow
def test_a_second_run_waits_if_asked_to(draw):
    first = draw("first")
    clock = Clock(lambda now: first.end() if now > 1003 else None)
    second = draw("second")
    wait_for_turn(second, clock, wait_seconds=20.0)
    assert 1003 < clock.now < 1005
    second.check()


def test_a_second_run_gives_up_when_the_time_that_it_may_wait_is_over(draw):
    draw("first")
    clock = Clock()
    with pytest.raises(DomainError, match="run first"):
        wait_for_turn(draw("second"), clock, wait_seconds=1.5)
    assert clock.now == 1001.5


def test_a_living_run_is_remembered_however_many_end_after_it(draw):
    first = draw("first")
    for _ in range(60):
        draw("short", alongside=True).end()
    first.check()
    with pytest.raises(DomainError, match="run first"):
        wait_for_turn(draw("next"))


def test_a_ticket_that_a_full_disk_has_no_room_for_leaves_no_note(draw, runs, monkeypatch):
    """An empty note would be watched by each run after it until it counts as dead."""

    def full(handle: int) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr(os, "fsync", full)
        with pytest.raises(OSError, match="No space left"):
            draw("first")
    assert list(runs.glob("*.json")) == []
    clock = Clock()
    wait_for_turn(draw("next"), clock)
    assert clock.now == 1000.0


def test_a_run_that_ends_while_it_is_looked_at_keeps_its_results(draw, runs, monkeypatch):
    """Its note was listed, and its lock is free: that is how a run ends well, too."""
    first = draw("good", places=["table.csv/good"])
    (runs.parent / "table.csv/good").mkdir(parents=True)

    def ends_meanwhile(path: Path) -> bool | None:
        first.end()
        return is_held(path)

    monkeypatch.setattr("tire_pipeline.runs.turn.is_held", ends_meanwhile)
    wait_for_turn(draw("next"))
    assert (runs.parent / "table.csv/good").exists()


def test_the_first_come_is_served_first(draw):
    first, second, third = draw("first"), draw("second"), draw("third")
    first.end()
    with pytest.raises(DomainError, match="run second"):
        wait_for_turn(third)
    wait_for_turn(second)


@pytest.mark.slow
def test_runs_alongside_neither_wait_nor_are_waited_for(draw):
    one, two, whole = draw("1", alongside=True), draw("2", alongside=True), draw("whole")
    wait_for_turn(two)
    wait_for_turn(whole)
    wait_for_turn(draw("3", alongside=True))
    one.check()


def test_a_lock_that_is_free_on_the_same_boot_tells_at_once_that_the_run_is_dead(draw, runs):
    command = [sys.executable, "-c", OLD_RUN, str(runs)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as run:
        assert run.stdout.readline() == b"drawn\n"
        run.kill()
    (runs.parent / "table.csv/old").mkdir(parents=True)
    clock = Clock()
    wait_for_turn(draw("next"), clock)
    assert clock.now == 1000.0
    assert not (runs.parent / "table.csv").exists()


@pytest.mark.parametrize("change", [{}, {"boot": ""}, {"locked": False}, {"device": -7}])
def test_elsewhere_a_note_that_stands_still_is_dead_after_the_expiry_and_not_before(draw, runs, change):
    own = draw("own")
    if change:  # on this system, but with locks that tell nothing
        change = {"boot": own.note.boot, "device": own.note.device, **change}
    own.end()
    left_by_a_dead_run(runs, 2, **change)
    clock = Clock()
    wait_for_turn(draw("next"), clock, expiry_seconds=30.0)
    assert clock.now == 1030.0
    assert not (runs.parent / "table.csv").exists()


@pytest.mark.parametrize("direction", [-1, 1])
def test_elsewhere_a_note_whose_date_moves_is_alive_whatever_the_date(draw, runs, direction):
    left_by_a_dead_run(runs)
    path = runs / "000001.json"

    def beat(now: float) -> None:
        if now % 5 == 0:
            date = 10**9 * (10**9 + direction * int(now))
            os.utime(path, ns=(date, date))

    with pytest.raises(DomainError, match=r"run old .*elsewhere"):
        wait_for_turn(draw("next"), Clock(beat), expiry_seconds=30.0)
    assert (runs.parent / "table.csv/old").exists()


def test_a_run_is_not_dead_before_it_missed_its_own_beats(draw, runs):
    left_by_a_dead_run(runs, beat_seconds=50.0)
    clock = Clock()
    wait_for_turn(draw("next"), clock, expiry_seconds=30.0)
    assert clock.now == 1200.0


def test_a_ticket_beats(draw):
    ticket = draw(beat_seconds=0.02)
    before = ticket.path.stat().st_mtime_ns
    end = time.monotonic() + 20
    while ticket.path.stat().st_mtime_ns <= before:
        assert time.monotonic() < end
        time.sleep(0.01)


def test_without_locks_a_living_run_is_left_alone(draw, no_locks):
    first = draw("first", beat_seconds=0.05)
    with pytest.raises(DomainError, match="run first"):
        take_turn(draw("second"), expiry_seconds=30.0)
    first.check()


@pytest.mark.parametrize("content", [b"", b"{", b"[]", b'{"places": [], "unknown": 1}', b"\xff"])
def test_a_damaged_note_is_watched_and_deletes_nothing(draw, runs, content):
    left_by_a_dead_run(runs)
    (runs / "000001.json").write_bytes(content)
    clock = Clock()
    wait_for_turn(draw("next"), clock, expiry_seconds=30.0)
    assert clock.now == 1030.0
    assert (runs.parent / "table.csv/old").exists()


@pytest.mark.parametrize("make", [os.mkfifo, os.mkdir], ids=["FIFO", "folder"])
def test_what_is_no_file_is_no_note_and_keeps_nobody_waiting(draw, runs, make):
    runs.mkdir(parents=True, exist_ok=True)
    make(runs / "000007.json")
    ticket = draw()
    assert ticket.note.number == 8
    take_turn(ticket)


@pytest.mark.parametrize("make", [os.mkfifo, Path.touch, lambda path: path.symlink_to("/absent/runs")])
def test_where_notes_have_no_folder_it_is_told(draw, runs, make):
    runs.parent.mkdir(parents=True, exist_ok=True)
    make(runs)
    with pytest.raises(DomainError, match="no folder, and runs keep their tickets in one -> take it out"):
        draw()


def test_the_folder_of_notes_is_no_place_for_strangers(draw, runs):
    runs.mkdir(parents=True)
    (runs / "notes.txt").write_text("mine")
    ticket = draw()
    wait_for_turn(ticket)
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
