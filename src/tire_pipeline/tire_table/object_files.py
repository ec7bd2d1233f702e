"""A ``.tir`` file in an object store, with its sidecar."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path

from tire_pipeline.errors import TirError
from tire_pipeline.files.objects import Objects
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.tir import read_sidecar, read_tir
from tire_pipeline.tir.sidecar import MOST_SIDECAR_BYTES, SUFFIX
from tire_pipeline.tir.text.decode import MOST_FILE_BYTES

MOST_BYTES = MOST_FILE_BYTES + 1
"""So much is read of an object: enough to tell that it is too large."""


def read_object(folder: Objects, name: str, *, sidecar: bool) -> TireModel:
    """Read a ``.tir`` object.

    Parameters
    ----------
    folder : Objects
    name : str
        The object's own name, not an escaped one.
    sidecar : bool
        Whether ``<name>.sidecar.json`` is there, too.

    Raises
    ------
    TirError
        The content is no tire property file.
    """
    beside = folder.read(name + SUFFIX, MOST_SIDECAR_BYTES + 1) if sidecar else None
    return model_of(folder.read(name, MOST_BYTES), beside, f"{folder}/{name}")


def model_of(content: bytes, sidecar: bytes | None, address: str) -> TireModel:
    """The model of a file's content and of its sidecar's; ``address`` is what messages call it."""
    model = read_tir(content, path=address)
    if sidecar is None:
        return model
    with tempfile.TemporaryDirectory() as copy:
        place = Path(copy) / "tire.tir"
        Path(f"{place}{SUFFIX}").write_bytes(sidecar)
        try:
            corrections = read_sidecar(place)
        except TirError as error:
            error.where = (error.where or "").replace(str(place), address)
            raise
    return replace(model, metadata={**model.metadata, "sidecar": corrections})
