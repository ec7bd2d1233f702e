"""What shows progress: a row on a terminal, or lines in a log, written by a thread of their own.

So that a single step that lasts long shows, too, before it has ended.
"""

from __future__ import annotations

import atexit
import os
import sys
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from multiprocessing import current_process
from typing import TYPE_CHECKING

from tire_pipeline.pages.visible_text import visible

if TYPE_CHECKING:
    from rich.console import Console
    from rich.progress import Progress, TaskID

TICK_SECONDS = 0.2
SHOW_AFTER_SECONDS = 2.0
LINE_EVERY_SECONDS = 10.0
PAUSE_SECONDS = 1.0
"""Work that begins within so much of earlier work goes on with it: many short steps are long together."""


@dataclass(eq=False)
class Activity:
    """Something that is being done.

    Attributes
    ----------
    what : str
    total : int or None
        How many there are, if that is known.
    counted : bool
    done : int
    began : float
    latest : float
        When the last of those done was done: the rate is that of these, however long the next one takes.
    now_at : callable or None
        Returns what is under way at the moment.
    """

    what: str
    total: int | None = None
    counted: bool = True
    done: int = 0
    began: float = field(default_factory=time.monotonic)
    latest: float = 0.0
    now_at: Callable[[], str] | None = None

    def label(self) -> str:
        """What is being done, and what of it at the moment."""
        at = self.now_at() if self.now_at is not None else ""
        return visible(f"{self.what} ({at})" if at else self.what)

    def count(self) -> str:
        """How many are done of how many."""
        return f"{self.done}/{self.total or '?'}" if self.counted else ""

    def advance(self) -> None:
        """One more is done."""
        self.done += 1
        self.latest = time.monotonic()

    def pace(self) -> str:
        """A rate, or the seconds that each takes if that is more than one."""
        return pace(self.done, self.latest - self.began) if self.done else ""

    def line(self, now: float) -> str:
        """All of it, for a log."""
        so_far = f"{now - self.began:.0f} s so far"
        if not self.counted:
            return f"{self.label()}: {so_far}"
        known = [self.pace()] if self.done else [so_far]
        if self.done and self.total:
            each = (self.latest - self.began) / self.done
            left = (self.total - self.done) * each - (now - self.latest)
            if self.done < self.total and left <= 1.0:  # the pace until now does not hold
                known = [so_far, "this one takes longer"]
            else:
                known.append(f"{left:.0f} s left" if left > 1.0 else so_far)
        return f"{self.label()}: {self.count()} ({', '.join(known)})"


def pace(done: int, seconds: float) -> str:
    """Return a rate, or the seconds that each takes if that is more than one.

    Examples
    --------
    >>> pace(10, 5.0), pace(1, 90.0)
    ('2/s', '90 s each')
    """
    return f"{seconds / done:.3g} s each" if seconds > done else f"{done / max(seconds, 1e-9):.3g}/s"


class Display:
    """Shows the innermost activity of this process that has lasted a moment."""

    def __init__(self) -> None:
        self.silent = False
        self._reset()
        atexit.register(self._end)
        os.register_at_fork(  # so that no stream or import is locked in a child by a thread that it lacks
            before=self._lock,
            after_in_parent=self._unlock,
            after_in_child=self._reset,
        )

    def _lock(self) -> None:
        self._changed.acquire()

    def _unlock(self) -> None:
        self._changed.release()

    def _reset(self) -> None:
        self._changed = threading.Condition(threading.RLock())
        self.active: list[Activity] = []
        self._over = threading.Event()
        self._began = self._ended = self._said = -PAUSE_SECONDS
        self._thread: threading.Thread | None = None
        self._console: Console | None = None
        self._row: Progress | None = None
        self._shown: tuple[Activity, TaskID] | None = None

    def enter(self, activity: Activity) -> None:
        """Begin an activity."""
        if self.silent or self._over.is_set():
            return
        with self._changed:
            now = time.monotonic()
            if not self.active and now - self._ended > PAUSE_SECONDS:
                self._began = self._said = now
            self.active.append(activity)
            if self._thread is None or not self._thread.is_alive():
                self._thread = threading.Thread(target=self._watch, name="progress", daemon=True)
                self._thread.start()
            self._changed.notify()

    def leave(self, activity: Activity) -> None:
        """End an activity."""
        if self._over.is_set():
            return
        with self._changed, suppress(ValueError):  # a generator of a forked process may end one of its parent
            self.active.remove(activity)
            if not self.active:
                self._hide()
                self._ended = time.monotonic()

    def _watch(self) -> None:
        """Show what is under way; a stream that is closed ends this, and nothing else."""
        with suppress(OSError, ValueError):
            while True:
                with self._changed:
                    while not self.active and not self._over.is_set():
                        self._changed.wait()
                    if self._over.is_set():
                        return
                    self._show(time.monotonic())
                self._over.wait(TICK_SECONDS)

    def _show(self, now: float) -> None:
        if now - self._began < SHOW_AFTER_SECONDS:
            return
        if self._console is None:
            self._console = _console()
        drawn = self._console.is_terminal and current_process().name == "MainProcess"
        least = TICK_SECONDS if drawn else SHOW_AFTER_SECONDS
        lasting = [each for each in self.active if now - each.began > least]
        if lasting and drawn:
            self._draw_row(self._console, lasting[-1], now)
        elif lasting:
            self._write_line(lasting[-1], now, over_a_row=self._console.is_terminal)

    def _write_line(self, activity: Activity, now: float, over_a_row: bool) -> None:
        if now - self._said < LINE_EVERY_SECONDS:
            return
        self._said = now
        start = "\r\x1b[K" if over_a_row else ""  # the row of the process that this one belongs to
        print(f"{start}{activity.line(now)}", file=sys.stderr, flush=True)

    def _draw_row(self, console: Console, activity: Activity, now: float) -> None:
        new = self._row is None
        if self._row is None:
            self._row = _row(console)
        if self._shown is None or self._shown[0] is not activity:
            if self._shown is not None:
                self._row.remove_task(self._shown[1])
            task = self._row.add_task(activity.what, total=activity.total, visible=False, count="", pace="")
            self._row.tasks[0].start_time = self._row.get_time() - (now - activity.began)
            self._shown = (activity, task)
        self._row.update(
            self._shown[1],
            description=activity.label(),
            completed=activity.done,
            visible=True,
            count=activity.count(),
            pace=activity.pace(),
        )
        if new:
            self._row.start()
        self._row.refresh()

    def _end(self) -> None:
        """End the thread before the interpreter does: it would stop wherever it is, and keep its lock."""
        with self._changed:
            self._over.set()
            self._hide()
            self._changed.notify()
        if self._thread is not None:
            self._thread.join(PAUSE_SECONDS)

    def _hide(self) -> None:
        if self._row is not None:
            with suppress(OSError, ValueError):
                self._row.stop()
            self._began = time.monotonic()
        self._row = self._shown = self._console = None


def _console() -> Console:
    from rich.console import Console  # not needed by an import alone

    return Console(file=sys.stderr)


def _row(console: Console) -> Progress:
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn
    from rich.table import Column

    return Progress(
        TextColumn(
            "{task.description}",
            markup=False,  # brackets in a file's name are no markup
            table_column=Column(no_wrap=True, overflow="ellipsis"),
        ),
        BarColumn(),
        TextColumn("{task.fields[count]}"),
        TextColumn("{task.fields[pace]}"),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
        console=console,
        transient=True,
        auto_refresh=False,
        redirect_stdout=sys.stdout.isatty(),  # what goes into a file stays there
    )


DISPLAY = Display()
"""Of this process."""
