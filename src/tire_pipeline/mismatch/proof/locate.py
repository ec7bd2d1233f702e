"""Where and when the recording leaves the model: over time and over the operating axes, at many scales."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy

from tire_pipeline.channels import OPERATING_CHANNELS
from tire_pipeline.mismatch.discrepancy.noise import ForceNoise
from tire_pipeline.mismatch.model.channels import CHANCE, CLASSES, largest
from tire_pipeline.mismatch.model.data import Data

Array = np.ndarray
_FLIPS = 199
"""Draws of signs: with so many a chance of one in twenty is known to a third of itself."""
_NARROW = 0.02
"""Part of a channel's range below which a stretch is a held level, not a range to name."""
_LEAST_FORCE = 0.1
"""A share of the force is stated where the force is above this part of the largest one."""
_EVEN = 0.7
"""What is off throughout, in no stretch: one share of the force, or one force, that is this part of the
squared difference."""


@dataclass(frozen=True)
class Located:
    """One stretch of an axis in which recorded and simulated force differ.

    Parameters
    ----------
    output, axis : str
        ``axis`` is ``"time"`` or a channel.
    low, high : float
        SI.
    mean : float
        Mean of recorded minus simulated force in the direction of the simulated one, N (of the
        plain difference if ``signed`` is False).
    share : float
        The same over the mean size of the simulated force; NaN where that is below a tenth of the largest.
    p_value : float
        Largest statistic over all axes, stretches and scales under flips of whole sweeps.
    own : float
        Part of the mean that the first axis of this output does not explain: near zero for a channel that
        merely varied with it.
    """

    output: str
    axis: str
    low: float
    high: float
    mean: float
    share: float
    p_value: float
    along_force: bool
    own: float = 1.0


def locate(
    data: Data,
    residual: dict[str, Array],
    noise: dict[str, ForceNoise],
    block: Array,
    *,
    flips: int = _FLIPS,
    seed: int = 0,
) -> list[Located]:
    """Find where a residual is not noise.

    Parameters
    ----------
    data : Data
    residual : dict of ndarray
        Recorded minus simulated, N.
    noise : dict of ForceNoise
    block : ndarray of int
        Sweep of each sample; signs are flipped by whole sweeps.
    flips : int
        Number of random flips.

    Returns
    -------
    list of Located
        For each axis and output the stretch with the largest difference of those with p at most 0.05,
        along the force where its size is off, else to one side; the largest difference first.
    """
    rng = np.random.default_rng(seed)
    count = int(block.max()) + 1
    signs = np.vstack([np.ones(count), rng.choice([-1.0, 1.0], size=(flips, count))])
    out: list[Located] = []
    for o, r in residual.items():
        for along in (True, False):
            out += _axes(data, o, r, noise[o], block, signs, along)
    out.sort(key=lambda f: -abs(f.mean))
    return out


