"""What a rig, its sensors or its files do to the channels, beside the physics."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd
import scipy

UNIT_ERRORS: dict[str, dict[str, float]] = {
    "slip_angle": {"deg": 180.0 / np.pi},
    "normal_load": {"lbf": 1.0 / 4.4482216, "kN": 1e-3},
    "fy": {"lbf": 1.0 / 4.4482216, "kN": 1e-3},
}
"""Channel -> unit that it was written in by mistake -> factor on the SI value."""

UNSCALED = ("sign_convention", "unit_error", "stuck_channel")
"""Artefacts that are there or not: their strength cannot be chosen."""

ARTEFACT_GUESS: dict[str, float] = {
    "force_offset": 60.0,
    "force_gain": 0.03,
    "load_gain": 0.03,
    "load_offset": 100.0,
    "slip_angle_offset": 0.002,
    "slip_ratio_offset": 0.003,
    "camber_offset": 0.01,
    "time_delay": 0.03,
    "low_pass": 0.03,
    "crosstalk": 0.03,
    "sensor_drift": 80.0,
    "clipping": 0.1,
}
"""Strength from which the wanted one is searched."""

ARTEFACT_LIMITS: dict[str, tuple[float, float]] = {
    "force_offset": (1.0, 1000.0),
    "force_gain": (0.001, 0.3),
    "load_gain": (0.001, 0.3),
    "load_offset": (1.0, 1000.0),
    "slip_angle_offset": (1e-5, 0.03),
    "slip_ratio_offset": (1e-5, 0.03),
    "camber_offset": (5e-4, 0.04),
    "time_delay": (0.002, 0.3),
    "low_pass": (0.002, 0.3),
    "crosstalk": (0.001, 0.3),
    "sensor_drift": (1.0, 1500.0),
    "clipping": (0.005, 0.5),
}
"""Smallest and largest strength, SI (clipping: share of the largest force that is cut off)."""


@dataclass(frozen=True)
class ArtefactDetails:
    """What was drawn for an artefact beside its strength."""

    channel: str
    sign: float
    factor: float
    interval: tuple[float, float]
    end: float


def draw_details(
    name: str, rng: np.random.Generator, end: float, *, braking: bool, cambered: bool
) -> ArtefactDetails:
    """Draw the channel, direction and time of an artefact.

    Parameters
    ----------
    name : str
        One of ``names.ARTEFACTS``.
    rng : numpy.random.Generator
    end : float
        Length of the recording, s.
    braking, cambered : bool
        Whether the schedule moves the slip ratio and the camber.
    """
    channel = "fy"
    factor = 1.0
    if name == "sign_convention":
        channel = str(rng.choice(["slip_angle", "fy"] + (["fx"] if braking else [])))
    elif name == "unit_error":
        channel = str(rng.choice(list(UNIT_ERRORS)))
        factor = float(rng.choice(list(UNIT_ERRORS[channel].values())))
    elif name == "stuck_channel":
        channel = str(rng.choice(["normal_load", "fy", "slip_angle"]))
    elif name == "crosstalk":
        channel = "fy" if braking and rng.random() < 0.5 else "fx"
    elif name in ("slip_angle_offset", "slip_ratio_offset", "camber_offset"):
        channel = name.removesuffix("_offset")
    elif name in ("load_gain", "load_offset"):
        channel = "normal_load"
    start = float(rng.uniform(0.3, 0.6)) * end
    stop = start + float(rng.uniform(0.2, 0.4)) * end
    return ArtefactDetails(channel, float(rng.choice([-1.0, 1.0])), factor, (start, stop), end)


def apply_artefact(
    frame: pd.DataFrame,
    name: str,
    strength: float,
    details: ArtefactDetails,
    largest: Mapping[str, float],
) -> pd.DataFrame:
    """Return the recording with the artefact in it.

    Parameters
    ----------
    frame : pandas.DataFrame
        Canonical channels, SI.
    name : str
        One of ``names.ARTEFACTS``.
    strength : float
        In the unit of the channel; s for a delay or filter; a share for gain, crosstalk, clipping.
    details : ArtefactDetails
    largest : mapping
        Largest absolute force of each output, N (where clipping starts to count).
    """
    out = frame.copy()
    channel, signed = details.channel, strength * details.sign
    time = out["time"].to_numpy()
    x = out[channel].to_numpy()
    if name.endswith("_offset"):
        out[channel] = x + signed
    elif name in ("force_gain", "load_gain"):
        out[channel] = x * (1.0 + signed)
    elif name == "time_delay":
        for force in ("fx", "fy"):
            out[force] = np.interp(time - strength, time, out[force].to_numpy())
    elif name == "low_pass":
        for force in ("fx", "fy"):
            out[force] = low_pass(out[force].to_numpy(), strength, float(time[1] - time[0]))
    elif name == "crosstalk":
        other = "fx" if channel == "fy" else "fy"
        out[channel] = x + signed * out[other].to_numpy()
    elif name == "sensor_drift":
        out[channel] = x + signed * time / details.end
    elif name == "sign_convention":
        out[channel] = -x
    elif name == "unit_error":
        out[channel] = x * details.factor
    elif name == "clipping":
        level = largest[channel] * (1.0 - strength)
        out[channel] = np.clip(x, -level, level)
    elif name == "stuck_channel":
        inside = (time >= details.interval[0]) & (time < details.interval[1])
        if inside.any():
            out[channel] = np.where(inside, x[np.argmax(inside)], x)
    else:
        raise ValueError(f"{name!r} is not an artefact")
    return out


def low_pass(x: np.ndarray, constant: float, dt: float) -> np.ndarray:
    """Return a signal behind two equal first-order filters.

    Parameters
    ----------
    x : ndarray, shape (n,)
    constant : float
        Time constant of both together, s.
    dt : float
        Time from one sample to the next, s.

    Returns
    -------
    ndarray, shape (n,)
    """
    b = 1.0 - np.exp(-2.0 * dt / constant)
    for _ in range(2):
        x, _state = scipy.signal.lfilter([b], [1.0, b - 1.0], x, zi=[(1.0 - b) * x[0]])
    return np.asarray(x)
