"""Which exact repair of a channel (a unit, a sign) makes the forces agree."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from tire_pipeline.channels import TANGENTIAL_FORCES
from tire_pipeline.mismatch.effects.context import Simulate

Array = np.ndarray

FAR = 0.15
"""The model's force is far from zero beyond this part of its largest one (of either force)."""

FEW = 12
"""So many samples far from zero count in any case."""

LEAST_REPAIR_EVIDENCE = FEW * float(np.log(5.0))
"""Fewer count if they say as much for the repair as these do at a fifth of the squares: in twice the log
likelihood, samples times the logarithm of the squares' ratio."""

AS_WELL = 1.5
"""Two explanations whose squared residuals differ by less leave the same: sweeps of one tire on one rig
differ by as much (calspan, the same sweep repeated)."""

_ASKED = {"fx": ("fx",), "fy": ("fy",), "slip_angle": ("fy",), "camber": ("fy",), "slip_ratio": ("fx",)}
"""The force that a channel belongs to: this one has to ask for the repair. A load belongs to both."""


def best_repair(
    channels: Mapping[str, Array], simulate: Simulate, trials: Iterable[tuple[dict[str, float], tuple]]
) -> tuple[float, dict[str, float], tuple] | None:
    """Return the trial that makes model and recording agree, if the recording as it is does not.

    Parameters
    ----------
    channels : mapping of ndarray, shape (n,)
    simulate : callable
        The model on given channels.
    trials : iterable of (factors, label)
        Factors by channel: true = factor times recorded.

    Returns
    -------
    tuple or None
        Unexplained share of the forces' squares, factors, label. The share must be below 0.15 and a
        fifth of what it is without the repair, and the samples enough for that to be no chance.
    """
    plain = simulate(channels)
    best: tuple[float, dict[str, float], tuple] | None = None
    for factors, label in trials:
        before, after = unexplained(channels, simulate, factors, plain)
        sure = before > 0.3 or (before > 0.1 and after < 0.1 * before)
        if after < 0.15 and after < 0.2 * before and sure and (best is None or after < best[0]):
            best = (after, factors, label)
    return best


def unexplained(
    channels: Mapping[str, Array],
    simulate: Simulate,
    factors: Mapping[str, float],
    plain: Mapping[str, Array],
) -> tuple[float, float]:
    """Return the unexplained share of the recorded forces' squares without and with a repair.

    Forces are compared as they were recorded: a force that is made a thousand times smaller leaves a
    thousand times less, and has explained nothing. Only samples count where the model that the repair
    believes in has a force far from zero, and only forces that the repaired channels belong to; of these
    the worse one. Where no force says enough, or one that is to be repaired does not, both shares are 1.
    """
    repaired = {**channels, **{n: channels[n] * f for n, f in factors.items()}}
    predicted = simulate(repaired)
    largest = max(float(np.nanmax(np.abs(p))) for p in predicted.values())
    asked = {o for n in factors for o in _ASKED.get(n, TANGENTIAL_FORCES)}
    before, after = [], []
    for name in sorted(asked & set(channels)):
        far = np.abs(predicted[name]) > FAR * largest
        recorded, model = channels[name][far], predicted[name][far] / factors.get(name, 1.0)
        size = float(np.nanmean(recorded**2)) if far.any() else 0.0
        if size > 0.0:
            first, then = (
                max(float(np.nanmean((recorded - each) ** 2)) / size, 1e-12)
                for each in (plain[name][far], model)
            )
            if far.sum() >= FEW or far.sum() * np.log(first / then) >= LEAST_REPAIR_EVIDENCE:
                before.append(first)
                after.append(then)
                continue
        if name in factors:
            return 1.0, 1.0
    return (max(before), max(after)) if after else (1.0, 1.0)
