"""New and changed files into the stored table, and nothing else read."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

import pandas as pd

from tire_pipeline.errors import TirePipelineError
from tire_pipeline.file_names import path_of, printable
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.retraining.manifest import Manifest, ManifestEntry
from tire_pipeline.retraining.scan import FolderDifference, fingerprint
from tire_pipeline.tasks import Map, in_blocks, in_turn
from tire_pipeline.tir import read_tir
from tire_pipeline.tire_table import from_models, physical_tire_ids

INGEST_COLUMNS = ["file", "category", "status", "reason"]
READ, PENDING, GROWING, REMOVED = "read", "pending", "growing", "removed"
ASIDE, AGAIN = "set aside", "taken already"


@dataclass(frozen=True)
class Store:
    """The table of all files read so far, and the manifest that says what it holds.

    Attributes
    ----------
    manifest : Manifest
    table : DataFrame
        A tire table, sorted by ``file``.
    """

    manifest: Manifest = field(default_factory=Manifest)
    table: pd.DataFrame = field(default_factory=lambda: from_models([]))


def ingest(
    store: Store,
    folder: str | Path,
    found: FolderDifference,
    read: Callable[[str | Path], TireModel] = read_tir,
    work: Map = in_turn,
) -> tuple[Store, pd.DataFrame]:
    """Read what is new, drop what is gone, keep all the rest as it is.

    A file that cannot be read is pending: an earlier reading of it stays in the table, and it is tried again
    when its content changes. A file whose content changes while it is read counts as growing.

    Parameters
    ----------
    store : Store
    folder : path
    found : FolderDifference
        Of this folder against the store's manifest.
    read : callable
        Reads one file.
    work : Map
        Does the reading.

    Returns
    -------
    Store
        With the next sequence number if the table changed.
    report : DataFrame
        ``file, category, status, reason``: one row a file that is new, changed, removed, growing or still
        pending, and one an entry of the folder that is set aside or leads to what is taken already.
    """
    number = store.manifest.sequence + 1
    removed = set(found.removed)
    files = {name: entry for name, entry in store.manifest.files.items() if name not in removed}
    for name, look in found.touched.items():
        files[name] = replace(files[name], size=look.size, mtime_ns=look.mtime_ns, ctime_ns=look.ctime_ns)
    rows = [_row(name, REMOVED, "") for name in found.removed]
    rows += [_row(name, GROWING, "changed too lately; left for the next run") for name in found.growing]
    rows += [_row(name, ASIDE, reason) for name, reason in found.aside.items()]
    rows += [_row(name, AGAIN, f"a link to {other}") for name, other in found.again.items()]
    new = from_models(
        _models(Path(folder), {**found.added, **found.changed}, files, rows, number, read, work)
    )
    reported = {row["file"] for row in rows}
    rows += [_row(n, PENDING, e.reason) for n, e in files.items() if e.pending and n not in reported]
    report = pd.DataFrame(rows, columns=INGEST_COLUMNS, dtype="str").sort_values("file", ignore_index=True)
    gone = [name for name in found.removed if store.manifest.files[name].row_sha256]
    if not len(new) and not gone:
        return Store(replace(store.manifest, files=files), store.table), report
    table = merged(store.table, new, gone)
    return Store(replace(store.manifest, sequence=number, files=files), table), report


def merged(old: pd.DataFrame, new: pd.DataFrame, gone: list[str]) -> pd.DataFrame:
    """Rows of ``old`` that are neither replaced nor gone, and ``new``: as if all had been read at once."""
    kept = old[~old["file"].isin({*new["file"], *gone})]
    parts = [part for part in (kept, new) if len(part)]
    if not parts:
        return from_models([])
    if len(parts) == 1:
        table = parts[0].dropna(axis=1, how="all")
    else:
        table = pd.concat(parts, ignore_index=True).dropna(axis=1, how="all")
    order = from_models([]).columns.tolist()
    table = table.reindex(columns=_ordered([*table.columns, *order]))
    table["date"] = table["date"].fillna("").astype("str")  # a table of before there were dates has none
    table["tire_id"] = physical_tire_ids(table)
    return table.sort_values("file", ignore_index=True)


def _ordered(names: list[str]) -> list[str]:
    from tire_pipeline.tire_table.from_models import ALWAYS, KNOWN_COEFFICIENTS, TEXTS

    present = set(names)
    numbers = [name for name in KNOWN_COEFFICIENTS if name in present]
    return [*TEXTS, *numbers, *(name for name in ALWAYS if name not in numbers), "tire_id"]


def _models(
    folder: Path,
    wanted: Mapping[str, tuple[object, str]],
    files: dict[str, ManifestEntry],
    rows: list[dict[str, str]],
    number: int,
    read: Callable[[str | Path], TireModel],
    work: Map,
) -> Iterator[tuple[str, str, TireModel]]:
    tasks = {name: partial(_read, read, path_of(folder, name), wanted[name][1]) for name in wanted}
    for done in in_blocks(work, tasks, "reading new .tir files"):
        name = done.name
        look, digest = wanted[name]
        before = files.get(name)
        entry = ManifestEntry(
            digest,
            before.row_sha256 if before else "",
            look.size,  # type: ignore[attr-defined]
            look.mtime_ns,  # type: ignore[attr-defined]
            look.ctime_ns,  # type: ignore[attr-defined]
            before.sequence if before else number,
        )
        if isinstance(done.error, TirePipelineError | OSError):
            reason = printable(str(done.error))
            files[name] = replace(entry, reason=reason)
            stays = "; an earlier reading stays" if entry.row_sha256 else ""
            rows.append(_row(name, PENDING, f"{reason}{stays}"))
            continue
        tire = done.result()
        if tire is None:
            rows.append(_row(name, GROWING, "changed while it was read; left for the next run"))
            continue
        files[name] = replace(entry, row_sha256=digest, sequence=number)
        rows.append(_row(name, READ, ""))
        yield name, category_of(name), tire


def _read(read: Callable[[str | Path], TireModel], path: Path, digest: str) -> TireModel | None:
    """The model; nothing if the file changed while it was read."""
    tire = read(path)
    return tire if fingerprint(path) == digest else None


def category_of(name: str) -> str:
    """The first folder of a file's path."""
    return name.split("/", 1)[0] if "/" in name else ""


def _row(name: str, status: str, reason: str) -> dict[str, str]:
    return {"file": name, "category": category_of(name), "status": status, "reason": reason}
