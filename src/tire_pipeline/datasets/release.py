"""Released models and the record that says which one is in use."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

from kedro.io.core import AbstractDataset

from tire_pipeline.atomic import write_bytes
from tire_pipeline.datasets._one_at_a_time import locked, refuse_other_revision
from tire_pipeline.errors import DomainError
from tire_pipeline.retraining.model import CategoryModel
from tire_pipeline.retraining.release import KEPT_MODELS, Release, Shelf
from tire_pipeline.state_files import pack_state, unpack_state

_NAME = re.compile(r"[0-9A-Za-z][0-9A-Za-z.\-]*").fullmatch


class ReleaseDataset(AbstractDataset[Shelf, Shelf]):
    """A folder with ``record.json`` and ``models/<name>.npz``.

    A model is written before the record names it; renaming the record is the single step that puts it in
    use. Loading gives the model in use.

    Parameters
    ----------
    path : str
        The folder.
    for_going_back : bool
        Load the record, and which of its models are unusable, instead of the model in use: that one may be
        what is gone.
    metadata : dict, optional
        For kedro-viz.

    Raises
    ------
    DomainError
        On loading: record or model are damaged. On saving: another run was faster.
    """

    def __init__(
        self, *, path: str, for_going_back: bool = False, metadata: dict[str, Any] | None = None
    ) -> None:
        self._path = path
        self._for_going_back = for_going_back
        self.metadata = metadata

    def load(self) -> Shelf:
        """The record and the model in use; an empty shelf if nothing was released."""
        release = self._record()
        if self._for_going_back:
            return Shelf(release, unusable=self._unusable(release))
        if release.current is None:
            return Shelf(release)
        return Shelf(release, self._load_model(release.current))

    def _load_model(self, name: str) -> CategoryModel:
        path = self._model(name)
        todo = "`kedro run --pipeline rollback` puts the last one back whose file is whole; or bring it back"
        try:
            state = unpack_state(path.read_bytes(), where=str(path))
        except FileNotFoundError as error:
            raise DomainError("the model in use is gone", where=str(path), todo=todo) from error
        except DomainError as error:
            what = f"{error.what} (the one in use); it is not loaded"
            raise DomainError(what, where=str(path), todo=todo) from error
        return CategoryModel.from_state(state)

    def _unusable(self, release: Release) -> dict[str, str]:
        found: dict[str, str] = {}
        for name in release.models:
            path = self._model(name)
            try:
                unpack_state(path.read_bytes(), where=str(path))
            except OSError as error:
                found[name] = f"gone ({path}: {error.strerror})"
            except DomainError:
                found[name] = f"damaged ({path})"
        return found

    def save(self, data: Shelf) -> None:
        """Store the model if it is new, then the record."""
        folder = Path(self._path)
        with locked(folder):
            present = self._record()
            if data.release == present:
                return
            refuse_other_revision(present.revision, data.release.revision - 1, folder)
            current = data.release.current
            if current is not None and current not in present.models:
                if data.model is None:
                    raise DomainError(f"there is no model for {current}", where=str(folder))
                self._model(current).parent.mkdir(parents=True, exist_ok=True)
                write_bytes(self._model(current), pack_state(data.model.to_state()))
            text = json.dumps(data.release.to_dict(), indent=1)
            write_bytes(folder / "record.json", text.encode())
            for old in sorted((folder / "models").glob("*.npz"))[:-KEPT_MODELS]:
                if old.stem not in data.release.models:
                    old.unlink(missing_ok=True)

    def _record(self) -> Release:
        path = Path(self._path) / "record.json"
        try:
            content = path.read_bytes()
        except FileNotFoundError:
            return Release()
        try:
            release = Release.from_dict(json.loads(content))
            if not all(_NAME(name) for name in release.models):
                raise ValueError("name")
        except (ValueError, KeyError, TypeError) as error:
            todo = "bring it back from a copy, or move the folder away to begin anew"
            raise DomainError(
                "the record of released models is damaged", where=str(path), todo=todo
            ) from error
        return release

    def _model(self, name: str) -> Path:
        return Path(self._path) / "models" / f"{name}.npz"

    def _exists(self) -> bool:
        return (Path(self._path) / "record.json").exists()

    def _describe(self) -> dict[str, Any]:
        return {"path": self._path}
