"""A folder of whatever, a second book on what lies in it, and a retraining by the pipeline's own nodes.

The book is kept by what was done to the folder, never by looking at it with the code under test.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import signal
import socket
import traceback
import warnings
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from unittest.mock import patch

import pandas as pd
from no_rights_of_root import rights
from retraining_files import put_fleet, tir_text

from tire_pipeline.classifiers.parameters import ForestParameters, TrainClassifierParameters
from tire_pipeline.datasets import IngestStoreDataset, ReleaseDataset
from tire_pipeline.files.atomic import check_before_replacing
from tire_pipeline.kedro_runs.run_errors import one_line
from tire_pipeline.pipelines.rollback.pipeline import restore_previous
from tire_pipeline.representations.encoded_tires import RepresentParameters
from tire_pipeline.representations.usable_tires import DedupeFilterParameters, keep_usable
from tire_pipeline.retraining import ModelRegistry, Store
from tire_pipeline.retraining import train_and_release as nodes
from tire_pipeline.retraining.scan import places
from tire_pipeline.runs import Ticket, take_back, take_turn
from tire_pipeline.tire_table.binned_features import BinParameters
from tire_pipeline.tire_table.one_nominal_load import NormalizeParameters, to_one_nominal_load

ORGANISATIONS = "ABD"
CLOSED, LISTED, ENTERED = 0, 0o444, 0o111
"""Rights that are left of a folder."""
PARAMETERS = nodes.RetrainParameters(
    settle_seconds=0.0, most_wait_seconds=0.0, most_removed_share=1.0, held_out_share=0.3
)
SHAPE = (
    NormalizeParameters(),
    RepresentParameters(),
    BinParameters(),
    TrainClassifierParameters(forest=ForestParameters(trees=3, depth=3)),
    1,
)


def sha(content: bytes) -> str:
    """What the manifest keeps of a file without a sidecar."""
    return hashlib.sha256(content + b"\0").hexdigest()


@dataclass
class Book:
    """What lies in the folder, by what was done to it.

    ``files``: path below the folder -> content and whether it is a tire file. ``outside``: the same of a
    folder elsewhere, reached by links only. ``rows``: path of each file that was taken -> hash of the content
    that was taken. ``unreadable``: files whose rights were taken away. ``closed``: folders
    whose rights were.
    """

    files: dict[str, tuple[bytes, bool]] = field(default_factory=dict)
    outside: dict[str, tuple[bytes, bool]] = field(default_factory=dict)
    folder_links: set[str] = field(default_factory=set)  # to the folder elsewhere
    file_links: dict[str, str] = field(default_factory=dict)  # link -> name in the folder elsewhere
    rows: dict[str, str] = field(default_factory=dict)
    unreadable: set[str] = field(default_factory=set)
    closed: dict[str, int] = field(default_factory=dict)  # and with which rights they are left

    def in_closed(self, name: str) -> bool:
        """Whether a file lies in a folder that cannot be entered."""
        return any(name.startswith(f"{folder}/") for folder in self.closed)

    def free(self) -> set[str]:
        """Files in folders that can be entered."""
        return {name for name in self.files if not self.in_closed(name)}

    def reached(self) -> dict[str, tuple[bytes, bool]]:
        """Each file once, whatever leads to it."""
        targets = set(self.outside) if self.folder_links else set(self.file_links.values())
        return {**self.files, **{f"outside/{n}": self.outside[n] for n in targets & set(self.outside)}}

    def rows_after_a_run(self, grows: str = "") -> dict[str, str]:
        """Good files as they are; others as they were when they were last taken.

        Others are bad, without permission, or (``grows``) change while they are read. What lay in a folder
        that cannot be listed now may still be there, so it stays.
        """
        unlisted = [f"{folder}/" for folder, mode in self.closed.items() if not mode & LISTED]
        rows = {name: row for name, row in self.rows.items() if name.startswith(tuple(unlisted))}
        for name, (content, good) in self.reached().items():
            if good and name not in self.unreadable and name != grows and not self.in_closed(name):
                rows[name] = sha(content)
            elif name in self.rows:
                rows[name] = self.rows[name]
        return rows


class ChangingData:
    """The folders, and what can be done to them."""

    def __init__(self, base: Path) -> None:
        self.base, self.tir, self.elsewhere = base, base / "01_raw/tir", base / "elsewhere"
        self.elsewhere.mkdir(parents=True)
        put_fleet(self.tir, range(6), ORGANISATIONS)
        found = {path: path.read_bytes() for path in self.tir.rglob("*.tir")}
        self.book = Book({str(p.relative_to(self.tir)): (text, True) for p, text in found.items()})
        self.serial = 0
        self.ingested = IngestStoreDataset(path=str(base / "02_intermediate/ingested"))
        self.released = ReleaseDataset(path=str(base / "06_models/released"))
        self.going_back = ReleaseDataset(path=str(base / "06_models/released"), for_going_back=True)

    # the folder

    def text(self, organisation: str) -> bytes:
        """A new tire file; no two have the same content."""
        self.serial += 1
        return tir_text(100 + self.serial, organisation).encode() + b"! %d\n" % self.serial

    def name(self, kind: str) -> str:
        """A name that is new."""
        self.serial += 1
        raw = {
            "plain": b"n%d.tir",
            "latin": b"\xfc%d.TIR",
            "control": b"\n\x1b%d.tir",
            "escape": b"\\xfc%d.tir",
        }
        if kind == "long":
            return f"{self.serial}".rjust(251, "y") + ".tir"
        return os.fsdecode(raw[kind] % self.serial)

    def write(self, name: str, content: bytes, *, good: bool, date: float | None, elsewhere: bool) -> None:
        path = (self.elsewhere if elsewhere else self.tir) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if not elsewhere and name in self.book.unreadable:
            self.let_read(name)
        path.write_bytes(content)
        if date is not None:
            os.utime(path, (date, date))
        (self.book.outside if elsewhere else self.book.files)[name] = (content, good)

    def rename(self, old: str, new: str) -> None:
        (self.tir / new).parent.mkdir(parents=True, exist_ok=True)
        (self.tir / old).rename(self.tir / new)
        self.book.files[new] = self.book.files.pop(old)
        if old in self.book.unreadable:
            self.book.unreadable.remove(old)
            self.book.unreadable.add(new)

    def remove(self, name: str, *, elsewhere: bool) -> None:
        ((self.elsewhere if elsewhere else self.tir) / name).unlink()
        del (self.book.outside if elsewhere else self.book.files)[name]
        if not elsewhere:
            self.book.unreadable.discard(name)

    def no_regular_file(self, name: str, kind: str) -> None:
        """Put a FIFO, a socket or a device in the place of a file."""
        self.remove(name, elsewhere=False)
        path = self.tir / name
        if kind == "fifo":
            os.mkfifo(path)
        elif kind == "socket":
            with socket.socket(socket.AF_UNIX) as server, contextlib.chdir(path.parent):
                server.bind("s")  # the path of a socket must be short
                os.rename("s", path.name)
        else:
            path.symlink_to("/dev/zero")

    def take_rights(self, name: str) -> None:
        """Nobody may read a file."""
        (self.tir / name).chmod(0)
        self.book.unreadable.add(name)

    def let_read(self, name: str) -> None:
        """Everybody may read a file again."""
        (self.tir / name).chmod(0o644)
        self.book.unreadable.remove(name)

    def close(self, folder: str, mode: int) -> None:
        """Leave nobody more rights to a folder than these."""
        (self.tir / folder).chmod(mode)
        self.book.closed[folder] = mode

    def reopen(self, folder: str) -> None:
        """Everybody may list and enter a folder again."""
        (self.tir / folder).chmod(0o755)
        del self.book.closed[folder]

    def link(self, name: str, target: Path | str) -> None:
        (self.tir / name).parent.mkdir(parents=True, exist_ok=True)
        (self.tir / name).symlink_to(target)

    # the runs

    def retrain(self, version: str) -> None:
        """By the pipeline's own nodes in their order, each result stored where Kedro would store it.

        Where the tests have the rights of root, the run has not: to root no file is without permission.
        """
        with rights(of_root=False):
            self._retrain(version)

    def retrain_while_a_file_grows(self, version: str, name: str, *, before: bool) -> None:
        """Retrain; a file grows when it is hashed: just before, or after it and again when it was read."""
        path, more = self.tir / name, b"! one more line\n"
        usual = places.fingerprint

        def hashing(each: str | Path) -> str:
            if str(each) != str(path):
                return usual(each)
            if before and more not in self.book.files[name][0]:
                self._grow(name, more)
            found = usual(each)
            if not before:
                self._grow(name, more)
            return found

        with patch.object(places, "fingerprint", hashing):
            self.retrain(version)

    def _grow(self, name: str, more: bytes) -> None:
        with rights(of_root=True), (self.tir / name).open("ab") as file:
            file.write(more)
        content, good = self.book.files[name]
        self.book.files[name] = (content + more, good)

    def _retrain(self, version: str) -> None:
        place = f"07_model_output/outcome.txt/{version}"
        ticket = Ticket.draw(self.base / ".runs", run=version, places=[place])
        stop = check_before_replacing(ticket.check, owner=ticket.note.name)
        try:
            take_turn(ticket)
            for store, report in nodes.read_new_files(self.ingested.load(), self.tir, PARAMETERS):  # noqa: B007
                self.ingested.save(store)
            table = nodes.stored_table(self.ingested.load())
            (self.base / place).mkdir(parents=True)
            pd.concat(list(report)).to_csv(self.base / place / "files.csv")
            kept, _ = keep_usable(
                table, DedupeFilterParameters(minimum_per_category=1), RepresentParameters(), "D"
            )
            normalized = to_one_nominal_load(kept, SHAPE[0])
            training, held = nodes.hold_out(normalized, kept, PARAMETERS)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", UserWarning)  # few tires for the bins
                candidate = nodes.train_candidate(training, *SHAPE)
            registry = self.released.load()
            comparison = nodes.compare(candidate, registry, held, PARAMETERS)
            registry, _ = nodes.decide(candidate, registry, comparison, store, PARAMETERS, *SHAPE)
            self.released.save(registry)
        except BaseException:
            take_back(self.base, ticket.note)
            raise
        finally:
            stop()
            ticket.end()

    def retrain_and_be_killed(self, version: str, step: int) -> bool:
        """Retrain in a process that is killed at its step-th renaming; whether it came that far."""
        child = os.fork()
        if child == 0:
            try:
                _kill_at(step)
                self.retrain(version)
                os._exit(0)
            except BaseException as error:
                if isinstance(error, Exception) and one_line(error):  # nothing to train on, no model...
                    os._exit(0)
                traceback.print_exc()
            os._exit(1)
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        assert code in (0, -signal.SIGKILL), "the run ended in a traceback"
        return code != 0

    def roll_back(self) -> None:
        self.released.save(restore_previous(self.going_back.load()))

    # the books against each other

    def stored(self) -> Store:
        store = self.ingested.load()
        assert store.table["file"].is_unique
        taken = {name for name, entry in store.manifest.files.items() if entry.row_sha256}
        assert set(store.table["file"]) == taken
        return store

    def agrees(self, rows: dict[str, str]) -> bool:
        """Whether each file is in the store once, with its content."""
        files = self.stored().manifest.files.values()
        return Counter(e.row_sha256 for e in files if e.row_sha256) == Counter(rows.values())

    def model_file(self, name: str) -> Path:
        """Where a released model lies."""
        return self.base / "06_models/released/models" / f"{name}.npz"

    def registry(self) -> ModelRegistry:
        return self.going_back.load()


def _kill_at(step: int) -> None:
    left = step

    def killing(call):
        def instead(*arguments, **more):
            nonlocal left
            if left == 0:
                os.kill(os.getpid(), signal.SIGKILL)
            left -= 1
            return call(*arguments, **more)

        return instead

    os.replace, os.rename, os.mkdir = killing(os.replace), killing(os.rename), killing(os.mkdir)
