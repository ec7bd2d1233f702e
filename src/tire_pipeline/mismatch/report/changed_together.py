"""Channels that changed in the same rows as the one which a named effect follows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from tire_pipeline.channels import OPERATING_CHANNELS, SHOWN_UNITS
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.context import Context
from tire_pipeline.mismatch.model.channels import CLASSES
from tire_pipeline.mismatch.report.contents import EffectReport

Array = np.ndarray
_TOLD = 0.9
"""Share of a channel's variance that another one tells where they change together: a tenfold variance of what
is estimated of each, the usual limit of regression (Marquardt 1970, Technometrics 12:591)."""


def on_changed_together(data: Context, effects: Sequence[EffectReport]) -> str:
    """Say which causes only the form of their force tells from a named one: their channels changed together.

    Parameters
    ----------
    data : Context
    effects : sequence of EffectReport
        Those that are named.

    Returns
    -------
    str
        "" where each named effect's channel changed by itself.
    """
    return " ".join(
        _sentence(effect.title, channel, others)
        for effect in effects
        for channel, others in _unexplained(data, effects, effect.name).items()
    )


def changed_by_itself(data: Context, effects: Sequence[EffectReport], name: str) -> bool:
    """Whether no channel of an effect without a name changed together with that of a named one."""
    others = {c for e in effects for each in _unexplained(data, effects, e.name).values() for c in each}
    return not others & set(_channels(name))


def _unexplained(data: Context, effects: Sequence[EffectReport], name: str) -> dict[str, list[str]]:
    """Return, for each channel of a named effect, those of causes without a name that changed with it."""
    said = {n for effect in effects for n in (effect.name, *effect.alternatives)}
    explained = {channel for n in said for channel in _channels(n)}
    could = {channel for n in set(catalogue()) - said for channel in _channels(n)} - explained
    states = {c: data.smooth(c) for c in OPERATING_CHANNELS if data.varies(c)}
    found = {c: [o for o in _together(c, states) if o in could] for c in _channels(name) if c in states}
    return {channel: others for channel, others in found.items() if others}


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
        f"{labels[:1].upper()}{labels[1:]} changed in the same rows as {own}: that {title} is the cause "
        f"rests on the form of its force alone. Record sweeps in which only one of them changes."
    )
