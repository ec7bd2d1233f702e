"""Where and when the recording leaves the model: over time and over the operating axes, at many scales."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy

from tire_pipeline.channels import OPERATING_CHANNELS
from tire_pipeline.mismatch.discrepancy.noise import ForceNoise
from tire_pipeline.mismatch.effects.shared import INDEPENDENT_STRETCHES
from tire_pipeline.mismatch.inference.sets.answer import OPEN
from tire_pipeline.mismatch.model.channels import SMALL, largest
from tire_pipeline.mismatch.model.data import Data

Array = np.ndarray
_FLIPS = round(1.0 / OPEN**2) - 1
"""Random flips of the sweeps' signs: as many as show a chance of the square of that which decides."""


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
        The same over the mean size of the simulated force; NaN where that is small beside the largest.
    p_value : float
        Largest statistic over all axes, stretches and scales under flips of whole sweeps.
    own : float
        Part of the mean that is not there wherever the first axis of this output is the same: next to nothing
        for a channel that merely came along.
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
    data: Data, residual: dict[str, Array], noise: dict[str, ForceNoise], block: Array
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

    Returns
    -------
    list of Located
        For each axis and output the stretch with the largest difference of those with p at most 0.05,
        along the force where its size is off, else to one side; the largest difference first.
    """
    out: list[Located] = []
    for o, r in residual.items():
        for along in (True, False):
            out += _axes(data, o, r, noise[o], block, along)
    out.sort(key=lambda f: -abs(f.mean))
    return out


def _axes(
    data: Data, output: str, rest: Array, noise: ForceNoise, block: Array, along: bool
) -> list[Located]:
    """Test all stretches of all axes, and return the largest difference on each that is sure."""
    plain = rest * np.sign(data.base[output]) if along else rest
    tests = [(axis, *each) for axis in _axes_of(data) for each in _stretches(_values(data, axis))]
    chance = _chances(plain / noise.sigma, [rows for *_, rows in tests], block)
    found, places = [], []
    for axis in dict.fromkeys(axis for axis, *_ in tests):
        sure = [
            i
            for i, (name, *_, rows) in enumerate(tests)
            if name == axis and chance[i] <= OPEN and _along(rest, data.base[output], rows) == along
        ]
        if not sure:
            continue
        best = max(sure, key=lambda i: abs(float(plain[tests[i][3]].mean())))
        _, low, high, rows = tests[best]
        mean = float(plain[rows].mean())
        share = mean / _force(data, output, rows)
        found.append(Located(output, axis, low, high, mean, share, float(chance[best]), along))
        places.append(rows)
    if not found:
        return found
    first = max(found, key=lambda f: abs(f.mean))
    left = plain - _profile(_values(data, first.axis), plain)
    return [
        f if f is first else replace(f, own=float(left[rows].mean()) / f.mean)
        for f, rows in zip(found, places, strict=True)
    ]


def _axes_of(data: Data) -> list[str]:
    """Return the axes along which a recording moves."""
    time = [] if data.time is None else ["time"]
    return time + [axis for axis in OPERATING_CHANNELS if data.varies(axis)]


def _stretches(values: Array) -> list[tuple[float, float, Array]]:
    """Return stretches of an axis from one bin to half of it, each with its samples; neighbours overlap."""
    edges = np.quantile(values, np.linspace(0.0, 1.0, INDEPENDENT_STRETCHES + 1))
    out, width = [], 1
    while width <= INDEPENDENT_STRETCHES // 2:
        for k in range(0, INDEPENDENT_STRETCHES + 1 - width, max(1, width // 2)):
            low, high = float(edges[k]), float(edges[k + width])
            if high > low:
                out.append((low, high, (values >= low) & (values <= high)))
        width *= 2
    return out


def _chances(scaled: Array, stretches: list[Array], block: Array) -> Array:
    """Return for each stretch how likely flips of whole sweeps have as much in any stretch.

    Parameters
    ----------
    scaled : ndarray, shape (n,)
    stretches : list of ndarray of bool, shape (n,)
    block : ndarray of int, shape (n,)
    """
    sums = np.array([np.bincount(block, scaled * rows) for rows in stretches])
    flips = np.random.default_rng(0).choice([-1.0, 1.0], size=(_FLIPS, sums.shape[1]))
    size = np.sqrt((sums**2).sum(axis=1)) + 1e-12
    most = np.abs(flips @ (sums / size[:, None]).T).max(axis=1)
    here = np.abs(sums.sum(axis=1)) / size
    return np.asarray((1 + (most[:, None] >= here).sum(axis=0)) / (1 + _FLIPS))


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
    edges = np.unique(np.quantile(values, np.linspace(0.0, 1.0, INDEPENDENT_STRETCHES + 1)[1:-1]))
    number = np.searchsorted(edges, values)
    size = np.maximum(np.bincount(number), 1)
    return np.asarray((np.bincount(number, x) / size)[number])


def _force(data: Data, output: str, rows: Array) -> float:
    """Mean size of the simulated force, N; NaN where it is too small for a share of it to mean something."""
    size = np.abs(data.base[output])
    here = float(size[rows].mean())
    return here if here > SMALL * largest(size) else float("nan")


def everywhere(data: Data, residual: dict[str, Array], located: list[Located]) -> dict[str, float]:
    """Return the share of the force by which an output is off throughout, if that is most of the mismatch.

    Parameters
    ----------
    data : Data
    residual : dict of ndarray
        Recorded minus simulated, N.
    located : list of Located

    Returns
    -------
    dict
        Output -> gain of the force, less one, by least squares.
    """
    out = {}
    for o, r in residual.items():
        force = data.base[o]
        if not np.any(force) or not any(f.output == o and f.along_force for f in located):
            continue
        whole = float(r @ force) / float(force @ force)
        if np.sum((r - whole * force) ** 2) < 0.5 * np.sum(r**2):
            out[o] = whole
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
        low, high = np.searchsorted(share, [OPEN, 1.0 - OPEN])
        last = values.size - 1
        out[axis] = (float(values[order[min(low, last)]]), float(values[order[min(high, last)]]))
    return out
