"""Released models and the record that says which one is in use."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

from kedro.io.core import AbstractDataset

from tire_pipeline.atomic import write_bytes
from tire_pipeline.datasets._one_at_a_time import locked, refuse_other_revision
from tire_pipeline.datasets.state import pack_state, unpack_state
from tire_pipeline.errors import DomainError
from tire_pipeline.retraining.model import CategoryModel
from tire_pipeline.retraining.release import KEPT_MODELS, Release, Shelf

_NAME = re.compile(r"[0-9A-Za-z][0-9A-Za-z.\-]*").fullmatch


class ReleaseDataset(AbstractDataset[Shelf, Shelf]):
    """A folder with ``record.json`` and ``models/<name>.npz``.

    A model is written before the record names it; renaming the record is the single step that puts it in
    use. Loading gives the model in use.

    Parameters
    ----------
    path : str
        The folder.
    metadata : dict, optional
        For kedro-viz.

    Raises
    ------
    DomainError
        On loading: record or model are damaged. On saving: another run was faster.
    """

    def __init__(self, *, path: str, metadata: dict[str, Any] | None = None) -> None:
        self._path = path
        self.metadata = metadata

    def load(self) -> Shelf:
        """The record and the model in use; an empty shelf if nothing was released."""
        release = self._record()
        if release.current is None:
            return Shelf(release)
        path = self._model(release.current)
        try:
            content = path.read_bytes()
        except FileNotFoundError as error:
            raise DomainError(
                "the model in use is gone", where=str(path), todo="roll back, or bring the file back"
            ) from error
        return Shelf(release, CategoryModel.from_state(unpack_state(content, where=str(path))))

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
