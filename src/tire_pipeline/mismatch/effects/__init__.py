"""The catalogue: one effect a file. Adding an effect is adding a file with one subclass of ``Effect``."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Collection
from functools import cache
from importlib.metadata import entry_points

from tire_pipeline.errors import DomainError
from tire_pipeline.mismatch.effects.base import Effect, Parameter, State
from tire_pipeline.mismatch.effects.context import Context

__all__ = ["Context", "Effect", "Parameter", "State", "catalogue", "look_alike", "register", "told_by"]

GROUP = "tire_pipeline.effects"
"""Entry point under which an installed package offers effects of its own."""


@cache
def catalogue() -> dict[str, Effect]:
    """Return all effects by name: those of this folder and within, then those of installed packages.

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
    for entry in entry_points(group=GROUP):
        _add(found, entry.load()())
    return found


def told_by(one: str, other: str) -> str:
    """Return the channel that has to vary to tell two effects apart, or nothing if it is not one channel.

    Parameters
    ----------
    one, other : str
        Names of effects.
    """
    return catalogue()[one].told_by.get(other, "") or catalogue()[other].told_by.get(one, "")


def look_alike(one: str, other: str, steady: Collection[str]) -> bool:
    """Return whether two effects are of one family, or only a channel tells them apart that does not vary.

    Parameters
    ----------
    one, other : str
        Names of effects.
    steady : collection of str
        Channels that do not vary.
    """
    family = catalogue()[one].family == catalogue()[other].family != ""
    return family or told_by(one, other) in steady


def register(effect: Effect) -> None:
    """Add an effect from outside of this package to the catalogue, for as long as this process runs.

    A package that is installed offers its effects for good by an entry point ``tire_pipeline.effects``.

    Parameters
    ----------
    effect : Effect
        An instance of a subclass, with a name of its own.

    Raises
    ------
    DomainError
        It states no name, title, equation or source, or has the name of another effect.
    """
    _add(catalogue(), effect)


def _add(found: dict[str, Effect], effect: Effect) -> None:
    for lacking in ("name", "title", "equation", "source"):
        if not getattr(effect, lacking):
            raise DomainError(
                f"the effect {type(effect).__name__} has no {lacking}", todo="state it in its class"
            )
    if effect.name in found:
        raise DomainError(
            f"the catalogue has an effect {effect.name!r} already", todo="give the new one another name"
        )
    found[effect.name] = effect
