"""Two containers on one data folder: process numbers mean nothing from one to the other."""

from __future__ import annotations

import os
import shutil
import signal
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from threading import Event, Thread

import pytest
from run_processes import ROOT, InNamespace, namespaces

sys.path.insert(0, str(ROOT / "tests" / "retraining"))
from retraining_files import put, put_fleet, tir_text

pytestmark = [pytest.mark.slow, namespaces]
RETRAIN = "retrain.settle_seconds={settle},dedupe_filter.minimum_per_category=5"


@pytest.fixture
def folder(tmp_path):
    shutil.copytree(ROOT / "conf", tmp_path / "conf")
    data = tmp_path / "data"
    (tmp_path / "conf/small/globals.yml").write_text(f"data: {data}\ntir_folder: {data}/01_raw/tir\n")
    put_fleet(data / "01_raw/tir", range(40))
    return tmp_path


def _kedro(
    folder: Path, name: str, pipeline: str = "retrain", settle: int = 0, more: str = ""
) -> InNamespace:
    command = ["-m", "kedro", "run", "--env", "small", "--conf-source", str(folder / "conf")]
    parameters = RETRAIN.format(settle=settle) + more
    return InNamespace(*command, "--pipeline", pipeline, "--params", parameters, log=folder / f"{name}.txt")


def _notes(folder: Path) -> list[Path]:
    return list((folder / "data/.runs").glob("*.json"))


def _results(folder: Path) -> set[str]:
    """Versions of what a retraining writes first."""
    return {path.name for path in (folder / "data/02_intermediate/retraining_files.json").glob("*")}


@pytest.mark.long
def test_a_killed_run_is_taken_back_from_another_namespace(folder):
    """Whole runs; `test_living_and_killed_with_and_without_locks` holds the same of what a run does."""
    with _kedro(folder, "killed") as run:
        run.wait_until(lambda: _results(folder))
        run.kill()
    killed = _results(folder)
    assert len(killed) == 1
    with _kedro(folder, "next") as run:
        assert run.wait() == 0, run.said()
        assert "was killed; its results are removed" in run.said()
    assert not killed & _results(folder)
    assert not list((folder / "data").rglob(f"*/{killed.pop()}"))
    assert _notes(folder) == []


@contextmanager
def _growing(path: Path) -> Iterator[None]:
    """A file that keeps growing for as long as the block takes: a retraining waits for it."""
    done = Event()

    def grow() -> None:
        while not done.wait(0.5):
            path.touch()

    thread = Thread(target=grow)
    thread.start()
    try:
        yield
    finally:
        done.set()
        thread.join()


def test_a_living_run_is_left_alone_by_another_namespace_and_named(folder):
    put(folder / "data/01_raw/tir", "A/fresh.tir", tir_text(900, "A"), age=0.0)
    fresh = folder / "data/01_raw/tir/A/fresh.tir"
    long_wait = ",retrain.most_wait_seconds=300"
    with ExitStack() as runs:
        with _growing(fresh):
            first = runs.enter_context(_kedro(folder, "first", settle=5, more=long_wait))
            first.wait_until(lambda: _notes(folder))
            with _kedro(folder, "second", "ingest_tir") as second:
                assert second.wait() == 1
                said = [line for line in second.said().splitlines() if line.startswith("error:")]
                assert len(said) == 1, second.said()
                assert "Traceback" not in second.said()
                assert f"host {os.uname().nodename}, process 1 there" in said[0]
                assert "is alive" in said[0]
            waits = ",one_run_at_a_time.wait_seconds=300"
            third = runs.enter_context(_kedro(folder, "third", "rollback", more=waits))
            third.wait_until(lambda: "Waiting for run" in third.said())
            assert first.running()
        assert first.wait() == 0, first.said()
        third.wait()
        assert "only" in third.said()  # its turn came: there is nothing to roll back to
        assert "was killed" not in third.said()
    assert len(_results(folder)) == 1
    assert _notes(folder) == []


HOLDER = """
import sys, time
from pathlib import Path
from tire_pipeline.runs import Ticket, take_turn, ticket
from tire_pipeline.files.atomic import check_before_replacing, replaced_file
if sys.argv[2] == "no locks":
    import tire_pipeline.runs.turn as turn
    ticket.system_lock = lambda *_, **__: None
    turn.is_held = lambda path: None
data = Path(sys.argv[1])
own = Ticket.draw(data / ".runs", run=sys.argv[3], places=["t/" + sys.argv[3]], beat_seconds=0.2)
try:
    take_turn(own, expiry_seconds=3.0)
except Exception as error:
    own.end()
    sys.exit(f"refused: {error}")
check_before_replacing(own.check)
try:
    for number in range(600):
        with replaced_file(data / "t" / sys.argv[3] / "result") as file:
            file.write_text(str(number))
        print("wrote", flush=True)
        time.sleep(0.1)
except Exception as error:
    sys.exit(f"stopped: {type(error).__name__}")
"""


def _hold(data: Path, locks: str, name: str) -> InNamespace:
    return InNamespace("-c", HOLDER, str(data), locks, name, log=data / f"{name}.txt")


@pytest.mark.parametrize("locks", ["locks", "no locks"])
def test_living_and_killed_with_and_without_locks(tmp_path, locks):
    result = tmp_path / "t/first/result"
    with _hold(tmp_path, locks, "first") as first:
        first.wait_until(lambda: "wrote" in first.said())
        with _hold(tmp_path, locks, "second") as second:
            second.wait()
            assert "refused: " in second.said()
            assert "run first" in second.said()
        assert result.exists()
        first.kill()
    with _hold(tmp_path, locks, "third") as third:
        third.wait_until(lambda: "wrote" in third.said())
        assert not result.exists()


def test_without_locks_who_stood_still_loses_the_folder_and_writes_nothing_more(tmp_path):
    with _hold(tmp_path, "no locks", "first") as first:
        first.wait_until(lambda: "wrote" in first.said())
        first.send(signal.SIGSTOP)
        with _hold(tmp_path, "no locks", "second") as second:
            second.wait_until(lambda: "wrote" in second.said())
            first.send(signal.SIGCONT)
            first.wait()
            assert "stopped: LostTicketError" in first.said()
            assert not (tmp_path / "t/first/result").exists()
            assert second.running()


def test_with_locks_who_stands_still_keeps_the_folder(tmp_path):
    with _hold(tmp_path, "locks", "first") as first:
        first.wait_until(lambda: "wrote" in first.said())
        first.send(signal.SIGSTOP)
        with _hold(tmp_path, "locks", "second") as second:
            second.wait()
            assert "refused" in second.said()
        first.send(signal.SIGCONT)
        before = first.said().count("wrote")
        end = time.monotonic() + 30
        while first.said().count("wrote") <= before:
            assert time.monotonic() < end
            time.sleep(0.05)
