"""Errors that users see: each says what is wrong, where, and what to do."""

from __future__ import annotations

import errno
from collections.abc import Iterable
from typing import Any

from tire_pipeline.file_names import printable, printable_name


def did_you_mean(name: str, known: Iterable[str], otherwise: str, cutoff: float = 0.6) -> str:
    """Return what to do about a name that is not known: the nearest one, or else some other advice.

    Examples
    --------
    >>> did_you_mean("wera", ["wear", "camber"], "there are two")
    "did you mean 'wear'?"
    """
    from difflib import get_close_matches  # errors are rare, and this module is imported by all

    near = get_close_matches(name, list(known), n=1, cutoff=cutoff)
    return f"did you mean {near[0]!r}?" if near else otherwise


_ADVICE_ON_SYSTEM = {
    errno.ENOSPC: "the disk is full: make room, then run again",
    errno.EDQUOT: "the disk quota is used up: make room, then run again",
    errno.EACCES: "no permission: allow reading and writing there, then run again",
    errno.EPERM: "no permission: allow reading and writing there, then run again",
    errno.EROFS: "the folder is read-only: choose another, or mount it writable",
    errno.EISDIR: "this is a folder: choose another name",
}


def system_advice(error: OSError) -> str:
    """Return what the system refused and what to do, the file first; empty if nothing general can be said.

    Examples
    --------
    >>> system_advice(OSError(errno.ENOSPC, "No space left on device", "a.html"))
    'a.html: the disk is full: make room, then run again'
    """
    advice = _ADVICE_ON_SYSTEM.get(error.errno or 0)
    return f"{error.filename}: {advice}" if advice and error.filename else advice or ""


class TirePipelineError(Exception):
    """Base of all errors that this project raises on purpose.

    Parameters
    ----------
    what : str
        What is wrong, in one sentence.
    where : str, optional
        ``file:line``, node or dataset.
    todo : str, optional
        What the user can do about it.
    """

    def __init__(self, what: str, *, where: str | None = None, todo: str | None = None) -> None:
        self.what = what
        self.where = where
        self.todo = todo
        super().__init__(what, where, todo)

    def __str__(self) -> str:
        text = f"{printable_name(str(self.where))}: {self.what}" if self.where else self.what
        return printable(f"{text} -> {self.todo}" if self.todo else text)

    def __reduce__(self) -> tuple[Any, ...]:
        """Errors cross from one process to another with all that they say."""
        return _restored, (type(self), self.args, self.__dict__)


def _restored(
    cls: type[TirePipelineError], args: tuple[Any, ...], state: dict[str, Any]
) -> TirePipelineError:
    error = cls.__new__(cls, *args)
    error.__dict__.update(state)
    return error


class TirError(TirePipelineError, ValueError):
    """Anything wrong with a tire model or its property file.

    Parameters
    ----------
    what, where, todo : str
        As in :class:`TirePipelineError`.
    path : str, optional
        The file.
    line : int, optional
        The line, counted from 1.
    key : str, optional
        The coefficient or key concerned.

    See Also
    --------
    tire_pipeline.tir.read_tir : Raises it where a file cannot be read.
    tire_pipeline.tir.write_tir : Raises it where a model cannot be written.

    Notes
    -----
    It is a ``ValueError``, too. What it says ends with what to do.

    Examples
    --------
    >>> from tire_pipeline.tir import TirError, read_tir
    >>> try:
    ...     read_tir("not_there.tir")
    ... except TirError as error:
    ...     print(error)
    not_there.tir: cannot be read: No such file or directory -> check the path and its permissions
    """

    def __init__(
        self,
        what: str,
        *,
        path: str | None = None,
        line: int | None = None,
        key: str | None = None,
        where: str | None = None,
        todo: str | None = None,
    ) -> None:
        self.path = path
        self.line = line
        self.key = key
        if where is None and path is not None:
            where = f"{path}:{line}" if line is not None else str(path)
        super().__init__(what, where=where, todo=todo)


class TirSyntaxError(TirError):
    """The file is not a tire property file, or a line of it cannot be read."""


class TirValueError(TirError):
    """A coefficient or an operating point has a value that makes no sense."""


class TirVersionError(TirError):
    """The file's Magic Formula version is not one of those that are known."""


class TirShapeError(TirError):
    """Arrays of operating points do not broadcast against each other."""


class DomainError(TirePipelineError, ValueError):
    """A domain function was asked for something impossible (empty fleet, unknown category...)."""


class RecordingError(TirePipelineError, ValueError):
    """A recording cannot be read, or does not hold what is needed."""


def chain(error: BaseException) -> list[BaseException]:
    """The error and all that caused it, outermost first."""
    found: list[BaseException] = []
    current: BaseException | None = error
    while current is not None and current not in found:
        found.append(current)
        current = current.__cause__ or current.__context__
    return found


def cause_in_entry(error: BaseException) -> Exception:
    """What is wrong with the file or recording that was being read, so that only this one is set aside.

    Parameters
    ----------
    error : Exception
        Whatever came out of reading it; a loader may have wrapped what went wrong.

    Returns
    -------
    Exception
        The first in the chain that a user can do something about. Where there is none, the program is at
        fault: then it says so, and names what went wrong.
    """
    causes = chain(error)
    for each in causes:
        if isinstance(each, TirePipelineError | OSError):
            return each
    kind, text = type(causes[-1]).__name__, str(causes[-1])
    return RuntimeError(f"a fault of this program ({kind}: {text}) -> report it with this file")


def may_pass(error: BaseException) -> bool:
    """Whether the same file may be read next time, though it has not changed."""
    if not isinstance(cause_in_entry(error), TirePipelineError):
        return True
    return any(isinstance(each, OSError) or getattr(each, "passing", False) for each in chain(error))
