"""One progress bar for everything that lasts over two seconds."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Generator, Iterable, Iterator
from multiprocessing import current_process
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from rich.console import Console

T = TypeVar("T")
_SHOW_AFTER_SECONDS = 2.0
_LINE_EVERY_SECONDS = 10.0
_TERMINAL = threading.Lock()
"""Of the bar that is shown: another one waits until it has ended."""


def track(items: Iterable[T], what: str, total: int | None = None) -> Generator[T, None, None]:
    """Yield the items and show progress, with a rate and the time left, once two seconds have passed.

    On a terminal it is a bar on standard error, unless another one is shown; elsewhere (a log, CI, a process
    that shares the terminal with others) one line every ten seconds.

    Parameters
    ----------
    items : iterable
    what : str
        What is being done, for the label.
    total : int, optional
        How many there are, if ``items`` has no length.

    Examples
    --------
    >>> list(track([1, 2, 3], "counting"))
    [1, 2, 3]
    """
    from rich.console import Console  # not needed by an import alone

    if total is None and hasattr(items, "__len__"):
        total = len(items)  # type: ignore[arg-type]
    console = Console(file=sys.stderr)
    alone = current_process().name == "MainProcess"
    shown = _bar(items, what, total, console) if console.is_terminal and alone else _lines(items, what, total)
    yield from shown


def _bar(items: Iterable[T], what: str, total: int | None, console: Console) -> Iterator[T]:
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    start = time.monotonic()
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[rate]}"),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
    )
    progress = Progress(*columns, console=console, transient=True)
    task = progress.add_task(what, total=total, rate="")
    started = False
    try:
        for done, item in enumerate(items, 1):
            yield item
            elapsed = time.monotonic() - start
            if not started and elapsed > _SHOW_AFTER_SECONDS and _TERMINAL.acquire(blocking=False):
                started = True
                progress.start()
            progress.update(task, completed=done, rate=_pace(done, elapsed))
    finally:
        if started:
            progress.stop()
            _TERMINAL.release()


def _lines(items: Iterable[T], what: str, total: int | None) -> Iterator[T]:
    start = last = time.monotonic()
    for done, item in enumerate(items, 1):
        yield item
        now = time.monotonic()
        if now - last > _LINE_EVERY_SECONDS:
            last = now
            left = f", {(total - done) * (now - start) / done:.0f} s left" if total else ""
            pace = _pace(done, now - start)
            print(f"{what}: {done}/{total or '?'} ({pace}{left})", file=sys.stderr, flush=True)


def _pace(done: int, seconds: float) -> str:
    """Give a rate, or the seconds that each takes if that is more than one.

    Examples
    --------
    >>> _pace(10, 5.0), _pace(1, 90.0)
    ('2/s', '90 s each')
    """
    return f"{seconds / done:.3g} s each" if seconds > done else f"{done / max(seconds, 1e-9):.3g}/s"
