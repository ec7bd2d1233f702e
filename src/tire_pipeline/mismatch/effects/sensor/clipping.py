"""A channel that cannot go beyond a limit."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np
import scipy

from tire_pipeline.channels import FORCE_CHANNELS, SLIP_AND_LOAD
from tire_pipeline.mismatch.effects.base import Array, Effect, Finding
from tire_pipeline.mismatch.effects.context import Context, Simulate
from tire_pipeline.mismatch.effects.shared import CLIPPED
from tire_pipeline.recordings.stretches import stretches


class Clipping(Effect):
    """The recorded force stops at a limit, whatever the tire does.

    Covers channels of which many samples in time stand exactly at one end of their range, either or both,
    and steady points of whose forces more stand at a limit than chance explains. Slip and load also stand
    where a test holds them: they are clipped only where the forces move on meanwhile. Not covered: a limit
    that noise or a filter after it has blurred: without samples at it there is no limit to see.
    """

    name = "clipping"
    kind = "artefact"
    title = "a clipped channel"
    equation = "F recorded = min(max(F, -limit), limit)"
    source = "range of amplifier or converter"
    looks_like = {"friction_scale": "friction limits the force in proportion to load; clipping at one value"}
    experiment = "repeat with a larger range of the amplifier"
    order = 99
    found_in = "samples"

    def absent(self, data: Context) -> str | None:
        """Never a candidate of the fit: at a limit samples stand, or there is none."""
        return "looked for in the channel itself, not by a fit"

    def detect(self, channels: Mapping[str, Array], simulate: Simulate) -> list[Finding]:
        """Find many samples exactly at one end of a channel's range."""
        found = []
        for name in CLIPPED:
            if name not in channels:
                continue
            x = channels[name]
            held = partial(_held, name, channels, simulate)
            look = _points_at_a_limit if "_steady_points" in channels else _at_the_ends
            bad, limits = look(x, held)
            if bad is None:
                continue
            text = (
                f"{name} stays exactly at {', '.join(f'{v:.5g}' for v in limits)} for "
                f"{int(bad.sum())} samples"
            )
            values = {f"{name}_limit_{i + 1}": (v, 0.0, "as recorded") for i, v in enumerate(limits)}
            middle = _middle(x)
            below, above = [v for v in limits if v < middle], [v for v in limits if v > middle]
            ends = (max(below, default=-np.inf), min(above, default=np.inf))
            found.append(Finding(self.name, name, text, values, {}, bad, limits=ends))
        return found


def _at_the_ends(x: Array, held: Callable[[Array], bool]) -> tuple[Array | None, list[float]]:
    """Samples in time that stand exactly at the largest or smallest value, if these are many.

    They must stay there three samples on end, and be more than the crest of a smooth signal leaves in a last
    step of the channel's resolution.
    """
    finite = x[np.isfinite(x)]
    if finite.size < 50 or np.ptp(finite) == 0.0:
        return None, []
    values, counts = np.unique(finite, return_counts=True)
    between = counts[1:-1]  # the ends themselves say nothing about how often a value comes back
    least = max(12.0, 4.0 * np.quantile(between, 0.99)) if between.size else np.inf
    bad = np.zeros(x.size, bool)
    limits = []
    for value in (values[-1], values[0]):
        at = x == value
        stays = len(_at_least(at, _LEAST_STAY)) > 0 and not _crest(values, counts, value)
        if at.sum() >= least and stays and not held(at):
            bad |= at
            limits.append(float(value))
    return (bad, limits) if limits else (None, [])


_LEAST_STAY = 3
"""Samples on end that a channel stands at a limit."""
_STEPS_OF_CREST = 10
_BY_CHANCE = 1e-3
_DECIMALS = range(-3, 12)


def _held(name: str, channels: Mapping[str, Array], simulate: Simulate, at: Array) -> bool:
    """Whether a channel stands at a value because it is held there, and not because it can't go beyond.

    A test sets slip and load: they are held, unless the forces move on while they stand. A force rests at
    zero, or where slip and load are the same, of either sign. Where the simulated force is in the other half
    of the range, the recorded one was not on its way to a limit.
    """
    if name not in FORCE_CHANNELS:
        return "_steady_points" in channels or not forces_move_on(name, channels, simulate, at)
    x, simulated = channels[name], simulate(channels).get(name)
    middle = _middle(x)
    if simulated is not None and np.median((simulated[at] - middle) * (x[at] - middle)) < 0.0:
        return True
    inputs = (np.abs(channels[n][at]) for n in SLIP_AND_LOAD if n in channels)
    return bool(np.all(x[at] == 0.0)) or all(np.allclose(each, each[0]) for each in inputs)


