"""Trained models as plain numbers: NPZ with a JSON part and a checksum, never pickle."""

from __future__ import annotations

import hashlib
import io
import json
import zipfile
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np
from kedro.io.core import AbstractVersionedDataset, Version

from tire_pipeline.atomic import replaced_file
from tire_pipeline.errors import DomainError

_PLAIN = "plain.json"
_SUM = "sha256"


class StateDataset(AbstractVersionedDataset[dict[str, Any], dict[str, Any]]):
    """Saves ``{name: array, number, text, list or dict}`` and refuses to load what was tampered with.

    Arrays go into ``.npy`` members (``allow_pickle=False``), everything else into one JSON member,
    and a SHA-256 over all of it into a third.

    Parameters
    ----------
    filepath : str
        Local path.
    version : kedro.io.Version, optional
        Given by the catalog when ``versioned: true``.
    metadata : dict, optional
        For kedro-viz.

    Raises
    ------
    DomainError
        On loading a file that is damaged or was changed.
    """

    def __init__(
        self,
        *,
        filepath: str,
        version: Version | None = None,
        metadata: dict[str, Any] | None = None,
    ) -> None:
        super().__init__(PurePosixPath(filepath), version)
        self._protocol = "file"
        self.metadata = metadata

    def save(self, data: dict[str, Any]) -> None:
        """Write the state in one step."""
        path = Path(self._get_save_path())
        with replaced_file(path) as temporary:
            temporary.write_bytes(pack_state(data))

    def load(self) -> dict[str, Any]:
        """Read the state back, arrays and all."""
        path = Path(self._get_load_path())
        return unpack_state(path.read_bytes(), where=str(path))

    def _describe(self) -> dict[str, Any]:
        return {"filepath": self._filepath, "version": self._version}


def pack_state(state: dict[str, Any]) -> bytes:
    """A state as the bytes of a ZIP file."""
    members: dict[str, bytes] = {}
    plain: dict[str, Any] = {}
    _split(state, "", members, plain)
    members[_PLAIN] = json.dumps(plain, sort_keys=True).encode()
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in sorted(members):
            archive.writestr(name, members[name])
        archive.writestr(_SUM, _checksum(members))
    return buffer.getvalue()


def unpack_state(content: bytes, where: str = "model state") -> dict[str, Any]:
    """The state that :func:`pack_state` made; anything else is an error."""
    todo = "train it again; this file is not loaded"
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            members = {name: archive.read(name) for name in archive.namelist()}
        expected = members.pop(_SUM).decode()
        if _checksum(members) != expected:
            raise DomainError("the model's checksum is wrong", where=where, todo=todo)
        state: dict[str, Any] = json.loads(members.pop(_PLAIN))
        for name, data in members.items():
            *groups, last = name.removesuffix(".npy").split("/")
            target = state
            for group in groups:
                target = target.setdefault(group, {})
            target[last] = np.load(io.BytesIO(data), allow_pickle=False)
    except (zipfile.BadZipFile, KeyError, ValueError, OSError, EOFError) as error:
        if isinstance(error, DomainError):
            raise
        raise DomainError("the model file is damaged", where=where, todo=todo) from error
    return state


def _split(state: dict[str, Any], prefix: str, members: dict[str, bytes], plain: dict[str, Any]) -> None:
    for key, value in state.items():
        if "/" in key:
            raise DomainError(f"a state's key may not hold '/': {key!r}")
        if isinstance(value, np.ndarray):
            if value.dtype.hasobject:
                raise DomainError(f"the state's entry {prefix}{key} is not plain numbers or text")
            buffer = io.BytesIO()
            np.save(buffer, value, allow_pickle=False)
            members[f"{prefix}{key}.npy"] = buffer.getvalue()
        elif isinstance(value, dict):
            plain[key] = {}
            _split(value, f"{prefix}{key}/", members, plain[key])
        else:
            plain[key] = value.item() if isinstance(value, np.generic) else value


def _checksum(members: dict[str, bytes]) -> str:
    total = hashlib.sha256()
    for name in sorted(members):
        total.update(name.encode() + b"\0" + hashlib.sha256(members[name]).digest())
    return total.hexdigest()
