"""Trained things on disk: numbers in a safetensors file, the rest in JSON beside it; no pickle."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from tire_pipeline.errors import DomainError

_TEXTS = "__texts__"


def write_state(path: str | Path, state: Mapping[str, Any]) -> None:
    """Write what a ``to_state()`` gave as ``<path>.safetensors`` and ``<path>.json``.

    Parameters
    ----------
    path : path
        Without suffix; its folder is made.
    state : mapping
        Name -> array of numbers, bools or texts, str, number, bool or None.
    """
    from safetensors.numpy import save_file

    base = Path(path)
    base.parent.mkdir(parents=True, exist_ok=True)
    arrays, rest = split_state(state)
    temporary = base.with_name(f"{base.name}.safetensors.part")
    save_file(arrays, temporary)
    temporary.replace(base.with_name(f"{base.name}.safetensors"))
    text = base.with_name(f"{base.name}.json.part")
    text.write_text(json.dumps(rest, indent=1, sort_keys=True), encoding="utf-8")
    text.replace(base.with_name(f"{base.name}.json"))


def read_state(path: str | Path) -> dict[str, Any]:
    """Read what :func:`write_state` wrote.

    Raises
    ------
    DomainError
        If one of the two files is missing.
    """
    from safetensors.numpy import load_file

    base = Path(path)
    numbers = base.with_name(f"{base.name}.safetensors")
    text = base.with_name(f"{base.name}.json")
    for file in (numbers, text):
        if not file.is_file():
            raise DomainError("a stored model is incomplete", where=str(file), todo="train it anew")
    return join_state(load_file(numbers), json.loads(text.read_text(encoding="utf-8")))


def split_state(state: Mapping[str, Any]) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """Give the arrays of numbers, and the rest in a form that JSON can hold."""
    arrays: dict[str, np.ndarray] = {}
    rest: dict[str, Any] = {}
    for name, value in state.items():
        if isinstance(value, np.ndarray) and value.dtype.kind in "US":
            rest[name] = {_TEXTS: value.tolist()}
        elif isinstance(value, np.ndarray):
            arrays[name] = np.ascontiguousarray(value)
        else:
            rest[name] = value.item() if isinstance(value, np.generic) else value
    return arrays, rest


def join_state(arrays: Mapping[str, np.ndarray], rest: Mapping[str, Any]) -> dict[str, Any]:
    """Undo :func:`split_state`."""
    texts = {
        name: np.array(value[_TEXTS], dtype=str) if isinstance(value, dict) and _TEXTS in value else value
        for name, value in rest.items()
    }
    return {**arrays, **texts}


def prefixed(prefix: str, state: Mapping[str, Any]) -> dict[str, Any]:
    """Put ``prefix.`` before every name, to hold one state within another."""
    return {f"{prefix}.{name}": value for name, value in state.items()}


def without_prefix(prefix: str, state: Mapping[str, Any]) -> dict[str, Any]:
    """Give the part of a state that :func:`prefixed` put into it."""
    start = f"{prefix}."
    return {name[len(start) :]: value for name, value in state.items() if name.startswith(start)}
