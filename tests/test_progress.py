"""Progress: one row on a terminal, and lines in a log."""

from __future__ import annotations

import io
import re
import subprocess
import sys
import time
from dataclasses import dataclass
from functools import partial

import pytest
from kedro.pipeline import Node, Pipeline

from tire_pipeline.kedro_runs.node_progress import NodeProgressHooks
from tire_pipeline.progress import display as progress_display
from tire_pipeline.progress import silent, track, under_way
from tire_pipeline.tasks import in_turn

PATIENCE_SECONDS = 30.0


class Stream(io.StringIO):
    """Keeps what is written to it."""

    def __init__(self, terminal: bool) -> None:
        super().__init__()
        self.terminal = terminal

    def isatty(self) -> bool:
        return self.terminal

    def text(self) -> str:
        """Give what was written, without the codes that move the cursor."""
        return re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", self.getvalue())

    def wait_for(self, wanted: str) -> None:
        end = time.monotonic() + PATIENCE_SECONDS
        while wanted not in self.text():
            assert time.monotonic() < end, f"{wanted!r} is not in {self.text()!r}"
            time.sleep(0.01)


def errors_to(monkeypatch, *, terminal: bool, after: float = 0.0) -> Stream:
    """Called in the test itself: pytest puts its own stream in place of another's when a test begins."""
    monkeypatch.setattr(progress_display, "PAUSE_SECONDS", -1.0)
    monkeypatch.setattr(progress_display, "SHOW_AFTER_SECONDS", after)
    monkeypatch.setattr(progress_display, "LINE_EVERY_SECONDS", after)
    monkeypatch.setattr(progress_display, "TICK_SECONDS", 0.01)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "120")
    for name in ("FORCE_COLOR", "NO_COLOR", "TTY_COMPATIBLE", "TTY_INTERACTIVE"):
        monkeypatch.delenv(name, raising=False)
    made = Stream(terminal)
    monkeypatch.setattr(sys, "stderr", made)
    return made


@pytest.mark.parametrize("terminal", [True, False])
def test_a_loop_says_what_it_does_and_how_far_it_is(monkeypatch, terminal):
    stream = errors_to(monkeypatch, terminal=terminal)
    for number in track([1, 2, 3], "counting"):
        stream.wait_for(f"{number - 1}/3")
    assert "counting" in stream.text()


@pytest.mark.parametrize("terminal", [True, False])
def test_a_quick_loop_says_nothing(monkeypatch, terminal):
    stream = errors_to(monkeypatch, terminal=terminal, after=1e6)
    for _ in track([1, 2, 3], "counting"):
        time.sleep(0.05)
    assert stream.text() == ""


@pytest.mark.parametrize("terminal", [True, False])
def test_what_cannot_be_counted_is_shown_with_its_time(monkeypatch, terminal):
    stream = errors_to(monkeypatch, terminal=terminal)
    with under_way("thinking"):
        stream.wait_for("thinking")
    assert "?" not in stream.text()


@pytest.mark.parametrize("terminal", [True, False])
def test_tasks_that_take_long_are_named_while_they_are_done(monkeypatch, terminal):
    stream = errors_to(monkeypatch, terminal=terminal)
    tasks = {name: partial(stream.wait_for, f"trying ({name})") for name in ("this", "that")}
    tasks["12ab.zip"] = WithLabel(stream, "a run")
    assert [done.error for done in in_turn(tasks, "trying")] == [None] * 3


@dataclass
class WithLabel:
    """A task that has another name for people."""

    stream: Stream
    label: str

    def __call__(self) -> None:
        self.stream.wait_for(f"trying ({self.label})")


@pytest.mark.parametrize("terminal", [True, False])
def test_a_files_name_is_neither_markup_nor_does_it_act_on_the_terminal(monkeypatch, terminal):
    stream = errors_to(monkeypatch, terminal=terminal)
    for _ in track([1, 2], "reading [/red][bold]\x1b[31m\u202ea.tir", total=2):
        stream.wait_for("reading [/red][bold]⟨U+001B⟩[31m⟨U+202E⟩a.tir")


def test_of_loops_within_each_other_the_innermost_has_the_one_row(monkeypatch):
    stream = errors_to(monkeypatch, terminal=True)
    for _ in track([1, 2], "outer"):
        stream.wait_for("outer")
        for _ in track("ab", "inner"):
            stream.wait_for("inner")
        stream.truncate(stream.seek(0))
        stream.wait_for("outer")
        assert "\n" not in stream.text().strip()


def test_a_loop_that_is_left_is_shown_no_more(monkeypatch):
    stream = errors_to(monkeypatch, terminal=True)
    left = track([1, 2, 3], "left")
    next(left)
    stream.wait_for("left")
    left.close()
    stream.truncate(stream.seek(0))
    with under_way("next"):
        stream.wait_for("next")
    assert "left" not in stream.text()


