"""JSON whose preview in kedro-viz shows every character of the users' names in it."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any, ClassVar

from kedro.io.core import get_filepath_str
from kedro_datasets._typing import JSONPreview
from kedro_datasets.json import JSONDataset

from tire_pipeline.datasets.storage.sealed_beside import SealedBesideDataset
from tire_pipeline.pages.visible_text import visible_texts


class JsonFileDataset(SealedBesideDataset[Any]):
    """What JSON can hold, with a preview for a person; a version's hash lies beside it.

    Parameters
    ----------
    filepath : str
        Local path or address of an object.
    version : kedro.io.Version, optional
        Given by the catalog when ``versioned: true``.
    save_args : dict, optional
        For ``json.dumps``.
    metadata : dict, optional
        For kedro-viz.

    Raises
    ------
    DomainError
        On loading: the file is not what was stored.
    """

    DEFAULT_SAVE_ARGS: ClassVar[dict[str, Any]] = {"indent": 2}

    def load(self) -> Any:
        """What was saved."""
        return json.loads(self._read_sealed())

    def save(self, data: Any) -> None:
        """Write it."""
        self._write_sealed(json.dumps(data, **self._save_args).encode())

    def preview(self) -> JSONPreview:
        """Return all of it, its keys and texts by :func:`visible`."""
        return JSONPreview(json.dumps(visible_texts(self.load())))


class JsonItemsDataset(JSONDataset):
    """A dictionary whose values are asked for one at a time when it is saved: for people, no run reads it."""

    DEFAULT_SAVE_ARGS: ClassVar[dict[str, Any]] = {"indent": 1}

    def save(self, data: Mapping[str, Any]) -> None:
        """Write each item in turn."""
        place = get_filepath_str(self._get_save_path(), self._protocol)
        with self._fs.open(place, **self._fs_open_args_save) as stream:
            for text in item_texts(data, self._save_args["indent"]):
                stream.write(text)
        self._invalidate_cache()


def item_texts(data: Mapping[str, Any], indent: int) -> Iterator[str]:
    """``json.dumps(data, indent=indent)``, an item at a time; no text of JSON has a line break within."""
    before, line = "{", "\n" + " " * indent
    for name, value in data.items():
        content = json.dumps(value, indent=indent).replace("\n", line)
        yield f"{before}{line}{json.dumps(name)}: {content}"
        before = ","
    yield "\n}" if before == "," else "{}"
