"""Which of a few standard sweeps would best separate what shares the posterior: expected information gain.

Each effect predicts a force for each sweep. The more these predictions differ beside what is usually left of
a force, the more the sweep tells (Lindley 1956; the bound for mixtures of normal distributions is that of
Kolchinsky and Tracey 2017).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch.corrected.model import CorrectedModel
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.sets.answer import SetAnswer
from tire_pipeline.mismatch.model.forces import Change

Array = np.ndarray
_SAMPLING_RATE = 50.0
_SWEEPS = 10.0
"""Independent samples of a short sweep."""
_LEAST_GAIN = 0.1
"""Log evidence below which no standard sweep tells anything."""
_USUAL_SPEED = 16.7
"""m/s, where none was recorded."""
_WARMED_BY = 25.0
"""degC."""


@dataclass(frozen=True)
class StandardSweep:
    """One standard sweep: what it is, and its channels in SI."""

    text: str
    frame: pd.DataFrame


def next_experiment(analysis: Analysis, answer: SetAnswer, model: CorrectedModel) -> str:
    """Return the sweep that separates the open names best, in words; nothing where none is open.

    Parameters
    ----------
    analysis : Analysis
    answer : SetAnswer
    model : CorrectedModel
        Of the recording, with nothing added.
    """
    rivals = _rivals(answer)
    if len(rivals) < 2:
        return ""
    gains = {sweep.text: _gain(sweep, rivals, model, analysis) for sweep in _sweeps(analysis)}
    best = max(gains, key=lambda text: gains[text])
    names = next(group for group, _ in answer.sets if len(group) > 1)
    first, *others = (catalogue()[n] for n in names)
    if gains[best] < _LEAST_GAIN:
        return f"{first.experiment[:1].upper()}{first.experiment[1:]}."
    return f"To separate {first.title} from {' and '.join(o.title for o in others)}, record {best}."


def _rivals(answer: SetAnswer) -> list[tuple[tuple[Change, ...], float]]:
    """The effects that share the place of each name, with their probability."""
    out = []
    for group, sure in answer.sets:
        if len(group) > 1:
            for name in group:
                out.append((answer.single(name), sure / len(group)))
    return out


def _sweeps(analysis: Analysis) -> Iterator[StandardSweep]:
    """Yield standard sweeps about the middle of what was recorded."""
    data = analysis.data
    load = float(np.median(data.get("normal_load")))
    speed = float(np.median(data.get("speed"))) if data.has("speed") else _USUAL_SPEED
    top = max(float(np.quantile(np.abs(data.get("slip_angle")), 0.99)), 0.02)
    middle: dict[str, float] = {"normal_load": load, "speed": speed, "camber": 0.0, "slip_ratio": 0.0}
    for name in ("pressure", "tread_temperature"):
        if data.has(name):
            middle[name] = float(np.median(data.get(name)))
    slow = np.sin(2.0 * np.pi * np.arange(0.0, 20.0, 1.0 / _SAMPLING_RATE) / 10.0)
    fast = np.sin(2.0 * np.pi * np.arange(0.0, 20.0, 1.0 / _SAMPLING_RATE))

    def sweep(text: str, wave: Array, **changed: float | Array) -> StandardSweep:
        time = np.arange(wave.size) / _SAMPLING_RATE
        return StandardSweep(
            text, pd.DataFrame({"time": time, "slip_angle": top * wave, **{**middle, **changed}})
        )

    yield sweep("a slow slip angle sweep at half the speed", slow, speed=0.5 * speed)
    yield sweep("a slip angle sine of 1 Hz", fast)
    yield sweep("a slip angle sine of 1 Hz at half the speed", fast, speed=0.5 * speed)
    yield sweep("a slow slip angle sweep at half the load", slow, normal_load=0.5 * load)
    yield sweep("a slow slip angle sweep at one and a half times the load", slow, normal_load=1.5 * load)
    yield sweep(
        "straight rolling while the load goes from nearly nothing to its middle",
        0.0 * slow,
        normal_load=load * (0.55 + 0.45 * slow),
    )
    yield sweep("a slow slip angle sweep at 2 deg of camber", slow, camber=float(np.radians(2.0)))
    yield sweep("a slow slip angle sweep to small angles only", 0.2 * slow)
    if "tread_temperature" in middle:
        yield sweep(
            "a slow slip angle sweep with the tread 25 degC warmer",
            slow,
            tread_temperature=middle["tread_temperature"] + _WARMED_BY,
        )
    if "pressure" in middle:
        yield sweep("a slow slip angle sweep at 20% more pressure", slow, pressure=1.2 * middle["pressure"])


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
    apart = np.zeros((len(rivals), len(rivals)))
    for o in model.outputs:
        size = analysis.misfit * analysis.largest[o] + analysis.noise[o].floor
        forces = np.array([frame[o].to_numpy(float) for frame in predicted])
        apart += _SWEEPS * np.mean(((forces[:, None] - forces[None, :]) / size) ** 2, axis=2)
    return _information(weights, apart)


def _information(weights: Array, apart: Array) -> float:
    """Mutual information of components and a mixture of equal normal distributions, from below.

    Parameters
    ----------
    weights : ndarray, shape (k,)
    apart : ndarray, shape (k, k)
        Squared distances of the means over their standard deviation.
    """
    return float(-(weights * np.log(np.exp(-apart / 8.0) @ weights)).sum())