def forces_move_on(name: str, channels: Mapping[str, Array], simulate: Simulate, at: Array) -> bool:
    """Whether forces follow an input beyond the value at which its channel stands.

    Beyond a limit the true input leaves its channel and comes back. The forces then leave the simulated ones
    by their slope, times about half a sine over the time at the limit. As much of half a sine is in any
    other stretch of the residual by noise and by what the model gets wrong: Fisher's ratio compares both.

    Parameters
    ----------
    name : str
        Slip or load.
    channels : mapping of ndarray, shape (n,)
    simulate : callable
        Channels -> forces of the model, N or N m.
    at : ndarray of bool, shape (n,)
        Where the channel stands at an end of its range.
    """
    x = channels[name]
    stands = _at_least(at, _LEAST_STAY)
    length = int(np.median(np.diff(stands, axis=1)))
    between = (x > np.nanmin(x)) & (x < np.nanmax(x))
    pieces = [_cut(stretch, length) for stretch in _at_least(between, length)]
    others = np.concatenate(pieces or [stands[:0]])
    if not len(others):
        return False
    outwards = np.sign(x - _middle(x)) * 1e-3 * np.ptp(x)
    base, moved = simulate(channels), simulate({**channels, name: x + outwards})
    there, elsewhere = [], []
    for output, force in base.items():
        if output in channels:
            residual, slope = np.nan_to_num(channels[output] - force), np.nan_to_num(moved[output] - force)
            there += [_half_sine(residual[a:b], slope[a:b]) for a, b in stands]
            elsewhere += [_half_sine(residual[a:b], slope[a:b]) for a, b in others]
    power = float(np.mean(np.square(elsewhere))) if elsewhere else 0.0
    if power == 0.0 or np.sum(there) <= 0.0:
        return False
    ratio = float(np.mean(np.square(there))) / power
    return bool(scipy.stats.f.sf(ratio, len(there), len(elsewhere)) < _BY_CHANCE)


def _at_least(mask: Array, count: int) -> Array:
    """Return the stretches of at least so many samples, shape (k, 2)."""
    found = stretches(mask)
    return found[np.diff(found, axis=1)[:, 0] >= count]


def _cut(stretch: Array, length: int) -> Array:
    """Cut a stretch into pieces of one length, shape (k, 2)."""
    first = np.arange(stretch[0], stretch[1] - length + 1, length)
    return np.stack([first, first + length], axis=1)


def _half_sine(residual: Array, slope: Array) -> float:
    """How much of the slope, times half a sine, is in a residual; a constant is of no account."""
    shape = slope * np.sin(np.pi * (np.arange(slope.size) + 0.5) / slope.size)
    shape = shape - shape.mean()
    size = float(np.linalg.norm(shape))
    return float(residual @ shape) / size if size > 0.0 else 0.0


def _middle(x: Array) -> float:
    return 0.5 * float(np.nanmin(x) + np.nanmax(x))


def _points_at_a_limit(x: Array, held: Callable[[Array], bool]) -> tuple[Array | None, list[float]]:
    """Steady points exactly at a limit: of either sign, or at one end.

    So many must not coincide there by chance. One more point falls on the limit with the probability that
    one falls into its last digit rather than into the gap below, or, if that is more likely, as often as
    the other points coincide with each other (rows that were repeated, curves with a symmetry).
    """
    finite = np.isfinite(x)
    if not finite.any() or np.ptp(x[finite]) == 0.0:
        return None, []
    for y in (np.abs(x), x, -x):
        limit = float(np.max(y[finite]))
        at = finite & (y == limit)
        below = y[finite & ~at]
        if below.size and not held(at) and _coincide(limit - below, x[finite & ~at], at.sum()):
            return at, sorted({float(v) for v in x[at]}, reverse=True)
    return None, []


def _coincide(below: Array, others: Array, count: int) -> bool:
    """Whether so many points at a limit are no chance; ``below``: how far the others are from it."""
    digit = next((10.0**-d for d in _DECIMALS if np.allclose(np.round(others, d), others, 1e-12, 0.0)), 0.0)
    repeated = (below.size - np.unique(below).size + 0.5) / (below.size + 1.0)  # Jeffreys' prior of a share
    return max(digit / (digit + np.min(below)), repeated) ** (count - 1) < _BY_CHANCE


def _crest(values: Array, counts: Array, end: float) -> bool:
    """Whether as many samples at the end of a range are what a smooth crest and the resolution make.

    A parabola spends at most ``steps ** -0.5`` of the time within so many steps of its top in the last of
    them. The resolution is the smallest step between values near the end.
    """
    distance = np.abs(values - end)
    near = np.sort(distance)[: 5 * _STEPS_OF_CREST]
    steps = np.diff(near)
    resolution = float(np.min(steps[steps > 1e-9 * max(abs(end), near[-1])], initial=np.inf))
    if not np.isfinite(resolution):
        return False
    last = int(counts[distance < 0.5 * resolution].sum())
    around = int(counts[distance < (_STEPS_OF_CREST - 0.5) * resolution].sum())
    by_chance = (
        1.0 if last == 0 else float(scipy.special.bdtrc(last - 1, around, _STEPS_OF_CREST**-0.5))
    )  # binomial: so many or more
    return by_chance > _BY_CHANCE
