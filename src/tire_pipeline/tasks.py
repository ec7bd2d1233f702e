"""Many independent pieces of work, each with a name, for code that does not know about clusters."""

from __future__ import annotations

import errno
import logging
import os
import sys
import threading
import time
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import BrokenExecutor
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Generic, Protocol, TypeVar, cast, runtime_checkable

from tire_pipeline.errors import DomainError
from tire_pipeline.progress import silent, track, under_way

if TYPE_CHECKING:
    from threadpoolctl import ThreadpoolController

_T = TypeVar("_T")
_T_co = TypeVar("_T_co", covariant=True)
_LOG = logging.getLogger(__name__)
_LABELS_SHOWN = 4
_LABEL_LENGTH = 60
_DIED = "the process that did it died three times"
_TODO_FOR_LOST_TASK = "take it out, or run where there is more memory"
DEATHS = 3
"""How often the process of a task may die before the task is set aside."""
_LOOKS_FOR_RUN_EVERY = 1.0
"""s. How often a process of a run looks whether the run lives."""
_WAITING: set[int] = set()
"""How many processes wait for more tasks."""


class LostTaskError(DomainError):
    """A task has ended the process that did it, again and again; the next run may have more memory."""

    passing = True


class Task(Protocol[_T_co]):
    """A piece of work: a function without arguments that can be pickled."""

    def __call__(self) -> _T_co:
        """Do it."""
        ...


@runtime_checkable
class Divided(Protocol[_T]):
    """A task of several files, which can be done one by one."""

    def split(self) -> Mapping[str, Task[_T]]:
        """Return one task for each file."""
        ...

    def join(self, parts: list[_T]) -> _T:
        """Return what all of it gives, from what its parts gave."""
        ...


@dataclass(frozen=True)
class Done(Generic[_T]):
    """What became of a task.

    Attributes
    ----------
    name : str
    value : object
    error : Exception or None
        What the task raised.
    """

    name: str
    value: _T | None = None
    error: Exception | None = None

    def result(self) -> _T:
        """The value; raises what the task raised."""
        if self.error is not None:
            raise self.error
        return cast(_T, self.value)


class Map(Protocol):
    """Does tasks, one after another or many at once, and gives each when it is done, in any order."""

    def __call__(self, tasks: Mapping[str, Task[_T]], what: str) -> Iterator[Done[_T]]:
        """Do the tasks; ``what`` is said of them while they are done."""
        ...


def attempt(name: str, task: Task[_T]) -> Done[_T]:
    """Do one task with one thread: its result does not depend on where it is done.

    Parameters
    ----------
    name : str
    task : callable
    """
    try:
        with one_thread():
            return Done(name, task())
    except Exception as error:
        return Done(name, error=error)


@contextmanager
def one_thread() -> Iterator[None]:
    """Keep linear algebra to one thread in the block.

    Its threads wait for each other by spinning. With many small matrices on a machine that does other things,
    too, this takes several times the time of one thread.

    Examples
    --------
    >>> with one_thread():
    ...     pass
    """
    with _pools(len(sys.modules)).limit(limits=1):
        yield


@lru_cache(maxsize=1)
def _pools(modules: int) -> ThreadpoolController:
    """The thread pools of this process; looking for them takes milliseconds, so only after imports."""
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()


def shown(
    done: Iterator[Done[_T]], what: str, tasks: Mapping[str, Task[_T]], at_once: int
) -> Iterator[Done[_T]]:
    """The same, with progress in the terminal, and a line for each task that failed.

    Parameters
    ----------
    done : iterator
    what : str
        The label.
    tasks : mapping
        In the order in which they are begun. A task is shown by its name, or by its ``label``.
    at_once : int
        How many are under way at the same time; zero if it is not known which.
    """
    waiting = {name: shortened(getattr(task, "label", name)) for name, task in tasks.items()}

    def now_at() -> str:
        named = list(waiting.values())[:at_once] if at_once <= _LABELS_SHOWN else []
        return "; ".join(filter(None, named))

    def each_done() -> Iterator[Done[_T]]:
        if len(tasks) > at_once or at_once == 1:
            yield from track(done, what, total=len(tasks), now_at=now_at)
            return
        with under_way(what, now_at=now_at):  # all begin at once: how many are done tells no time left
            yield from done

    for each in each_done():
        waiting.pop(each.name, None)
        if each.error is not None:
            _LOG.warning("%s: %s: %s", what, each.name, each.error)
        yield each


def shortened(label: str) -> str:
    """Leave out the middle of a label that would fill the line of progress.

    Examples
    --------
    >>> shortened("A/one.tir"), shortened("x" * 300)
    ('A/one.tir', 'xxxxxxxxxxxxxxxxxxxx...xxxxxxxxxxxxxxxxxxxx')
    """
    return label if len(label) <= _LABEL_LENGTH else f"{label[:20]}...{label[-20:]}"


def in_turn(tasks: Mapping[str, Task[_T]], what: str) -> Iterator[Done[_T]]:
    """Do tasks one after another in this process.

    Examples
    --------
    >>> [(each.name, each.result()) for each in in_turn({"a": lambda: 1}, "counting")]
    [('a', 1)]
    """
    yield from shown((attempt(name, task) for name, task in tasks.items()), what, tasks, 1)


def attempt_in_silence(name: str, task: Task[_T]) -> Done[_T]:
    """Attempt a task in a process of its own: that it is done is shown by the process that waits for it."""
    with silent():
        return attempt(name, task)


