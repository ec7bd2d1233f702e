"""The catalogue: one effect a file. Adding an effect is adding a file with one subclass of ``Effect``."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache

from tire_pipeline.mismatch.effects.base import Effect, Parameter, State

__all__ = ["Effect", "Parameter", "State", "catalogue"]


@cache
def catalogue() -> dict[str, Effect]:
    """Return all effects by name, found by listing this folder.

    Examples
    --------
    >>> catalogue()["relaxation_length"].kind
    'physics'
    """
    found: dict[str, Effect] = {}
    for module_info in sorted(pkgutil.iter_modules(__path__), key=lambda m: m.name):
        if module_info.name in {"base", "shared"}:
            continue
        module = importlib.import_module(f"{__name__}.{module_info.name}")
        for value in vars(module).values():
            if (
                isinstance(value, type)
                and issubclass(value, Effect)
                and value.__module__ == module.__name__
                and value.name
            ):
                found[value.name] = value()
    return found