def _axes(
    data: Data, output: str, rest: Array, noise: ForceNoise, block: Array, signs: Array, along: bool
) -> list[Located]:
    """Test all stretches of all axes; the largest statistic of each flip gives the p-values."""
    plain = rest * _direction(data.simulation.base[output]) if along else rest
    scaled = plain / noise.sigma
    tests: list[tuple[str, float, float, Array]] = []
    for axis in ("time", *OPERATING_CHANNELS):
        if axis == "time":
            if data.time is None:
                continue
            values = data.time
        elif data.varies(axis):
            values = data.smooth(axis)
        else:
            continue
        edges = np.quantile(values, np.linspace(0.0, 1.0, CLASSES + 1))
        for width in _widths():
            for k in range(0, CLASSES + 1 - width, max(1, width // 2)):
                low, high = float(edges[k]), float(edges[k + width])
                if high - low > _NARROW * (edges[-1] - edges[0]):
                    tests.append((axis, low, high, (values >= low) & (values <= high)))
    count = signs.shape[1]
    sums = np.array([np.bincount(block, scaled * m, count) for *_, m in tests])
    size = np.sqrt((sums**2).sum(axis=1)) + 1e-12
    statistics = np.abs(signs @ sums.T) / size[None, :]
    enough = np.array([0.5 ** np.count_nonzero(s) < CHANCE for s in sums])  # else no sign test says anything
    statistics[:, ~enough] = 0.0
    top = statistics.max(axis=1)
    found = []
    rows = []
    for axis in dict.fromkeys(t[0] for t in tests):
        own = [i for i, t in enumerate(tests) if t[0] == axis]
        chance = {i: float((1 + (top[1:] >= statistics[0, i]).sum()) / signs.shape[0]) for i in own}
        sure = [i for i in own if chance[i] <= CHANCE]
        sure = [i for i in sure if _along(rest, data.simulation.base[output], tests[i][3]) == along]
        if not sure:
            continue
        best = max(sure, key=lambda i: abs(float(plain[tests[i][3]].mean())))
        _, low, high, mask = tests[best]
        mean = float(plain[mask].mean())
        share = mean / _force(data, output, mask)
        found.append(Located(output, axis, low, high, mean, share, chance[best], along))
        rows.append(mask)
    if not found:
        return found
    first = max(found, key=lambda f: abs(f.mean))
    rest = plain - _profile(_values(data, first.axis), plain)
    return [
        f if f is first else replace(f, own=float(rest[r].mean()) / f.mean)
        for f, r in zip(found, rows, strict=True)
    ]


def _widths() -> list[int]:
    """Numbers of neighbouring bins that are looked at together: 1, 2, 4 ... up to half of them."""
    return [2**k for k in range(CLASSES.bit_length() - 1)]


def _direction(force: Array) -> Array:
    """Sign of a force, fading to zero where the force does."""
    return np.sign(force) * np.minimum(np.abs(force) / (0.5 * _LEAST_FORCE * largest(force) + 1e-12), 1.0)


def _along(rest: Array, force: Array, rows: Array) -> bool:
    """Whether in some rows the size of the force is off, rather than the force to one side.

    Both are the same where the force keeps its sign. Where it goes through zero, an offset is no part of it.
    """
    here = rest[rows]
    return abs(float((here * np.sign(force[rows])).mean())) >= abs(float(here.mean()))


def _values(data: Data, axis: str) -> Array:
    """An axis at each sample."""
    return data.time if axis == "time" and data.time is not None else data.smooth(axis)


def _profile(values: Array, x: Array) -> Array:
    """Mean over all samples with nearly the same value of an axis."""
    edges = np.unique(np.quantile(values, np.linspace(0.0, 1.0, CLASSES + 1)[1:-1]))
    number = np.searchsorted(edges, values)
    size = np.maximum(np.bincount(number), 1)
    return np.asarray((np.bincount(number, x) / size)[number])


def _force(data: Data, output: str, rows: Array) -> float:
    """Mean size of the simulated force, N; NaN where it is too small for a share of it to mean something."""
    size = np.abs(data.simulation.base[output])
    here = float(size[rows].mean())
    return here if here > _LEAST_FORCE * largest(size) else float("nan")


@dataclass(frozen=True)
class Throughout:
    """How a force is off everywhere.

    Parameters
    ----------
    mean : float
        Mean of recorded minus simulated force, N.
    share : float
        Mean of the difference along the force over the mean size of the force; NaN where the force is off to
        one side instead.
    """

    mean: float
    share: float = float("nan")


def everywhere(data: Data, residual: dict[str, Array], located: list[Located]) -> dict[str, Throughout]:
    """Return by what an output is off throughout, if that is most of the mismatch: a share of it, or a force.

    Parameters
    ----------
    data : Data
    residual : dict of ndarray
        Recorded minus simulated, N.
    located : list of Located

    Returns
    -------
    dict
        Output -> how it is off.
    """
    out = {}
    for o, r in residual.items():
        found = {f.along_force for f in located if f.output == o}
        mean, force = float(r.mean()), data.simulation.base[o]
        rows = np.abs(force) > _LEAST_FORCE * largest(force)
        ways = [(np.sum((r - mean) ** 2), Throughout(mean))] if False in found else []
        if True in found and rows.any():
            share = float((r[rows] * np.sign(force[rows])).mean() / np.abs(force[rows]).mean())
            ways.append((np.sum((r - share * force) ** 2), Throughout(mean, share)))
        left, way = min(ways, key=lambda each: each[0], default=(np.inf, None))
        if way is not None and left < (1.0 - _EVEN) * np.sum(r**2):
            out[o] = way
    return out


def when(part: Array, data: Data, floor: float) -> list[tuple[float, float]]:
    """Return the stretches of time in which an effect's RMS over 1 s is above the noise floor, s.

    Stretches nearer than 2 s are joined, and those under half a second left out.
    """
    if data.time is None:
        return []
    width = max(round(1.0 / max(float(np.median(data.step)), 1e-9)), 1)
    local = np.sqrt(np.maximum(scipy.ndimage.uniform_filter1d(part**2, width), 0.0))
    above = np.flatnonzero(local > floor)
    if above.size == 0:
        return []
    breaks = np.flatnonzero(np.diff(data.time[above]) > 2.0)
    starts, ends = above[np.r_[0, breaks + 1]], above[np.r_[breaks, above.size - 1]]
    pairs = [(float(data.time[a]), float(data.time[b])) for a, b in zip(starts, ends, strict=True)]
    return [(a, b) for a, b in pairs if b - a >= 0.5]


def where(part: Array, data: Data) -> dict[str, tuple[float, float]]:
    """Return for each recorded axis the interval that holds the central 90% of an effect's energy."""
    energy = part**2
    total = float(energy.sum())
    out: dict[str, tuple[float, float]] = {}
    if total <= 0.0:
        return out
    for axis in OPERATING_CHANNELS:
        if not data.has(axis):
            continue
        values = data.get(axis)
        order = np.argsort(values, kind="stable")
        share = np.cumsum(energy[order]) / total
        low, high = np.searchsorted(share, [CHANCE, 1.0 - CHANCE])
        last = values.size - 1
        out[axis] = (float(values[order[min(low, last)]]), float(values[order[min(high, last)]]))
    return out
