"""Trained models as plain numbers: one state within another, and a state as a file (NPZ, never pickle)."""

from __future__ import annotations

import hashlib
import io
import json
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from tire_pipeline.errors import DomainError
from tire_pipeline.files.packed import names_in, pack, unpack

_PLAIN_MEMBER = "plain.json"
_SUM = "sha256"
_ZIP_BEGINS = b"PK"


def prefixed(prefix: str, state: Mapping[str, Any]) -> dict[str, Any]:
    """Put ``prefix.`` before every name, to hold one state within another."""
    return {f"{prefix}.{name}": value for name, value in state.items()}


def without_prefix(prefix: str, state: Mapping[str, Any]) -> dict[str, Any]:
    """Return the part of a state that :func:`prefixed` put into it."""
    start = f"{prefix}."
    return {name[len(start) :]: value for name, value in state.items() if name.startswith(start)}


def layers_to_state(layers: Iterable[tuple[np.ndarray, np.ndarray]]) -> dict[str, Any]:
    """Return weight and bias of a network's layers by numbered names."""
    state = {}
    for index, (weight, bias) in enumerate(layers):
        state[f"weight_{index}"] = weight
        state[f"bias_{index}"] = bias
    return state


def layers_from_state(state: Mapping[str, Any]) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return the layers that :func:`layers_to_state` put into a state, whatever else is in it."""
    n_layers = sum(name.startswith("weight_") for name in state)
    return [(np.asarray(state[f"weight_{i}"]), np.asarray(state[f"bias_{i}"])) for i in range(n_layers)]


def pack_state(state: dict[str, Any]) -> bytes:
    """A state as the bytes of a ZIP file; the same state gives the same bytes."""
    members = _members(state)
    return pack({**{name: members[name] for name in sorted(members)}, _SUM: _checksum(members).encode()})


def is_state(content: bytes) -> bool:
    """Whether a file was made by :func:`pack_state`, be it whole or damaged: a ZIP that names its hash.

    The list of names is at the end of a ZIP: of one that is cut off only its beginning can be judged.
    """
    try:
        return _SUM in names_in(content)
    except DomainError:
        return content.startswith(_ZIP_BEGINS)


def state_digest(state: dict[str, Any]) -> str:
    """A hash of a state's content."""
    return _checksum(_members(state))


def unpack_state(content: bytes, where: str = "model state") -> dict[str, Any]:
    """The state that :func:`pack_state` made; anything else is an error."""
    todo = "train it again; this file is not loaded"
    try:
        members = unpack(content)
        expected = members.pop(_SUM).decode()
        right = _checksum(members) == expected
        state = _joined(members) if right else {}
    except (KeyError, ValueError) as error:
        raise DomainError("the model file is damaged", where=where, todo=todo) from error
    if not right:
        raise DomainError("the model's checksum is wrong", where=where, todo=todo)
    return state


def _joined(members: dict[str, bytes]) -> dict[str, Any]:
    state: dict[str, Any] = json.loads(members.pop(_PLAIN_MEMBER))
    for name, data in members.items():
        *groups, last = name.removesuffix(".npy").split("/")
        target = state
        for group in groups:
            target = target.setdefault(group, {})
        target[last] = np.load(io.BytesIO(data), allow_pickle=False)
    return state


def _members(state: dict[str, Any]) -> dict[str, bytes]:
    members: dict[str, bytes] = {}
    plain: dict[str, Any] = {}
    _split(state, "", members, plain)
    return {**members, _PLAIN_MEMBER: json.dumps(plain, sort_keys=True).encode()}


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
