"""Choose the standard sweep that best separates the open explanations: expected information gain.

Each effect predicts a force for each sweep. The more these predictions differ beside what is usually left of
a force, the more the sweep tells (Lindley 1956; the bound for mixtures of normal distributions is that of
Kolchinsky and Tracey 2017).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
import scipy

from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch.corrected.model import CorrectedModel
from tire_pipeline.mismatch.effects import catalogue, told_by
from tire_pipeline.mismatch.effects.shared import INDEPENDENT_STRETCHES
from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.sets.answer import SetAnswer
from tire_pipeline.mismatch.model.channels import ABSOLUTE_SPREAD, ENOUGH_ROWS, largest
from tire_pipeline.mismatch.model.forces import Change
from tire_pipeline.mismatch.unnamed_physics.language.symbols import SPAN
from tire_pipeline.pages.first_letter import first_large

Array = np.ndarray
_SLOW_PERIOD, _FAST_PERIOD = 10.0, 1.0
"""Of a sweep, s."""
_MORE_PRESSURE = 1.2
"""Times the recording's pressure, in a sweep with another one: within what a tire may be run at."""
_BETWEEN = 0.5
"""Order of the divergence between two distributions: the bound is best where both count alike."""


@dataclass(frozen=True)
class StandardSweep:
    """One standard sweep.

    Parameters
    ----------
    text : str
        What it is.
    frame : pandas.DataFrame
        Its channels in SI.
    changed : frozenset of str
        Channels that are elsewhere than about the middle of what was recorded.
    """

    text: str
    frame: pd.DataFrame
    changed: frozenset[str]


def next_experiment(analysis: Analysis, answer: SetAnswer, model: CorrectedModel) -> str:
    """Return the sweep that separates the open names best, in words; nothing where none is open.

    Each set of names is a question of its own: a sweep that answers one may say nothing of another. Where a
    name is alone, what is the same to the data may be open: an effect's own experiment asks that.

    Parameters
    ----------
    analysis : Analysis
    answer : SetAnswer
    model : CorrectedModel
        Of the recording, with nothing added.
    """
    open_names = _sets_that_are_open(answer)
    if not open_names:
        named = [change for change in answer.named.changes if change[0] in answer.names]
        alike = [name for name, p in named if catalogue()[name].same_to_data(analysis.data, p)]
        return _own_experiment(alike[0]) if alike else ""
    sweeps = list(_sweeps(analysis))
    gains = np.array([[_gain(s, q.rivals, model, analysis) for q in open_names] for s in sweeps])
    best = int(gains.sum(axis=1).argmax())
    settled = [q for q, gain in zip(open_names, gains[best], strict=True) if gain >= 0.5 * q.entropy]
    if settled:  # more than it leaves open
        what = ", and ".join(q.text for q in settled)
        return f"{first_large(what)}, record {sweeps[best].text}."
    if answer.rivals:
        return ""
    return _own_experiment(open_names[0].names[0])


def _own_experiment(name: str) -> str:
    """Return the experiment of an effect as a sentence; nothing where it has none."""
    text = catalogue()[name].experiment
    return f"{first_large(text)}." if text else ""


@dataclass(frozen=True)
class _OpenNames:
    """What a sweep may answer: which of some explanations holds, each with its probability."""

    names: tuple[str, ...]
    rivals: list[tuple[tuple[Change, ...], float]]

    @property
    def entropy(self) -> float:
        """What is open, as the sweep's information."""
        return float(scipy.stats.entropy([p for _, p in self.rivals]))

    @property
    def text(self) -> str:
        """What a sweep is recorded for."""
        if not self.names:
            return "to tell the explanations apart"
        first, *others = (catalogue()[n].title for n in self.names)
        return f"to separate {first} from {' and '.join(others)}"


def _sets_that_are_open(answer: SetAnswer) -> list[_OpenNames]:
    """Which name of each set holds; which explanation does, where none stands out."""
    rivals = [(each.changes, answer.probabilities[each.names]) for each in answer.rivals]
    if rivals:
        return [_OpenNames((), rivals)] if len(rivals) > 1 else []
    return [
        _OpenNames(group, [(answer.single(name), sure / len(group)) for name in group])
        for group, sure in answer.sets
        if len(group) > 1
    ]


