"""Filters, states and names that several effects use."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numba import njit

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.magic_formula.parameters.assumed_radius import ASSUMED_RADIUS

GAINS = (-0.8, 2.0)
"""Least and largest gain that a force channel may be wrong by."""

LONGEST_DELAY = 0.6
"""Longest time, s, by which a rig's channels may be apart and the slip still counts as driving the force."""

INDEPENDENT_STRETCHES = 20
"""What the model gets wrong is taken as independent from one of so many stretches of rows to the next."""

CLIPPED = ("fy", "fx", "slip_angle", "normal_load", "mz")
"""Channels in which clipping is looked for."""


@njit(cache=True)
def first_order(signal: np.ndarray, step: np.ndarray, start: np.ndarray) -> np.ndarray:
    """Follow ``signal`` with a first-order lag; start again where ``start``.

    Parameters
    ----------
    signal : ndarray, shape (n,)
    step : ndarray, shape (n,)
        ``dt / lag`` of the step that ends at each sample; infinite without a lag.
    start : ndarray of bool, shape (n,)
        True at the first sample of each uninterrupted piece.

    Returns
    -------
    ndarray, shape (n,)
        Piecewise-linear input, exact at the samples up to second order in the step.
    """
    out = np.empty_like(signal)
    previous = 0.0
    for i in range(signal.size):
        if start[i]:
            previous = signal[i]
        else:
            gain = -np.expm1(-step[i])
            previous = previous + gain * (_ramp(signal[i - 1], signal[i], step[i], gain) - previous)
        out[i] = previous
    return out


@njit(cache=True)
def play(x: np.ndarray, width: float, start: np.ndarray) -> np.ndarray:
    """Return what is behind a joint with play: it moves only when pushed.

    Parameters
    ----------
    x : ndarray, shape (n,)
    width : float
        Half of the play, in the unit of ``x``.
    start : ndarray of bool, shape (n,)
        First samples of uninterrupted pieces.
    """
    out = np.empty_like(x)
    at = 0.0
    for i in range(x.size):
        if start[i]:
            at = x[i]
        at = min(max(at, x[i] - width), x[i] + width)
        out[i] = at
    return out


def settling_lags(span: float) -> tuple[float, float]:
    """Return lags, s, with which a change settles early or late in a recording of so many seconds."""
    return span / 12.0, span / 3.0


@njit(cache=True)
def _ramp(before: float, now: float, step: float, gain: float) -> float:
    """Constant input that has the same effect over one step as a ramp from before to now."""
    share = 1.0 / gain - 1.0 / step if step > 1e-6 else 0.5
    return now - (now - before) * (1.0 - share)


@njit(cache=True)
def harmonic_power(signal: np.ndarray, way: np.ndarray, first: float, step: float, count: int) -> np.ndarray:
    """Return ``|sum(signal exp(-i way k))|`` at the wave numbers ``first, first + step, ...``.

    Parameters
    ----------
    signal, way : ndarray, shape (n,)
    first, step : float
        Radians a unit of way.
    count : int

    Returns
    -------
    ndarray, shape (count,)
    """
    total = np.zeros(count, dtype=np.complex128)
    for i in range(signal.size):
        now = signal[i] * np.exp(-1j * way[i] * first)
        turn = np.exp(-1j * way[i] * step)
        for k in range(count):
            total[k] += now
            now *= turn
    return np.abs(total)


def delayed(time: np.ndarray, signal: np.ndarray, delay: float, start: np.ndarray) -> np.ndarray:
    """Return ``signal(time - delay)`` by linear interpolation, held at the ends of each piece."""
    firsts = np.flatnonzero(start)
    if firsts.size <= 1:
        return np.interp(time - delay, time, signal)
    out = np.empty_like(signal)
    ends = np.append(firsts[1:], time.size)
    for first, last in zip(firsts, ends, strict=True):
        piece = slice(first, last)
        out[piece] = np.interp(time[piece] - delay, time[piece], signal[piece])
    return out


def safe_log1p(x: np.ndarray | float) -> np.ndarray | float:
    """Return ``log(1 + x)`` with ``1 + x`` kept above 0.05."""
    return np.log(np.maximum(1.0 + np.asarray(x), 0.05))


def beyond_known(load: np.ndarray, known: tuple[float, float]) -> bool:
    """Whether some loads lie farther outside of the range that a file states than that range is wide.

    No tire's friction and stiffness are known so far from the loads they were fitted to (Pacejka, 3rd ed.,
    4.3.2: PDY2 and PKY2 take several loads).

    Parameters
    ----------
    load : ndarray, shape (n,)
        Normal load, N.
    known : (low, high)
        Least and largest load that the file holds for, N.
    """
    low, high = known
    return bool(max(low - np.min(load), np.max(load) - high) > high - low)


def relaxation_lengths(tire: TireModel) -> dict[str, float]:
    """Return the relaxation lengths of a tire model at its nominal load, by the model's own formula.

    Parameters
    ----------
    tire : TireModel

    Returns
    -------
    dict
        ``slip_angle`` and ``slip_ratio`` -> m; with ``ASSUMED_RADIUS`` where the model has no radius.
    """
    c = tire.coefficients
    radius = c.get("UNLOADED_RADIUS", ASSUMED_RADIUS)
    outputs = {"slip_angle": "relaxation_lateral", "slip_ratio": "relaxation_longitudinal"}
    found = tire.replace(UNLOADED_RADIUS=radius).forces(
        normal_load=c["FNOMIN"], limits="ignore", outputs=tuple(outputs.values())
    )
    return {slip: float(getattr(found, output)) for slip, output in outputs.items()}


def lengths_in_words(lengths: Mapping[str, float]) -> str:
    """Return relaxation lengths, m, with their slips.

    Examples
    --------
    >>> lengths_in_words({"slip_angle": 0.6512, "slip_ratio": 0.32})
    '0.65 m of slip_angle and 0.32 m of slip_ratio'
    """
    return " and ".join(f"{length:.2g} m of {slip}" for slip, length in lengths.items())


def scaled(coefficients: Mapping[str, float], factors: Mapping[str, float]) -> dict[str, float]:
    """Return scale factors of a file (LMUX, LKY ...), each times its factor."""
    return {name: coefficients.get(name, 1.0) * factor for name, factor in factors.items()}


def in_both_forms(zero: Mapping[str, float], form: str) -> list[dict[str, float]]:
    """Return where a search starts if an effect has two forms: ``form`` is 0 or 1."""
    return [{**zero, form: value} for value in (0.0, 1.0)]


def own_relaxation(tire: TireModel) -> dict[str, float] | None:
    """Return the relaxation lengths that the file itself states, m."""
    c = tire.coefficients
    missing = getattr(tire, "defaulted", {})
    stated = set()
    if c.get("PTY1", 0.0) > 0.0 and "PTY1" not in missing and c.get("PTY2", 0.0) > 0.0:
        stated.add("slip_angle")
    if c.get("PTX1", 0.0) > 0.0 and "PTX1" not in missing:
        stated.add("slip_ratio")
    if not stated:
        return None
    return {slip: length for slip, length in relaxation_lengths(tire).items() if slip in stated}
