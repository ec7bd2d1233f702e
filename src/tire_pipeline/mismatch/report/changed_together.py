"""Channels that changed in the same rows as the one which a named effect follows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from tire_pipeline.channels import OPERATING_CHANNELS, SHOWN_UNITS
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.context import Context
from tire_pipeline.mismatch.model.channels import CLASSES
from tire_pipeline.mismatch.report.contents import EffectReport
from tire_pipeline.pages.first_letter import first_large

Array = np.ndarray
_TOLD = 0.9
"""Share of a channel's variance that another one tells where they change together: a tenfold variance of what
is estimated of each, the usual limit of regression (Marquardt 1970, Technometrics 12:591)."""


def changed_together(
    data: Context, effects: Sequence[EffectReport]
) -> dict[tuple[str, str], tuple[str, ...]]:
    """Return which channels changed together with the channel of a named effect, though no name has them.

    Parameters
    ----------
    data : Context
    effects : sequence of EffectReport
        Those that are named.

    Returns
    -------
    dict
        Title of a named effect, and its channel -> channels that other effects follow; only where there are
        any.
    """
    named = {name for effect in effects for name in effect.names}
    known = {channel for name in named for channel in _channels(name)}
    other = {channel for name in set(catalogue()) - named for channel in _channels(name)} - known
    states = {c: data.smooth(c) for c in OPERATING_CHANNELS if data.varies(c)} if named else {}
    found = {
        (effect.title, channel): tuple(c for c in _together(channel, states) if c in other)
        for effect in effects
        for channel in _channels(effect.name)
        if channel in states
    }
    return {key: others for key, others in found.items() if others}


def on_changed_together(found: Mapping[tuple[str, str], tuple[str, ...]]) -> str:
    """Say that a name rests on the form of its force alone, where :func:`changed_together` found channels."""
    return " ".join(_sentence(title, channel, others) for (title, channel), others in found.items())


def changed_by_itself(found: Mapping[tuple[str, str], tuple[str, ...]], name: str) -> bool:
    """Whether no channel of this effect is among those that :func:`changed_together` found."""
    return {c for others in found.values() for c in others}.isdisjoint(_channels(name))


def _channels(name: str) -> tuple[str, ...]:
    effect = catalogue()[name]
    return tuple(dict.fromkeys((*effect.channels, *effect.drivers("fy"), *effect.drivers("fx"))))


def _together(channel: str, states: Mapping[str, Array]) -> list[str]:
    """Return the channels each of which tells the value of this one, and is told by it."""
    x = states[channel]
    return [
        name
        for name, y in states.items()
        if name != channel and min(_share_told(x, y), _share_told(y, x)) > _TOLD
    ]


def _share_told(x: Array, y: Array) -> float:
    """Return the share of a channel's variance, ``y``, that lies between classes of another one, ``x``."""
    edges = np.unique(np.quantile(x, np.linspace(0.0, 1.0, CLASSES + 1)[1:-1]))
    cell = np.searchsorted(edges, x)
    count = np.bincount(cell, minlength=edges.size + 1)
    mean = np.bincount(cell, y, edges.size + 1) / np.maximum(count, 1)
    return float(np.average((mean - y.mean()) ** 2, weights=count) / max(float(np.var(y)), 1e-300))


def _sentence(title: str, channel: str, others: Sequence[str]) -> str:
    labels = " and ".join(SHOWN_UNITS[c].label for c in others)
    own = SHOWN_UNITS[channel].label
    return (
        f"{first_large(labels)} changed in the same rows as {own}: that {title} is the cause "
        f"rests on the form of its force alone. Record sweeps in which only one of them changes."
    )
