"""Causes in the load cell and behind it: each function takes forces (3, n) and gives what is stored."""

import numpy as np
from scipy.signal import lfilter

from tire_pipeline.concealed.second.draws import Draw
from tire_pipeline.concealed.second.roll import Course

LEVER = 0.05  # m, with which a force leaks into the moment
UNITS = (0.2248089, 0.2248089, 0.7375621)  # lbf, lbf, ft lbf


def _changed(forces: np.ndarray, channel: int, values: np.ndarray) -> np.ndarray:
    out = forces.copy()
    out[channel] = values
    return out


def offset(forces: np.ndarray, course: Course, size: float, draw: Draw) -> np.ndarray:
    """Zero off by a part of the channel's RMS."""
    return _changed(forces, draw.channel, forces[draw.channel] + draw.sign * size * draw.scales[draw.channel])


def gain(forces: np.ndarray, course: Course, size: float, draw: Draw) -> np.ndarray:
    """Gain off by a part of it."""
    return _changed(forces, draw.channel, forces[draw.channel] * (1.0 + draw.sign * size))


def leak(forces: np.ndarray, course: Course, size: float, draw: Draw) -> np.ndarray:
    """A part of one channel added to another: fy into fx, fx into fy, fy into mz on a lever."""
    source = (1, 0, 1)[draw.channel]
    arm = LEVER if draw.channel == 2 else 1.0
    return _changed(forces, draw.channel, forces[draw.channel] + draw.sign * size * arm * forces[source])


def leak_load(forces: np.ndarray, course: Course, size: float, draw: Draw) -> np.ndarray:
    """A part of the normal load added to a channel."""
    arm = LEVER if draw.channel == 2 else 1.0
    return _changed(forces, draw.channel, forces[draw.channel] + draw.sign * size * arm * course.normal_load)


def delay(forces: np.ndarray, course: Course, size: float, draw: Draw) -> np.ndarray:
    """All forces late by a time in s."""
    return np.stack([np.interp(course.time - size, course.time, force) for force in forces])


def smooth(forces: np.ndarray, course: Course, size: float, draw: Draw) -> np.ndarray:
    """All forces through a first-order filter with a time constant in s."""
    keep = np.exp(-(course.time[1] - course.time[0]) / size) if size > 0.0 else 0.0
    first = forces[:, :1]
    return first + np.asarray(lfilter([1.0 - keep], [1.0, -keep], forces - first, axis=1))


def clip(forces: np.ndarray, course: Course, size: float, draw: Draw) -> np.ndarray:
    """The channel ends at its largest magnitude less a part of it."""
    values = forces[draw.channel]
    limit = (1.0 - size) * float(np.max(np.abs(values)))
    return _changed(forces, draw.channel, np.clip(values, -limit, limit))


def coarsen(forces: np.ndarray, course: Course, size: float, draw: Draw) -> np.ndarray:
    """Steps of a part of the channel's RMS."""
    values = forces[draw.channel]
    step = size * draw.scales[draw.channel]
    return _changed(forces, draw.channel, step * np.round(values / step) if step > 0.0 else values)


def drift(forces: np.ndarray, course: Course, size: float, draw: Draw) -> np.ndarray:
    """Zero that leaves by a part of the channel's RMS, first quickly and then slowly, as a cell warms up."""
    share = course.time / course.time[-1]
    wandered = (1.0 - np.exp(-2.0 * share)) / (1.0 - np.exp(-2.0))
    shift = draw.sign * size * draw.scales[draw.channel] * wandered
    return _changed(forces, draw.channel, forces[draw.channel] + shift)


def mistake_unit(forces: np.ndarray, course: Course, size: float, draw: Draw) -> np.ndarray:
    """The channel in pounds-force or foot-pounds instead of N or N m."""
    return _changed(forces, draw.channel, forces[draw.channel] * UNITS[draw.channel])
