"""Read new and changed files into the stored table, and no others."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

import pandas as pd

from tire_pipeline.errors import cause_in_entry, may_pass
from tire_pipeline.file_names import printable
from tire_pipeline.files.objects import Objects, UnreachableError
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.retraining.manifest import Manifest, ManifestEntry
from tire_pipeline.retraining.partition import Partition
from tire_pipeline.retraining.places import UNREADABLE, Look, Place, place_at
from tire_pipeline.retraining.read_together import category_of, read_in_blocks
from tire_pipeline.retraining.scan import FolderDifference
from tire_pipeline.tasks import Done, Map, in_turn
from tire_pipeline.tir import read_tir
from tire_pipeline.tire_table.from_models import from_models, join_tables
from tire_pipeline.tire_table.in_pieces import PIECE_ROWS, Scratch

INGEST_COLUMNS = ["file", "category", "status", "reason"]
READ, PENDING, GROWING, REMOVED = "read", "pending", "growing", "removed"
ASIDE, AGAIN = "set aside", "taken already"
STORED_EVERY_SECONDS = 60.0
"""What is read is stored so often while more is read."""


@dataclass(frozen=True)
class Store:
    """The table of all files read so far, and the manifest that says what it holds.

    Attributes
    ----------
    manifest : Manifest
    partition : Partition
        The table.
    """

    manifest: Manifest = field(default_factory=Manifest)
    partition: Partition = field(default_factory=Partition)

    @property
    def table(self) -> pd.DataFrame:
        """The whole as one table, sorted by ``file``: for what is known to be small."""
        return self.partition.table.frame()


def ingest(
    store: Store,
    folder: str | Path | Objects,
    found: FolderDifference,
    read: Callable[[str | Path], TireModel] = read_tir,
    work: Map = in_turn,
) -> tuple[Store, pd.DataFrame]:
    """Read what is new as :func:`ingest_in_steps` does, in one step."""
    *_, last = ingest_in_steps(store, folder, found, read, work, step_seconds=math.inf)
    return last


def ingest_in_steps(
    store: Store,
    folder: str | Path | Objects,
    found: FolderDifference,
    read: Callable[[str | Path], TireModel] = read_tir,
    work: Map = in_turn,
    *,
    step_seconds: float = STORED_EVERY_SECONDS,
    monotonic: Callable[[], float] = time.monotonic,
) -> Iterator[tuple[Store, pd.DataFrame]]:
    """Read what is new, drop what is gone, keep all the rest as it is.

    A file that cannot be read is pending: an earlier reading of it stays in the table. It is tried again when
    its content changes, or by the next run where the content is not to blame. A file whose content changes
    while it is read counts as growing.

    Parameters
    ----------
    store : Store
    folder : path or Objects
    found : FolderDifference
        Of this folder against the store's manifest.
    read : callable
        Reads one file of a disk.
    work : Map
        Does the reading.
    step_seconds : float
        s between two steps, or ten times what the caller took for the last one, if that is longer.
    monotonic : callable
        For tests.

    Yields
    ------
    Store
        What is read so far, with the next sequence number if the table changed. A run that is killed after it
        was stored repeats nothing of it. Each has the revision that storing the one before it gives.
    report : DataFrame
        ``file, category, status, reason``: one row a file that is new, changed, removed, growing or still
        pending, and one an entry of the folder that is set aside or leads to what is taken already.

    Raises
    ------
    UnreachableError
        An object store does not answer.
    """
    number = store.manifest.sequence + 1
    removed = set(found.removed)
    files = {name: entry for name, entry in store.manifest.files.items() if name not in removed}
    for name, look in found.touched.items():
        files[name] = replace(files[name], **asdict(look))
    rows = [_row(name, REMOVED, "") for name in found.removed]
    rows += [_row(name, GROWING, "changed too lately; left for the next run") for name in found.growing]
    rows += [_row(name, ASIDE, reason) for name, reason in found.aside.items()]
    rows += [_row(name, AGAIN, f"a link to {other}") for name, other in found.again.items()]
    wanted = {**found.added, **found.changed}
    gone = [name for name in found.removed if store.manifest.files[name].row_sha256]
    scratch, place = Scratch(), place_at(folder, read)
    before = store.partition.for_rows(len(store.partition.table) + len(wanted), scratch)
    partition = before.with_rows(from_models([]), gone, scratch)
    said, next_step = dict(store.manifest.files), monotonic() + step_seconds

    def taken_up() -> tuple[Store, pd.DataFrame]:
        sequence = store.manifest.sequence if partition is before else number
        now = replace(store.manifest, sequence=sequence, files=dict(files), revision=revision)
        return Store(now, store.partition if partition is before else partition), _report(rows, files)

    revision = store.manifest.revision
    for some in _together(wanted, partition):
        if monotonic() >= next_step and files != said:
            said, began = dict(files), monotonic()
            yield taken_up()
            revision += 1
            next_step = monotonic() + max(step_seconds, 10.0 * (monotonic() - began))
        new = _read(place, {name: wanted[name] for name in some}, files, rows, number, work)
        partition = partition.with_rows(new, (), scratch)
    yield taken_up()


def _report(rows: list[dict[str, str]], files: Mapping[str, ManifestEntry]) -> pd.DataFrame:
    reported = {row["file"] for row in rows}
    pending = [_row(n, PENDING, e.reason) for n, e in files.items() if e.pending and n not in reported]
    table = pd.DataFrame([*rows, *pending], columns=INGEST_COLUMNS, dtype="str")
    return table.sort_values("file", ignore_index=True)


def _together(names: Collection[str], partition: Partition) -> Iterator[list[str]]:
    """Files that are read together, one part after the other, so that each part is made once or twice."""
    ordered = sorted(names, key=lambda name: (partition.part_of(name), name))
    for start in range(0, len(ordered), PIECE_ROWS):
        yield ordered[start : start + PIECE_ROWS]


def _read(
    place: Place,
    wanted: Mapping[str, tuple[Look, str]],
    files: dict[str, ManifestEntry],
    rows: list[dict[str, str]],
    number: int,
    work: Map,
) -> pd.DataFrame:
    """The tire table of what could be read; ``files`` and ``rows`` are told of all."""
    tasks = {name: place.reading(name, digest) for name, (_, digest) in wanted.items()}
    tables = []
    for block in work(read_in_blocks(tasks), "reading new .tir files"):
        read = block.result()
        tables.append(read.table)
        for done in read.done:
            if isinstance(done.error, UnreachableError):
                raise done.error
            if done.error is None and not done.value:
                rows.append(_row(done.name, GROWING, "changed while it was read; left for the next run"))
                continue
            files[done.name], row = _outcome(done, *wanted[done.name], files.get(done.name), number)
            rows.append(row)
    return join_tables(tables)


def _outcome(
    done: Done[bool], look: Look, digest: str, before: ManifestEntry | None, number: int
) -> tuple[ManifestEntry, dict[str, str]]:
    """What the manifest says of a file after it was read, and its row of the report."""
    name = done.name
    if done.error is not None and may_pass(done.error) and not digest.startswith(UNREADABLE):
        digest = f"{UNREADABLE}{type(done.error).__name__}"
    if digest.startswith(UNREADABLE):  # whether it can be read now is not told by its look
        look = replace(look, size=-1)
    if done.error is None:
        return ManifestEntry.of(look, digest, digest, number), _row(name, READ, "")
    known, since = (before.row_sha256, before.sequence) if before else ("", number)
    reason = printable(str(cause_in_entry(done.error)))
    stays = "; an earlier reading stays" if known else ""
    return ManifestEntry.of(look, digest, known, since, reason), _row(name, PENDING, f"{reason}{stays}")


def _row(name: str, status: str, reason: str) -> dict[str, str]:
    return {"file": name, "category": category_of(name), "status": status, "reason": reason}
