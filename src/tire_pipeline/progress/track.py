"""Progress of everything that lasts over two seconds."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterable, Iterator, Sized
from contextlib import contextmanager
from typing import TypeVar

from tire_pipeline.progress.display import DISPLAY, Activity

T = TypeVar("T")


def track(
    items: Iterable[T], what: str, total: int | None = None, now_at: Callable[[], str] | None = None
) -> Generator[T, None, None]:
    """Yield the items and show progress, with a rate and the time left, once two seconds have passed.

    On a terminal it is a bar on standard error; elsewhere (a log, CI, a process that shares the terminal with
    others) one line every ten seconds. Of several loops within each other the innermost is shown.

    Parameters
    ----------
    items : iterable
    what : str
        What is being done, for the label.
    total : int, optional
        How many there are, if ``items`` has no length.
    now_at : callable, optional
        Returns what is under way at the moment, for the label.

    Examples
    --------
    >>> list(track([1, 2, 3], "counting"))
    [1, 2, 3]
    """
    if total is None and isinstance(items, Sized):
        total = len(items)
    activity = Activity(what, total, now_at=now_at)
    DISPLAY.enter(activity)
    try:
        for item in items:
            yield item
            activity.advance()
    finally:
        DISPLAY.leave(activity)


@contextmanager
def under_way(what: str, now_at: Callable[[], str] | None = None) -> Iterator[None]:
    """Show how long the block has taken, where nothing can be counted.

    Parameters
    ----------
    what : str
        What is being done, for the label.
    now_at : callable, optional
        Returns what of it is under way at the moment, for the label.

    Examples
    --------
    >>> with under_way("thinking"):
    ...     pass
    """
    activity = Activity(what, counted=False, now_at=now_at)
    DISPLAY.enter(activity)
    try:
        yield
    finally:
        DISPLAY.leave(activity)


@contextmanager
def silent() -> Iterator[None]:
    """Show nothing of the block, in a process of many whose parent shows how many tasks are done.

    Examples
    --------
    >>> with silent(), under_way("thinking"):
    ...     pass
    """
    before, DISPLAY.silent = DISPLAY.silent, True
    try:
        yield
    finally:
        DISPLAY.silent = before
