"""Released models and the record that says which one is in use."""

from __future__ import annotations

import json
import re
from typing import Any

from tire_pipeline.datasets.storage.at_path import DatasetAtPath
from tire_pipeline.datasets.storage.files_at import files_at
from tire_pipeline.datasets.storage.one_at_a_time import held, refuse_other_revision, replace_unless_changed
from tire_pipeline.errors import DomainError
from tire_pipeline.files.objects import UnreachableError
from tire_pipeline.files.state_files import pack_state, unpack_state
from tire_pipeline.retraining.release.model import CategoryModel
from tire_pipeline.retraining.release.record import (
    KEPT_MODELS,
    TO_GO_BACK,
    WITHOUT_ANY_MODEL,
    ModelRegistry,
    Release,
)

_RECORD = "record.json"
_MODEL_NAME = re.compile(r"[0-9A-Za-z][0-9A-Za-z.\-]*").fullmatch


class ReleaseDataset(DatasetAtPath[ModelRegistry, ModelRegistry]):
    """A folder with ``record.json`` and ``models/<name>.npz``.

    A model is written before the record names it; renaming the record is the single step that puts it in
    use. In an object store the record is replaced only if it is still the one that was read. Loading gives
    the model in use.

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
        super().__init__(path=path, metadata=metadata)
        self._files = files_at(path)
        self._for_going_back = for_going_back

    def load(self) -> ModelRegistry:
        """The record and the model in use; an empty registry if nothing was released."""
        release, _ = self._record()
        if self._for_going_back:
            return ModelRegistry(release, unusable=self._unusable(release))
        if release.current is None:
            return ModelRegistry(release)
        return ModelRegistry(release, self._load_model(release.current, release))

    def _load_model(self, name: str, release: Release) -> CategoryModel:
        path = f"{self._path}/{_model(name)}"
        try:
            state = unpack_state(self._files.read(_model(name)), where=path)
        except FileNotFoundError as error:
            todo = self._what_is_left_to_do(release)
            raise DomainError("the file of the model in use is missing", where=path, todo=todo) from error
        except UnreachableError:  # that says nothing about the model: going back is no help
            raise
        except DomainError as error:
            what = f"{error.what} (the one in use); it is not loaded"
            raise DomainError(what, where=path, todo=self._what_is_left_to_do(release)) from error
        return CategoryModel.from_state(state)

    def _what_is_left_to_do(self, release: Release) -> str:
        """Recommend ``rollback`` only if a model is left to go back to."""
        unusable = self._unusable(release)
        if all(name in unusable for name in release.models):
            return WITHOUT_ANY_MODEL
        return TO_GO_BACK

    def _unusable(self, release: Release) -> dict[str, str]:
        found: dict[str, str] = {}
        for name in release.models:
            path = f"{self._path}/{_model(name)}"
            try:
                unpack_state(self._files.read(_model(name)), where=path)
            except OSError as error:
                found[name] = f"gone ({path}: {error.strerror})"
            except UnreachableError:
                raise
            except DomainError:
                found[name] = f"damaged ({path})"
        return found

    def save(self, data: ModelRegistry) -> None:
        """Store the model if it is new, then the record."""
        folder = self._files
        with held(folder):
            present, stamp = self._record()
            if data.release == present:
                return
            refuse_other_revision(present.revision, data.release.revision - 1, self._path)
            current = data.release.current
            if current is not None and current not in present.models:
                if data.model is None:
                    raise DomainError(f"there is no model for {current}", where=self._path)
                folder.write(_model(current), pack_state(data.model.to_state()))
            content = json.dumps(data.release.to_dict(), indent=1).encode()
            replace_unless_changed(folder, _RECORD, content, stamp)
            models = [name for name in folder.names() if name.startswith("models/") and name.endswith(".npz")]
            kept = {_model(name) for name in data.release.models}
            folder.delete(name for name in models[:-KEPT_MODELS] if name not in kept)

    def _record(self) -> tuple[Release, str | None]:
        path = f"{self._path}/{_RECORD}"
        try:
            content, stamp = self._files.read_stamped(_RECORD)
        except FileNotFoundError:
            return Release(), None
        try:
            release = Release.from_dict(json.loads(content))
            if not all(_MODEL_NAME(name) for name in release.models):
                raise ValueError("name")
        except (ValueError, KeyError, TypeError) as error:
            todo = "restore it from a backup, or move the folder away to start again"
            raise DomainError("the record of released models is damaged", where=path, todo=todo) from error
        return release, stamp

    def _exists(self) -> bool:
        return self._files.exists(_RECORD)


def _model(name: str) -> str:
    return f"models/{name}.npz"
