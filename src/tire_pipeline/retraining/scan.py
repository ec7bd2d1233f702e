"""What lies in the folder now, compared with the manifest; files that still grow wait."""

from __future__ import annotations

import hashlib
import os
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from tire_pipeline.errors import DomainError
from tire_pipeline.retraining.manifest import Manifest

SIDECAR = ".sidecar.json"
_CHUNK = 1 << 20


@dataclass(frozen=True, slots=True)
class Look:
    """Size and dates of a file and its sidecar together."""

    size: int
    mtime_ns: int
    ctime_ns: int


@dataclass(frozen=True)
class Difference:
    """The folder against the manifest.

    Attributes
    ----------
    added, changed : dict
        File -> (its look, SHA-256 of its content). ``changed`` is in the manifest with another content.
    removed : list of str
    growing : list of str
        Changed too lately to be trusted; they are in neither of the others.
    touched : dict
        File -> look: other dates, same content.
    """

    added: dict[str, tuple[Look, str]] = field(default_factory=dict)
    changed: dict[str, tuple[Look, str]] = field(default_factory=dict)
    removed: list[str] = field(default_factory=list)
    growing: list[str] = field(default_factory=list)
    touched: dict[str, Look] = field(default_factory=dict)

    def __bool__(self) -> bool:
        return bool(self.added or self.changed or self.removed)

    @property
    def key(self) -> str:
        """One hash for this difference: the same files with the same contents give the same key."""
        total = hashlib.sha256()
        for kind, files in (("added", self.added), ("changed", self.changed)):
            for name in sorted(files):
                total.update(f"{kind}\0{name}\0{files[name][1]}\n".encode())
        for name in sorted(self.removed):
            total.update(f"removed\0{name}\n".encode())
        return total.hexdigest()[:24]


def look_at(folder: str | Path) -> dict[str, Look]:
    """Size and dates of all ``.tir`` files below a folder, hidden ones left out.

    Parameters
    ----------
    folder : path

    Returns
    -------
    dict
        Path relative to the folder, with ``/`` -> :class:`Look`.

    Raises
    ------
    DomainError
        A folder may not be read.
    """
    found: dict[str, Look] = {}
    root = os.path.abspath(folder)
    for here, folders, names in os.walk(root, onerror=_stop, followlinks=True):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        prefix = "" if here == root else os.path.relpath(here, root).replace(os.sep, "/") + "/"
        present = set(names)
        for name in names:
            if name.startswith(".") or not name.lower().endswith(".tir"):
                continue
            look = _look(os.path.join(here, name), name + SIDECAR in present)
            if look is not None:
                found[prefix + name] = look
    return found


def _look(path: str, sidecar: bool) -> Look | None:
    try:
        stats = [os.stat(path)]
        if sidecar:
            stats.append(os.stat(path + SIDECAR))
    except FileNotFoundError:  # gone since the folder was listed
        return None
    return Look(
        sum(s.st_size for s in stats), max(s.st_mtime_ns for s in stats), max(s.st_ctime_ns for s in stats)
    )


def fingerprint(path: str | Path) -> str:
    """SHA-256 of a file's content, and of its sidecar's where there is one; empty if it is gone."""
    total = hashlib.sha256()
    for each in (str(path), f"{path}{SIDECAR}"):
        try:
            with open(each, "rb") as file:
                while chunk := file.read(_CHUNK):
                    total.update(chunk)
        except FileNotFoundError:
            if not each.endswith(SIDECAR):
                return ""
            continue
        except OSError as error:
            total.update(f"cannot be read: {error.errno}".encode())
        total.update(b"\0")
    return total.hexdigest()


def difference(
    folder: str | Path,
    manifest: Manifest,
    *,
    settle_seconds: float = 5.0,
    now: float | None = None,
    rehash_all: bool = False,
) -> Difference:
    """Compare a folder with the manifest by content.

    Only files whose size or dates differ from the manifest's are read. A file whose date lies less than
    ``settle_seconds`` back counts as growing. A date in the future says nothing about growing (clocks
    differ); if such a file was caught half-written, its content differs next time, and it is read again.

    Parameters
    ----------
    folder : path
    manifest : Manifest
    settle_seconds : float
        s.
    now : float, optional
        s since 1970; the clock if left out.
    rehash_all : bool
        Read every file, whatever its size and dates.
    """
    clock = time.time() if now is None else now
    looks = look_at(folder)
    result = Difference(removed=sorted(set(manifest.files) - set(looks)))
    for name, look in looks.items():
        known = manifest.files.get(name)
        seen = known is not None and look == Look(known.size, known.mtime_ns, known.ctime_ns)
        if seen and not rehash_all:
            continue
        if 0.0 <= clock - look.mtime_ns / 1e9 < settle_seconds and not seen:
            result.growing.append(name)
            continue
        digest = fingerprint(Path(folder) / name)
        if not digest:
            continue  # gone meanwhile; the next run sees it as removed
        if known is None:
            result.added[name] = (look, digest)
        elif known.sha256 != digest:
            result.changed[name] = (look, digest)
        else:
            result.touched[name] = look
    result.growing.sort()
    return result


def settled_difference(
    folder: str | Path,
    manifest: Manifest,
    *,
    settle_seconds: float = 5.0,
    most_wait_seconds: float = 60.0,
    rehash_all: bool = False,
    sleep: Callable[[float], None] = time.sleep,
) -> Difference:
    """Compare as :func:`difference` does, after waiting a while for files that still grow.

    Parameters
    ----------
    folder, manifest, settle_seconds, rehash_all
        As for :func:`difference`.
    most_wait_seconds : float
        Then the growing ones are left for the next run.
    sleep : callable
        For tests.
    """
    waited = 0.0
    while True:
        found = difference(folder, manifest, settle_seconds=settle_seconds, rehash_all=rehash_all)
        if not found.growing or waited >= most_wait_seconds:
            return found
        step = min(max(settle_seconds, 0.1), most_wait_seconds - waited)
        sleep(step)
        waited += step


def check_removed(found: Difference, manifest: Manifest, most_share: float, where: str) -> None:
    """Stop if so many files are gone that a folder is more likely not mounted than emptied.

    Raises
    ------
    DomainError
        More than ``most_share`` of the files are gone.
    """
    total: Mapping[str, object] = manifest.files
    if total and len(found.removed) > most_share * len(total):
        raise DomainError(
            f"{len(found.removed)} of {len(total)} files are gone",
            where=where,
            todo="if that is meant, raise retrain.most_removed_share; else bring the folder back",
        )


def _stop(error: OSError) -> None:
    if not isinstance(error, FileNotFoundError):
        raise DomainError(
            f"this folder may not be read ({error.strerror})",
            where=str(error.filename),
            todo="allow reading it, or take it out of the folder of .tir files",
        ) from error
