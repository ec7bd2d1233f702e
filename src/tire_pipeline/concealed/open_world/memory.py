"""Operators with a memory that several mechanisms are made of."""

import numpy as np
from scipy.signal import lfilter


def play(values: np.ndarray, width: float) -> np.ndarray:
    """Play (backlash) operator, (n,): stays until `values` has left it by half the width."""
    out = np.empty_like(values)
    at = float(values[0])
    for i, value in enumerate(values):
        at = min(max(at, value - 0.5 * width), value + 0.5 * width)
        out[i] = at
    return out


def lagged(values: np.ndarray, step: float, seconds: float) -> np.ndarray:
    """First-order lag with a time constant, at rest at the first value, (n,)."""
    keep = np.exp(-step / seconds)
    return values[0] + np.asarray(lfilter([1.0 - keep], [1.0, -keep], values - values[0]))


def resonance(values: np.ndarray, step: float, hertz: float, damping: float) -> np.ndarray:
    """A mass on a spring that follows `values`, at rest at the first: bilinear, gain one, (n,)."""
    r = 2.0 / (step * 2.0 * np.pi * hertz)
    back = np.array([1.0 + 2.0 * damping * r + r**2, 2.0 - 2.0 * r**2, 1.0 - 2.0 * damping * r + r**2])
    return values[0] + np.asarray(
        lfilter(np.array([1.0, 2.0, 1.0]) / back[0], back / back[0], values - values[0])
    )


def asymmetric(values: np.ndarray, step: float, up: float, down: float) -> np.ndarray:
    """A state that follows `values` with one time constant upwards and another downwards, from zero, (n,)."""
    out = np.empty_like(values)
    at = 0.0
    rise, fall = 1.0 - np.exp(-step / up), 1.0 - np.exp(-step / down)
    for i, value in enumerate(values):
        at += (rise if value > at else fall) * (value - at)
        out[i] = at
    return out


def bouc_wen(values: np.ndarray, scale: float) -> np.ndarray:
    """Hysteresis of Bouc and Wen without units, -1 to 1, driven by changes of `values` over `scale`, (n,).

    z' = x' (1 - |z| (0.5 sign(x' z) + 0.5)): Wen, Method for random vibration of hysteretic systems, J. Eng.
    Mech. Div. ASCE 102 (1976) 249.
    """
    out = np.zeros_like(values)
    z = 0.0
    for i in range(1, values.size):
        moved = (values[i] - values[i - 1]) / scale
        z += moved * (1.0 - abs(z) * (0.5 * np.sign(moved * z) + 0.5))
        z = min(max(z, -1.0), 1.0)
        out[i] = z
    return out
