"""One trained thing's state within another's: ``to_state()`` of both in one flat mapping."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


def prefixed(prefix: str, state: Mapping[str, Any]) -> dict[str, Any]:
    """Put ``prefix.`` before every name, to hold one state within another."""
    return {f"{prefix}.{name}": value for name, value in state.items()}


def without_prefix(prefix: str, state: Mapping[str, Any]) -> dict[str, Any]:
    """Give the part of a state that :func:`prefixed` put into it."""
    start = f"{prefix}."
    return {name[len(start) :]: value for name, value in state.items() if name.startswith(start)}