def _sweeps(analysis: Analysis) -> Iterator[StandardSweep]:
    """Yield standard sweeps about the middle of what was recorded."""
    data = analysis.data
    top = max(largest(data.get("slip_angle")), ABSOLUTE_SPREAD["slip_angle"])
    states = [n for n in ("normal_load", "speed", "pressure", "tread_temperature") if data.has(n)]
    middle = {n: float(np.median(data.get(n))) for n in states} | {"camber": 0.0, "slip_ratio": 0.0}
    time = np.linspace(0.0, 2.0 * _SLOW_PERIOD, ENOUGH_ROWS)
    slow, fast = (np.sin(2.0 * np.pi * time / period) for period in (_SLOW_PERIOD, _FAST_PERIOD))

    def sweep(text: str, wave: Array, **changed: float | Array) -> StandardSweep:
        channels = {"time": time, "slip_angle": top * wave, **middle, **changed}
        return StandardSweep(text, pd.DataFrame(channels), frozenset(changed))

    load = middle["normal_load"]
    rising = 0.5 * load * (1.0 + slow)
    yield sweep("a slip angle sine of 1 Hz", fast)
    yield sweep("a slow slip angle sweep at half the load", slow, normal_load=0.5 * load)
    yield sweep(
        "straight rolling while the load goes from nothing to its middle", 0.0 * slow, normal_load=rising
    )
    yield sweep("a slow slip angle sweep at 2 deg of camber", slow, camber=float(np.radians(2.0)))
    yield sweep("a slow slip angle sweep to half the angle", 0.5 * slow)
    if "speed" in middle:
        half = 0.5 * middle["speed"]
        yield sweep("a slow slip angle sweep at half the speed", slow, speed=half)
        yield sweep("a slip angle sine of 1 Hz at half the speed", fast, speed=half)
    if "tread_temperature" in middle:
        warm = middle["tread_temperature"] + SPAN
        text = f"a slow slip angle sweep with the tread {SPAN:.0f} degC warmer"
        yield sweep(text, slow, tread_temperature=warm)
    if "pressure" in middle:
        more = _MORE_PRESSURE * middle["pressure"]
        yield sweep("a slow slip angle sweep at 20% more pressure", slow, pressure=more)


def _gain(
    sweep: StandardSweep,
    rivals: list[tuple[tuple[Change, ...], float]],
    model: CorrectedModel,
    analysis: Analysis,
) -> float:
    """Expected information of one sweep about which of the rivals is the cause."""
    try:
        predicted = [replace(model, changes=changes).predict(sweep.frame) for changes, _ in rivals]
    except RecordingError:
        return 0.0
    weights = np.array([p for _, p in rivals])
    weights = weights / weights.sum()
    tells = _can_tell(sweep, rivals, analysis)
    apart = np.zeros((len(rivals), len(rivals)))
    for o in model.outputs:
        size = analysis.misfit * analysis.largest[o] + analysis.noise[o].floor
        forces = np.array([frame[o].to_numpy(float) for frame in predicted])
        apart += INDEPENDENT_STRETCHES * np.mean(((forces[:, None] - forces[None, :]) / size) ** 2, axis=2)
    return _information(weights, np.where(tells, apart, 0.0))


def _can_tell(
    sweep: StandardSweep, rivals: list[tuple[tuple[Change, ...], float]], analysis: Analysis
) -> Array:
    """Whether a sweep can tell each pair of rivals apart, shape (k, k).

    Some effects only a channel tells apart. Where it did not vary, parameters as likely as these make the
    two alike at its one value, and only another value tells.
    """
    names = [{name for name, _ in changes} for changes, _ in rivals]
    needed = [[_told_by(a - b, b - a) for b in names] for a in names]
    seen = sweep.changed | {channel for channel in analysis.data.present if analysis.data.varies(channel)}
    return np.array([[channel == "" or channel in seen for channel in row] for row in needed])


def _told_by(own: set[str], others: set[str]) -> str:
    """The channel that tells two sets apart which differ in one effect."""
    return told_by(*own, *others) if len(own) == len(others) == 1 else ""


def _information(weights: Array, apart: Array) -> float:
    """Mutual information of components and a mixture of equal normal distributions, from below.

    Parameters
    ----------
    weights : ndarray, shape (k,)
    apart : ndarray, shape (k, k)
        Squared distances of the means over their standard deviation.
    """
    divergence = 0.5 * _BETWEEN * (1.0 - _BETWEEN) * apart
    return float(-(weights * np.log(np.exp(-divergence) @ weights)).sum())
