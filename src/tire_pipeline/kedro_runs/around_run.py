"""What happens around a run: half-written results go, and the user is told where to look."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Generator
from pathlib import Path
from typing import Any

from kedro.framework.hooks import hook_impl
from pydantic import Field, ValidationError

from tire_pipeline.datasets.text_files.text_folder import TextFolderDataset
from tire_pipeline.errors import DomainError
from tire_pipeline.files.atomic import check_before_replacing
from tire_pipeline.files.objects import Objects
from tire_pipeline.kedro_runs.data_place import data_place
from tire_pipeline.kedro_runs.newest_tables import plain_name, tables_place
from tire_pipeline.kedro_runs.run_version import settle_version, versioned_datasets
from tire_pipeline.pages.visible_text import visible
from tire_pipeline.parameters import Parameters
from tire_pipeline.runs import (
    ObjectTicket,
    OtherRunsOnObjects,
    Ticket,
    take_back,
    take_back_objects,
    take_turn,
)
from tire_pipeline.runs.ticket import BEAT_SECONDS
from tire_pipeline.runs.turn import EXPIRY_SECONDS


class TurnParameters(Parameters):
    """Parameters of ``one_run_at_a_time``.

    Attributes
    ----------
    wait_seconds : float
        How long a run waits for another one on the same data folder before it says who that is and stops.
    expiry_seconds : float
        After how long without a sign of life a run on another machine counts as dead.
    alongside : bool
        Run beside others. For runs that write different things.
    """

    wait_seconds: float = Field(0.0, ge=0.0)
    expiry_seconds: float = Field(EXPIRY_SECONDS, gt=0.0)
    alongside: bool = False


def _versions(catalog: Any, pipeline: Any, version: str, protocol: str) -> list[Path]:
    """Folders into which this run writes versioned results, of one kind of file system."""
    found = versioned_datasets(catalog, pipeline.all_inputs() | pipeline.all_outputs())
    own = [each for each in found if getattr(each, "_protocol", "file") == protocol]
    return [Path(str(each._filepath)) / version for each in own]


class OneRunHooks:
    """One run at a time on a data folder, and nothing left of a run that fails or is killed.

    A run draws a ticket in ``<data>/.runs`` (:mod:`tire_pipeline.runs`), waits for its turn, and deletes
    what killed runs left before it reads anything. It checks its ticket around every result: a run that
    another has declared dead writes nothing more. A run that fails deletes its own versions.
    """

    def __init__(self) -> None:
        self._ticket: Ticket | ObjectTicket | None = None
        self._stop_checking: Callable[[], None] = lambda: None

    @hook_impl
    def after_context_created(self, context: Any) -> None:
        """Remember where the data lies and how long to wait."""
        self._data = data_place(context)
        parameters = context.config_loader["parameters"]
        chosen = dict(parameters.get("one_run_at_a_time") or {})
        try:
            self._turn = TurnParameters.model_validate(chosen)
        except ValidationError as error:
            raise DomainError(
                str(error), where="one_run_at_a_time", todo="correct it in conf/base/parameters or --params"
            ) from error

    @hook_impl(wrapper=True)
    def before_pipeline_run(
        self, run_params: dict[str, Any], pipeline: Any, catalog: Any
    ) -> Generator[None, Any, Any]:
        """Take this run's turn before any other hook reads or writes."""
        self._end()  # of a run in this process that was interrupted
        version = settle_version(catalog, pipeline, run_params["run_id"])
        self._ticket, others = self._drawn(catalog, pipeline, version)
        try:
            take_turn(
                self._ticket,
                others=others,
                wait_seconds=self._turn.wait_seconds,
                expiry_seconds=self._turn.expiry_seconds,
            )
            if settle_version(catalog, pipeline, version) != version:
                raise DomainError(
                    "the run that this one waited for has a clock that is ahead", todo="run again"
                )
            self._stop_checking = check_before_replacing(self._ticket.check, owner=self._ticket.note.name)
            return (yield)
        except BaseException:
            self._end()
            raise

    def _drawn(
        self, catalog: Any, pipeline: Any, version: str
    ) -> tuple[Ticket | ObjectTicket, OtherRunsOnObjects | None]:
        """A ticket on the data folder, and how the others there are watched."""
        common: dict[str, Any] = {"run": version, "alongside": self._turn.alongside}
        if isinstance(self._data, Objects):
            protocol = self._data.address.partition("://")[0]
            found = _versions(catalog, pipeline, version, protocol)
            root = Path(self._data.root)
            places = [str(each.relative_to(root)) for each in found if each.is_relative_to(root)]
            beat = min(BEAT_SECONDS, self._turn.expiry_seconds / 6.0)
            ticket = ObjectTicket.draw(self._data, places=places, beat_seconds=beat, **common)
            return ticket, OtherRunsOnObjects(ticket, self._turn.expiry_seconds)
        data = self._data
        local = [_relative(each, data) for each in _versions(catalog, pipeline, version, "file")]
        return Ticket.draw(data / ".runs", places=local, **common), None

    @hook_impl
    def before_dataset_saved(self) -> None:
        """Stop a run that has lost its ticket before it writes."""
        if self._ticket is not None:
            self._ticket.check()

    @hook_impl
    def after_dataset_saved(self) -> None:
        """Find out, too, if the ticket was lost during a long write; the error takes it back."""
        if self._ticket is not None:
            self._ticket.check()

    @hook_impl(wrapper=True)
    def after_pipeline_run(self) -> Generator[None, Any, Any]:
        """The run ended well, and so did all other hooks: its results may be trusted."""
        try:
            return (yield)
        finally:
            if self._ticket is not None:
                self._stop_checking()
                self._ticket.end()
                self._ticket = None

    @hook_impl
    def on_pipeline_error(self) -> None:
        """The run failed: what it wrote goes, so that no later run trusts it."""
        self._end()

    def _end(self) -> None:
        """Delete what the run wrote, and return its ticket."""
        self._stop_checking()
        if self._ticket is not None:
            if isinstance(self._data, Objects):
                take_back_objects(self._data, self._ticket.note)
            else:
                take_back(self._data, self._ticket.note)
            self._ticket.end()
            self._ticket = None


