"""Which inputs are cleaned of sensor noise: those that the force follows better when they are smooth.

A channel that fluctuates is either noisy (the tire does not feel it) or really moves (the tire does). The
forces decide: what smoothing takes off a channel goes through the model; if the recorded force contains it,
it was real.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from tire_pipeline.channels import POINT_CHANNELS, SLIP_AND_LOAD, shown_unit
from tire_pipeline.mismatch.model.channels import CHANCE
from tire_pipeline.mismatch.model.plain_forces import plain_forces
from tire_pipeline.mismatch.model.residual import error_over_forces, rms
from tire_pipeline.mismatch.recording.smoothing import denoise

Array = np.ndarray
_EVIDENCE_TO_SMOOTH = -float(np.log(CHANCE))
"""Log evidence from which the smooth channel is taken. Without it a channel stays as recorded."""


@dataclass(frozen=True)
class Cleaning:
    """What was done to one input channel.

    Parameters
    ----------
    channel : str
    smoothed : bool
        Whether the smooth channel is used; else the recorded one.
    removed : float
        RMS of what smoothing takes off, in the channel's unit.
    felt : float
        Share of it that the recorded force contains: 1 if the input really moved, 0 for sensor noise. NaN if
        the force does not show it.
    evidence : float
        Log evidence for the smooth channel over the recorded one.
    """

    channel: str
    smoothed: bool
    removed: float
    felt: float
    evidence: float

    def text(self) -> str:
        """Say in words what was done and why."""
        felt = np.clip(self.felt, 0.0, 1.0)
        share = (
            "the force does not show which it is" if np.isnan(felt) else f"the force follows {felt:.0%} of it"
        )
        done = "sensor noise was removed" if self.smoothed else "used as recorded, fast changes included"
        factor, unit, _ = shown_unit(self.channel, self.removed)
        size = f"{self.removed * factor:.2g} {unit}".strip()
        return f"{self.channel}: {done} ({size} RMS, {share})"


def clean(
    tire: Any,
    channels: Mapping[str, Array],
    recorded: Mapping[str, Array],
    start: Array,
) -> tuple[dict[str, Array], list[Cleaning]]:
    """Smooth each input channel whose fluctuation the forces do not follow.

    Differences from sample to sample tell noise from motion, and see nothing of what is slower: where a sweep
    is fast for its sampling, a window flattens it. So the whole error must not grow either.

    Parameters
    ----------
    tire : TireModel
    channels : mapping of ndarray, shape (n,)
        SI; slip_angle, slip_ratio, camber and normal_load are there.
    recorded : mapping of ndarray, shape (n,)
        ``fx`` and or ``fy``, N (less what another simulator has beyond the tire model).
    start : ndarray of bool, shape (n,)
        First samples of uninterrupted pieces.

    Returns
    -------
    channels : dict of ndarray
        The same channels, some of them smooth.
    done : list of Cleaning
        One entry for each channel that fluctuates.
    """
    now = dict(channels)
    forces = _forces(tire, now)
    done = []
    for name in SLIP_AND_LOAD:
        smooth = denoise(now[name], start)
        taken = now[name] - smooth
        if not np.any(taken):
            continue
        trial = {**now, name: smooth}
        there = _forces(tire, trial)
        felt, evidence = _judge(forces, there, recorded, start)
        shrinks = error_over_forces(there, recorded) < error_over_forces(forces, recorded)
        smoothed = evidence > _EVIDENCE_TO_SMOOTH and shrinks
        done.append(Cleaning(name, smoothed, rms(taken), felt, evidence))
        if smoothed:
            now, forces = trial, there
    return now, done


def _judge(
    with_it: Mapping[str, Array], smooth: Mapping[str, Array], recorded: Mapping[str, Array], start: Array
) -> tuple[float, float]:
    """Share of the fluctuation's force that was recorded, and log evidence that none was over that all was.

    By differences from sample to sample, in which whatever else the model gets wrong is small.
    """
    inside = ~start[1:]
    product = energy = evidence = 0.0
    for name, force in recorded.items():
        change = np.diff(with_it[name] - smooth[name])[inside]
        left = np.diff(force - smooth[name])[inside]
        own = float(change @ change)
        if own <= 0.0:
            continue
        share = float(change @ left) / own
        variance = max(float(np.mean((left - share * change) ** 2)), 1e-12 * float(np.mean(force**2)), 1e-30)
        product += own * share / variance
        energy += own / variance
        evidence += 0.5 * own * (1.0 - 2.0 * share) / variance
    return (product / energy if energy > 1.0 else float("nan")), evidence


def _forces(tire: Any, channels: Mapping[str, Array]) -> dict[str, Array]:
    return plain_forces(tire, **{n: channels[n] for n in POINT_CHANNELS if n in channels})
