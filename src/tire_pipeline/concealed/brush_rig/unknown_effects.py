"""Effects that no catalogue entry describes; they must end as *unexplained*.

``slip_rate``, ``load_rate`` and ``friction_memory`` live in the brush itself (``brush._contact``);
the others act on the slip angle before the tire or on the forces after it.
"""

from __future__ import annotations

import numpy as np
import scipy
from numba import njit

UNKNOWN_GUESS: dict[str, float] = {
    "backlash": 0.003,
    "stick_slip": 80.0,
    "load_rate": 0.1,
    "slip_rate": 0.05,
    "drum_seam": 80.0,
    "rig_resonance": 0.5,
    "friction_memory": 0.05,
    "quantisation": 150.0,
}
"""Strength from which the wanted one is searched."""

UNKNOWN_LIMITS: dict[str, tuple[float, float]] = {
    "backlash": (1e-4, 0.03),
    "stick_slip": (1.0, 3000.0),
    "load_rate": (0.002, 0.9),
    "slip_rate": (0.002, 0.7),
    "drum_seam": (1.0, 4000.0),
    "rig_resonance": (0.01, 3.0),
    "friction_memory": (0.002, 0.6),
    "quantisation": (5.0, 4000.0),
}
"""Smallest and largest strength (rad, N or a share)."""


@njit(cache=True)
def play(angle: np.ndarray, width: float) -> np.ndarray:
    """Angle behind a joint with play: it moves only when the joint's edge pushes it, rad."""
    out = np.empty_like(angle)
    at = angle[0]
    for i in range(angle.shape[0]):
        at = min(max(at, angle[i] - width), angle[i] + width)
        out[i] = at
    return out


def act_on_forces(
    name: str,
    strength: float,
    *,
    time: np.ndarray,
    slip_angle: np.ndarray,
    normal_load: np.ndarray,
    speed: np.ndarray,
    fy: np.ndarray,
    character: np.ndarray,
    nominal_load: float,
) -> np.ndarray:
    """Return fy, N, with an effect that acts behind the tire.

    Parameters
    ----------
    name : str
        "stick_slip", "drum_seam", "rig_resonance" or "quantisation"; others pass unchanged.
    strength : float
    time, slip_angle, normal_load, speed, fy : ndarray, shape (n,)
        s, rad, N, m/s, N.
    character : ndarray, shape (4,)
        Numbers in 0..1 drawn for the case: frequencies, thresholds and phases.
    nominal_load : float
        N.
    """
    dt = float(time[1] - time[0])
    if name == "stick_slip":
        frequency = 6.0 + 9.0 * character[0] + 0.6 * np.sin(0.9 * time)
        wave = np.sin(2.0 * np.pi * np.cumsum(frequency) * dt + character[3])
        slid = np.abs(slip_angle) - (0.07 + 0.04 * character[1])
        growing = scipy.signal.lfilter([0.1], [1.0, -0.9], np.clip(slid / 0.02, 0.0, 1.0))
        return fy + strength * growing * wave * normal_load / nominal_load
    if name == "drum_seam":
        round_the_drum = np.cumsum(speed) * dt / (4.0 + 6.0 * character[0]) + character[3]
        bump = np.exp(-0.5 * (((round_the_drum % 1.0) - 0.5) / 0.06) ** 2)
        return fy + strength * bump * normal_load / nominal_load
    if name == "rig_resonance":
        return fy + strength * _ring(fy, 4.0 + 5.0 * character[0], 0.05, dt)
    if name == "quantisation":
        return np.round(fy / strength) * strength
    return fy


def _ring(force: np.ndarray, frequency: float, damping: float, dt: float) -> np.ndarray:
    """What a lightly damped mode of the rig adds to a force: its high-passed answer, N."""
    w = 2.0 * np.pi * frequency
    system = ([1.0, 0.0, 0.0], [1.0, 2.0 * damping * w, w * w])
    b, a, _ = scipy.signal.cont2discrete(system, dt, method="bilinear")
    return np.asarray(scipy.signal.lfilter(np.ravel(b), a, force - force[0]))