def _relative(folder: Path, data: Path) -> str:
    """Relative to the data folder, which another container may see under another path."""
    folder, data = Path(os.path.abspath(folder)), Path(os.path.abspath(data))
    return str(folder.relative_to(data) if folder.is_relative_to(data) else folder)


class FolderHooks:
    """Names the node in every error, and checks that the data folder can be written before work begins."""

    @hook_impl
    def after_context_created(self, context: Any) -> None:
        """Make the data folder if need be; say so plainly if that is not possible."""
        data = data_place(context)
        if isinstance(data, Objects):
            data.names(".runs")  # says now, in one line, if the bucket cannot be reached
            return
        try:
            data.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise DomainError(
                f"the data folder cannot be made ({error.strerror})",
                where=str(data),
                todo="make it writable, or set `data` in conf/local/globals.yml",
            ) from error

    @hook_impl
    def before_pipeline_run(self, pipeline: Any, catalog: Any) -> None:
        """Refuse to write into folders of the user before anything is written at all."""
        for name in sorted(pipeline.all_outputs()):
            dataset = catalog.get(name) if name in catalog else None
            if isinstance(dataset, TextFolderDataset):
                dataset.check()

    @hook_impl
    def on_node_error(self, error: Exception, node: Any) -> None:
        """Add the node's name to what the user reads."""
        error.add_note(f"node '{node.name}' failed")


def _read(summary: dict[str, Any]) -> str:
    """How many files were read.

    Examples
    --------
    >>> _read({"files": 1600, "read": 1599, "set_aside": 1})
    '1,599 of 1,600 files were read; the ingest report says why 1 was not.'
    """
    aside = summary["set_aside"]
    why = f"; the ingest report says why {aside:,} {'was' if aside == 1 else 'were'} not" if aside else ""
    return f"{summary['read']:,} of {summary['files']:,} files were read{why}."


def _duration(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"


class OutcomeHooks:
    """After a run, says what was done, how long it took, and where its results are."""

    OUTCOMES = ("evaluation_outcome", "translation_outcome", "mismatch_outcome")
    PAGES = ("retraining_report", "proof_report", "translation_page", "thesis_page")
    """Pages whose main message is the outcome of the run that makes them."""
    RESULTS = (
        ("evaluation_report", "report"),
        ("translation_list", "page of the translated files"),
        ("translated_tir", "translated evaluation files"),
        ("translation_files", "translated .tir files"),
        ("mismatch_overview_page", "page of the recordings"),
        ("proof_report", "page of the proof"),
        ("retraining_report", "page of the retraining"),
        ("translation_page", "page of the translators"),
        ("ingest_report", "ingest report"),
        ("filter_report", "which files are not used, and why"),
        ("fleet_files", "demonstration fleet"),
        ("thesis_page", "page of the thesis"),
    )

    @hook_impl
    def after_context_created(self, context: Any) -> None:
        """Remember where the tables lie as plain files: in the catalog a versioned one is a folder."""
        place = tables_place(context)
        self._tables = place.address if isinstance(place, Objects) else place

    @hook_impl
    def before_pipeline_run(self) -> None:
        """Remember when the run began."""
        self._began = time.monotonic()

    @hook_impl(trylast=True)
    def after_pipeline_run(self, pipeline: Any, catalog: Any) -> None:
        """Print what came out in sentences, and the places of those results that this run made."""
        from tire_pipeline.reporting.front import main_message  # slow to import

        made = pipeline.all_outputs()
        print(f"done in {_duration(time.monotonic() - self._began)}")
        for name in self.OUTCOMES:
            if name in made:
                print(*map(visible, catalog.load(name)), sep="\n")
        for name in self.PAGES:
            if name in made:
                print(*map(visible, main_message(catalog.load(name))), sep="\n")
        if "ingest_summary" in made:
            print(_read(catalog.load("ingest_summary")))
        for name, what in self.RESULTS:
            if name in made:
                dataset = catalog.get(name)
                if isinstance(dataset, TextFolderDataset) and dataset.empty:
                    print(f"{what}: none")
                    continue
                place = str(getattr(dataset, "_filepath", None) or getattr(dataset, "_path", None))
                protocol = getattr(dataset, "_protocol", "file")
                if plain := plain_name(dataset):
                    place, protocol = f"{self._tables}/{plain}", "file"
                print(f"{what}: {place if protocol == 'file' or '://' in place else f'{protocol}://{place}'}")