def in_processes(count: int) -> Map:
    """Return a map that runs up to ``count`` tasks at once, each in a process of this machine.

    Parameters
    ----------
    count : int
        One: :func:`in_turn`.

    Notes
    -----
    A process that dies (the system has no memory left, a compiled reader crashes) costs nothing but time:
    what was under way is done again, each task alone, and one whose process dies again is set aside. So a
    single task, too, is done in a process of its own: it may be the one that a run before has set aside.
    """
    if count <= 1:
        return in_turn

    def work(tasks: Mapping[str, Callable[[], _T]], what: str) -> Iterator[Done[_T]]:
        if tasks:
            yield from shown(_surviving(tasks, what, count), what, tasks, count)

    return work


def _surviving(tasks: Mapping[str, Task[_T]], what: str, count: int) -> Iterator[Done[_T]]:
    one_each = len(tasks) <= count  # how many are done says nothing until the end
    waiting, left = iter(tasks), dict.fromkeys(tasks)
    while True:
        try:
            for done in _in_pool(tasks, waiting, count, one_each):
                del left[done.name]
                yield done
        except BrokenExecutor:
            _LOG.warning("%s: a process died; what was under way is tried again, each alone", what)
        else:
            break
    for name in left:
        yield done_alone(name, tasks[name], _in_own_process, what)


def _in_pool(
    tasks: Mapping[str, Task[_T]], names: Iterable[str], count: int, steps: bool = False
) -> Iterator[Done[_T]]:
    """Do tasks in up to ``count`` processes, at least two, of this machine.

    The processes show the steps of all tasks, or of those that ask for it (:class:`Labelled`).

    Raises
    ------
    concurrent.futures.BrokenExecutor
        One of them died.
    """
    from joblib import Parallel, delayed

    # joblib replaces a process whose memory has grown; no task is lost by it
    warnings.filterwarnings("ignore", message="A worker stopped while some jobs", category=UserWarning)
    _WAITING.add(count)
    parallel = Parallel(n_jobs=count, return_as="generator_unordered")
    yield from parallel(
        delayed(_for_run)(os.getpid(), name, tasks[name], steps or getattr(tasks[name], "steps", False))
        for name in names
    )


def _for_run(run: int, name: str, task: Task[_T], steps: bool) -> Done[_T]:
    """Attempt a task in a process of a run's own."""
    _end_with(run)
    return attempt(name, task) if steps else attempt_in_silence(name, task)


@lru_cache(maxsize=1)
def _end_with(run: int) -> None:
    """End this process soon after the run that it works for, should that be killed.

    It would finish its task, then wait for minutes for another one, or for ever for its result to be taken,
    with all its memory. The run may be gone before this process begins the task.
    """

    def watch() -> None:
        while os.getppid() == run or _is_there(run):
            time.sleep(_LOOKS_FOR_RUN_EVERY)
        os._exit(1)

    threading.Thread(target=watch, name="watches the run", daemon=True).start()


def _is_there(process: int) -> bool:
    """Whether there is a process of this number."""
    try:
        os.kill(process, 0)
    except OSError as error:
        return error.errno == errno.EPERM
    return True


def _in_own_process(name: str, task: Task[_T]) -> Done[_T] | None:
    """As :func:`done_alone` asks for."""
    for _ in range(DEATHS):
        with suppress(BrokenExecutor):
            return next(_in_pool({name: task}, [name], 2))
    return None


def done_alone(
    name: str, task: Task[_T], try_it: Callable[[str, Task[_T]], Done[_T] | None], what: str
) -> Done[_T]:
    """Do a task whose process died with no other task under way, so that the death is its own.

    A task of several files is divided, until the file is found.

    Parameters
    ----------
    name : str
    task : callable
    try_it : callable
        Does a task; None if its process died :data:`DEATHS` times.
    what : str
        Is said of it.
    """
    parts: Mapping[str, Task[_T]] = {}
    if isinstance(task, Divided):
        parts = task.split()
        if len(parts) > 1:
            done = [done_alone(each, part, try_it, what).result() for each, part in parts.items()]
            return Done(name, task.join(done))
    outcome = try_it(name, task)
    if outcome is not None:
        return outcome
    only = next(iter(parts), name)
    _LOG.warning("%s: %s is set aside: %s", what, only, _DIED)
    if hasattr(task, "lost"):
        return Done(name, task.lost(f"{_DIED} -> {_TODO_FOR_LOST_TASK}"))
    return Done(name, error=LostTaskError(_DIED, where=only, todo=_TODO_FOR_LOST_TASK))


def end_processes() -> None:
    """End the processes of :func:`in_processes`, which wait for more tasks.

    At the end of this process they would end by themselves, but take seconds for it.
    """
    if _WAITING:
        from joblib.externals.loky import get_reusable_executor

        get_reusable_executor(reuse=True).shutdown(wait=True, kill_workers=True)
        _WAITING.clear()


def all_done(work: Map, tasks: Mapping[str, Task[_T]], what: str) -> dict[str, Done[_T]]:
    """Do all tasks; what became of each, in the tasks' own order."""
    found = {each.name: each for each in work(tasks, what)}
    return {name: found[name] for name in tasks}


@dataclass(frozen=True)
class Labelled(Generic[_T]):
    """A task with the words by which progress shows it, where its name is the key under which it is stored.

    Attributes
    ----------
    label : str
    task : callable
    steps : bool
        Its process shows its steps, too, because it takes long beside the others.

    Examples
    --------
    >>> Labelled("case 3", lambda: 9)()
    9
    """

    label: str
    task: Task[_T]
    steps: bool = False

    def __call__(self) -> _T:
        """Do the task."""
        return self.task()
