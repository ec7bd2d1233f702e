"""What lies in the folder now, compared with the manifest; files that still grow wait."""

from __future__ import annotations

import hashlib
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from tire_pipeline.errors import DomainError
from tire_pipeline.files.objects import Objects
from tire_pipeline.retraining.scan.hash_together import hash_in_blocks
from tire_pipeline.retraining.scan.manifest import Manifest
from tire_pipeline.retraining.scan.places import UNREADABLE, Look, place_at
from tire_pipeline.tasks import Map, in_turn


@dataclass(frozen=True)
class FolderDifference:
    """The folder against the manifest.

    Attributes
    ----------
    added, changed : dict
        File -> (its look, SHA-256 of its content, :func:`.places.fingerprint`). ``changed`` is in the
        manifest with another content.
    removed : list of str
    growing : list of str
        Changed too lately to be trusted; they are in neither of the others.
    touched : dict
        File -> look: other dates, same content.
    aside : dict
        Entry -> why it was not taken: no regular file, a folder without permission, a link to itself...
        What is known of a file there stays, as it may still be there.
    again : dict
        Link -> what it leads to, which is taken already.
    """

    added: dict[str, tuple[Look, str]] = field(default_factory=dict)
    changed: dict[str, tuple[Look, str]] = field(default_factory=dict)
    removed: list[str] = field(default_factory=list)
    growing: list[str] = field(default_factory=list)
    touched: dict[str, Look] = field(default_factory=dict)
    aside: dict[str, str] = field(default_factory=dict)
    again: dict[str, str] = field(default_factory=dict)

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


def look_at(folder: str | Path | Objects) -> dict[str, Look]:
    """Size and dates of all ``.tir`` files below a folder, each once, hidden ones left out.

    Parameters
    ----------
    folder : path or Objects

    Returns
    -------
    dict
        Name relative to the folder, with ``/``, escaped (:mod:`tire_pipeline.file_names`) -> :class:`Look`.

    Raises
    ------
    DomainError
        The folder itself may not be read.
    """
    return place_at(folder).look()[0]


def difference(
    folder: str | Path | Objects,
    manifest: Manifest,
    *,
    settle_seconds: float = 5.0,
    now: float | None = None,
    rehash_all: bool = False,
    still: Still | None = None,
    work: Map = in_turn,
) -> FolderDifference:
    """Compare a folder with the manifest by content.

    Only files whose size or dates differ from the manifest's are read. A file whose date lies less than
    ``settle_seconds`` back counts as growing. A date in the future says nothing (clocks differ, and go
    back): with a single look such a file is taken; :func:`settled_difference` looks twice. An object of a
    store is whole when it is there, so none counts as growing.

    Parameters
    ----------
    folder : path or Objects
    manifest : Manifest
    settle_seconds : float
        s.
    now : float, optional
        s since 1970; the clock if left out.
    rehash_all : bool
        Read every file, whatever its size and dates.
    still : Still, optional
        What earlier looks saw. With it a file that is dated in the future waits, too.
    work : Map
        Does the hashing.
    """
    clock = time.time() if now is None else now
    seen = _seen(folder, manifest, settle_seconds, clock, rehash_all, still)
    return _hashed(folder, manifest, seen, work)


@dataclass(frozen=True)
class _Seen:
    """A folder before any file was read: what its looks tell, and the files to hash."""

    found: FolderDifference
    to_hash: dict[str, Look]


def _seen(
    folder: str | Path | Objects,
    manifest: Manifest,
    settle_seconds: float,
    clock: float,
    rehash_all: bool,
    still: Still | None,
) -> _Seen:
    place = place_at(folder)
    looks, found = place.look()
    gone = (name for name in manifest.files if name not in looks and not found.may_be_there(name))
    result = FolderDifference(removed=sorted(gone), aside=found.aside, again=found.again)
    to_hash: dict[str, Look] = {}
    for name, look in looks.items():
        known = manifest.files.get(name)
        seen = known is not None and look == known.look
        if not seen and place.grows and _grows(name, look, clock, settle_seconds, still):
            result.growing.append(name)
        elif rehash_all or not seen:
            to_hash[name] = look
    result.growing.sort()
    return _Seen(result, to_hash)


def _hashed(folder: str | Path | Objects, manifest: Manifest, seen: _Seen, work: Map) -> FolderDifference:
    """Tell apart by content what may be new, changed or as before."""
    place, digests, result = place_at(folder), dict[str, str](), seen.found
    for block in work(hash_in_blocks(place, list(seen.to_hash)), "hashing .tir files"):
        digests.update(block.result())
    gone = [name for name, digest in digests.items() if not digest]
    digests.update(place.fingerprints(gone))  # a worker that does not see the folder says so of all
    for name, look in seen.to_hash.items():
        known, digest = manifest.files.get(name), digests[name]
        if not digest:
            continue  # gone meanwhile; the next run sees it as removed
        if known is None:
            result.added[name] = (look, digest)
        elif known.sha256 != digest:
            result.changed[name] = (look, digest)
        elif not digest.startswith(UNREADABLE):
            result.touched[name] = look
    return result


@dataclass
class Still:
    """How long each file has kept its size and dates, by the watcher's own count of seconds.

    Attributes
    ----------
    waited : float
        s since the first look.
    most : float
        s that will be waited at most.
    """

    most: float
    waited: float = 0.0
    _first: dict[str, tuple[Look, float]] = field(default_factory=dict)

    def seconds(self, name: str, look: Look) -> float:
        """For how long this file has looked so."""
        before, since = self._first.get(name, (look, self.waited))
        if before != look:
            since = self.waited
        self._first[name] = (look, since)
        return self.waited - since


def _grows(name: str, look: Look, clock: float, settle_seconds: float, still: Still | None) -> bool:
    age = clock - look.mtime_ns / 1e9
    if still is None:
        return 0.0 <= age < settle_seconds
    seconds = still.seconds(name, look)
    if age < 0.0:  # its date tells nothing
        return seconds < min(settle_seconds, still.most)
    return age < settle_seconds and seconds < settle_seconds


def settled_difference(
    folder: str | Path | Objects,
    manifest: Manifest,
    *,
    settle_seconds: float = 5.0,
    most_wait_seconds: float = 60.0,
    rehash_all: bool = False,
    sleep: Callable[[float], None] = time.sleep,
    work: Map = in_turn,
) -> FolderDifference:
    """Compare as :func:`difference` does, after waiting a while for files that still grow.

    Nothing is hashed before the waiting is over.

    A file counts as settled, too, when it was looked at twice ``settle_seconds`` apart (or as long as the
    run waits at most) and had the same size and dates: so neither a clock that goes back nor a server whose
    clock is ahead keeps a file out, or lets a half-written one in.

    Parameters
    ----------
    folder, manifest, settle_seconds, rehash_all
        As for :func:`difference`.
    most_wait_seconds : float
        Then the growing ones are left for the next run.
    sleep : callable
        For tests.
    work : Map
        Does the hashing.
    """
    still = Still(most_wait_seconds)
    while True:
        seen = _seen(folder, manifest, settle_seconds, time.time(), rehash_all, still)
        if not seen.found.growing or still.waited >= most_wait_seconds:
            return _hashed(folder, manifest, seen, work)
        step = min(max(settle_seconds, 0.1), most_wait_seconds - still.waited)
        sleep(step)
        still.waited += step


def check_removed(found: FolderDifference, manifest: Manifest, most_share: float, where: str) -> None:
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
            todo="if that is meant, raise retrain.most_removed_share; otherwise restore the folder",
        )
