"""The catalogue: one effect a file. Adding an effect is adding a file with one subclass of ``Effect``."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache

from tire_pipeline.mismatch.effects.base import Effect, Parameter, State

__all__ = ["Effect", "Parameter", "State", "catalogue"]


@cache
def catalogue() -> dict[str, Effect]:
    """Return all effects by name, found by listing this folder and those within.

    Examples
    --------
    >>> catalogue()["relaxation_length"].kind
    'physics'
    """
    found: dict[str, Effect] = {}
    names = [each.name for each in pkgutil.walk_packages(__path__, f"{__name__}.") if not each.ispkg]
    for name in sorted(names, key=lambda each: each.rpartition(".")[2]):
        module = importlib.import_module(name)
        for value in vars(module).values():
            if (
                isinstance(value, type)
                and issubclass(value, Effect)
                and value.__module__ == module.__name__
                and value.name
            ):
                found[value.name] = value()
    return found