def test_many_short_steps_are_long_together(monkeypatch):
    stream = errors_to(monkeypatch, terminal=True, after=0.3)
    monkeypatch.setattr(progress_display, "PAUSE_SECONDS", 1e6)
    for number in range(100):
        with under_way(f"step {number}"):
            time.sleep(0.02)
    assert re.search(r"step \d+", stream.text())


def test_one_process_of_many_says_nothing(monkeypatch):
    stream = errors_to(monkeypatch, terminal=False)
    with silent():
        for _ in track([1, 2, 3], "counting"):
            time.sleep(0.05)
    assert stream.text() == ""
    with under_way("thinking"):
        stream.wait_for("thinking")


def test_what_is_printed_meanwhile_goes_where_it_went_before(monkeypatch):
    stream = errors_to(monkeypatch, terminal=True)
    printed = Stream(terminal=False)
    monkeypatch.setattr(sys, "stdout", printed)
    with under_way("thinking"):
        stream.wait_for("thinking")
        print("a result")
    assert printed.getvalue() == "a result\n"
    assert "a result" not in stream.text()


def test_a_stream_that_is_closed_ends_no_loop(monkeypatch):
    stream = errors_to(monkeypatch, terminal=False)
    stream.close()
    assert [number for number in track([1, 2, 3], "counting") if not time.sleep(0.05)] == [1, 2, 3]


INTERRUPTED = """
import os, sys
from tire_pipeline.progress import display as progress_display
from tire_pipeline.progress import track
progress_display.SHOW_AFTER_SECONDS = progress_display.LINE_EVERY_SECONDS = 0.0
progress_display.TICK_SECONDS = 1e-4
outer = track([1, 2], "outer")
next(outer)
if sys.argv[1] == "fork":
    child = os.fork()
    if child:
        sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
    list(track([1, 2], "inner"))
"""


@pytest.mark.slow
@pytest.mark.parametrize("how", ["exit", "fork"])
def test_a_process_ends_well_with_work_left(how):
    for _ in range(5):
        command = [sys.executable, "-c", INTERRUPTED, how]
        done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
        assert done.returncode == 0, done.stderr
        assert "Error" not in done.stderr


IN_PROCESSES = """
import sys, time
from tire_pipeline.progress import display as progress_display
from tire_pipeline.progress import track
from tire_pipeline.tasks import Labelled, in_processes
def slow():
    progress_display.SHOW_AFTER_SECONDS = progress_display.LINE_EVERY_SECONDS = 0.0
    progress_display.TICK_SECONDS = 0.01
    for _ in track(range(20), "steps of a task"):
        time.sleep(0.02)
names = [f"task {number}" for number in range(int(sys.argv[1]))]
tasks = {name: Labelled(name, slow, steps=name == sys.argv[2]) for name in names}
progress_display.SHOW_AFTER_SECONDS = progress_display.LINE_EVERY_SECONDS = 0.0
list(in_processes(2)(tasks, "tasks"))
"""


@pytest.mark.slow
@pytest.mark.parametrize(("tasks", "asks", "steps"), [(2, "", True), (5, "", False), (5, "task 1", True)])
def test_processes_of_a_pool_show_steps_where_each_has_one_task_or_a_task_asks_for_it(tasks, asks, steps):
    command = [sys.executable, "-c", IN_PROCESSES, str(tasks), asks]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    assert ("steps of a task" in done.stderr) == steps
    assert "tasks (task 0; task 1): " in done.stderr
    assert ("tasks (task 0; task 1): 0/" in done.stderr) == (tasks > 2)  # how many of two says nothing


def test_the_time_left_shrinks_while_the_next_one_is_under_way():
    activity = progress_display.Activity("training", total=3, began=100.0)
    activity.done, activity.latest = 1, 130.0
    assert activity.line(130.0) == "training: 1/3 (30 s each, 60 s left)"
    assert activity.line(150.0) == "training: 1/3 (30 s each, 40 s left)"
    assert activity.line(200.0) == "training: 1/3 (100 s so far, this one takes longer)"


def test_a_node_is_done_when_what_it_gives_is_written(caplog):
    """Or what it gives in steps: the next one begins, or none is left."""
    caplog.set_level("INFO")
    first = Node(lambda: (1, 2), inputs=None, outputs=["a", "b"], name="first")
    last = Node(lambda a: a, inputs="a", outputs="c", name="last")
    hooks = NodeProgressHooks()
    hooks.before_pipeline_run(Pipeline([first, last]))
    hooks.before_node_run(first)
    hooks.after_node_run()
    for name in ("a", "b", "a", "b"):
        hooks.before_dataset_saved(name)
        hooks.after_dataset_saved()
        assert "done" not in caplog.text
    hooks.before_dataset_loaded("a", last)
    assert "1 of 2 done: first" in caplog.text
    hooks.before_node_run(last)
    hooks.after_node_run()
    assert "2 of 2 done" not in caplog.text
    hooks.after_pipeline_run()
    assert "2 of 2 done: last" in caplog.text
