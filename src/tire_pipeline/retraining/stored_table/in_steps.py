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
from tire_pipeline.files.rows_on_disk import FramesOfRows, RowsOnDisk, joined
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.retraining.scan.folder_difference import FolderDifference
from tire_pipeline.retraining.scan.manifest import Manifest, ManifestEntry
from tire_pipeline.retraining.scan.places import UNREADABLE, Look, Place, place_at
from tire_pipeline.retraining.stored_table.partition import Partition
from tire_pipeline.retraining.stored_table.read_together import category_of, read_in_blocks
from tire_pipeline.tasks import Done, Map, in_turn
from tire_pipeline.tir import read_tir
from tire_pipeline.tire_table.from_models import from_models, join_tables
from tire_pipeline.tire_table.in_pieces import PIECE_ROWS, Scratch

INGEST_TYPES = dict.fromkeys(("file", "category", "status", "reason"), "str")
"""Columns of the report of what is new or not read, and their types."""
READ, PENDING, GROWING, REMOVED = "read", "pending", "growing", "removed"
ASIDE, AGAIN = "set aside", "taken already"
STORED_EVERY_SECONDS = 60.0
"""What is read is stored so often while more is read."""
Row = tuple[str, str, str, str]
"""Of the report, by ``INGEST_TYPES``."""


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
    *_, (now, report) = ingest_in_steps(store, folder, found, read, work, step_seconds=math.inf)
    return now, joined(report)


def ingest_in_steps(
    store: Store,
    folder: str | Path | Objects,
    found: FolderDifference,
    read: Callable[[str | Path], TireModel] = read_tir,
    work: Map = in_turn,
    *,
    step_seconds: float = STORED_EVERY_SECONDS,
    monotonic: Callable[[], float] = time.monotonic,
) -> Iterator[tuple[Store, FramesOfRows]]:
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
    report : iterable of DataFrame
        ``file, category, status, reason``: one row a file that is new, changed, removed or growing, and one
        an entry of the folder that is set aside or leads to what is taken already; in the last step also one
        a file that is still pending. Read from the disk some thousand rows at a time.

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
    rows = _not_read(found)
    wanted = {**found.added, **found.changed}
    gone = [name for name in found.removed if store.manifest.files[name].row_sha256]
    scratch, place = Scratch(), place_at(folder, read)
    before = store.partition.for_rows(len(store.partition.table) + len(wanted), scratch)
    partition = before.with_rows(from_models([]), gone, scratch)
    said, next_step = dict(store.manifest.files), monotonic() + step_seconds

    def taken_up() -> tuple[Store, FramesOfRows]:
        sequence = store.manifest.sequence if partition is before else number
        now = replace(store.manifest, sequence=sequence, files=dict(files), revision=revision)
        return Store(now, store.partition if partition is before else partition), _report(rows)

    revision = store.manifest.revision
    for some in _together(wanted, partition):
        if monotonic() >= next_step and files != said:
            said, began = dict(files), monotonic()
            yield taken_up()
            revision += 1
            next_step = monotonic() + max(step_seconds, 10.0 * (monotonic() - began))
        new = _read(place, {name: wanted[name] for name in some}, files, rows, number, work)
        partition = partition.with_rows(new, (), scratch)
    _add_pending(rows, files)
    yield taken_up()


def _not_read(found: FolderDifference) -> RowsOnDisk:
    """The report of what needs no reading."""
    rows = RowsOnDisk(INGEST_TYPES)
    rows.add(_row(name, REMOVED, "") for name in found.removed)
    rows.add(_row(name, GROWING, "changed too lately; left for the next run") for name in found.growing)
    rows.add(_row(name, ASIDE, reason) for name, reason in found.aside.items())
    rows.add(_row(name, AGAIN, f"a link to {other}") for name, other in found.again.items())
    return rows


def _add_pending(rows: RowsOnDisk, files: Mapping[str, ManifestEntry]) -> None:
    """Add the files that could not be read earlier and are as they were."""
    rows.do("create index by_file on rows (file)")
    for name, entry in files.items():
        if entry.pending and not rows.do("select 1 from rows where file = ?", (name,)).fetchone():
            rows.add([_row(name, PENDING, entry.reason)])


def _report(rows: RowsOnDisk) -> FramesOfRows:
    """What is reported so far: rows that are added later are not among it."""
    (last,) = rows.do("select coalesce(max(rowid), 0) from rows").fetchone()
    query = f"select * from rows where rowid <= {last} order by file, rowid"
    return FramesOfRows(rows, query, INGEST_TYPES)


def _together(names: Collection[str], partition: Partition) -> Iterator[list[str]]:
    """Files that are read together, one part after the other, so that each part is made once or twice."""
    ordered = sorted(names, key=lambda name: (partition.part_of(name), name))
    for start in range(0, len(ordered), PIECE_ROWS):
        yield ordered[start : start + PIECE_ROWS]


def _read(
    place: Place,
    wanted: Mapping[str, tuple[Look, str]],
    files: dict[str, ManifestEntry],
    rows: RowsOnDisk,
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
                rows.add([_row(done.name, GROWING, "changed while it was read; left for the next run")])
                continue
            files[done.name], row = _outcome(done, *wanted[done.name], files.get(done.name), number)
            rows.add([row])
    return join_tables(tables)


def _outcome(
    done: Done[bool], look: Look, digest: str, before: ManifestEntry | None, number: int
) -> tuple[ManifestEntry, Row]:
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


def _row(name: str, status: str, reason: str) -> Row:
    return name, category_of(name), status, reason
