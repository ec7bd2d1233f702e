"""Whether the channels of a vehicle's log agree with each other, as their units and signs decide."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from tire_pipeline.errors import RecordingError
from tire_pipeline.unit_definitions import DEGREE, GRAVITY, MILE

Array = NDArray[np.float64]
# No two units of one of these channels lie nearer to each other than this squared (m/s and knots: 1.94).
_UNITS_APART = 1.4
# Below these (rms) the offsets of common sensors are as large as the signal: 0.3 deg/s at 30 m/s, 0.3 deg.
_TURNS, _STEERS = 1.0, 0.005
# Below it (rms, m/s^2) the change of a lateral speed is that of its noise.
_CHANGES = 0.1
# Of the acceleration that speed and yaw rate leave, noise and roll are a part.
_CHANGES_ALIKE = 0.5
# A sideslip in degrees is 57 times that in rad.
_SIDESLIP_IN_DEGREES = 0.13
# Cosine between two channels that show the same: else one of them is noise, or is another one.
_SAME_MOTION = 0.8
# Understeer makes the road-wheel angle up to 4 times that of slow driving; steering ratios are 10 to 20.
_STEERING_WHEEL = 8.0
_AS_IF = {
    "lateral_acceleration in g": 1 / GRAVITY,
    "yaw_rate in deg/s": DEGREE,
    "speed in km/h": 1 / 3.6,
    "speed in mph": MILE / 3600,
    "speed in mm/s": 1e-3,
}


def acceleration_gain(
    measured: Array, turning: Array, changing: Sequence[Array], slips: bool
) -> float | None:
    """Measured lateral acceleration over that of the motion, or None where the vehicle hardly turns.

    Parameters
    ----------
    measured, turning : ndarray
        m/s^2; the latter is speed times yaw rate.
    changing : sequence of ndarray
        What the rest of the acceleration, the change of the lateral speed, is made of: that change itself
        where it was recorded, else what it follows from while slip is proportional to force.
    slips : bool
        Whether the lateral speed was recorded.

    Raises
    ------
    RecordingError
        They differ by what only another unit or sign explains.
    """
    channel, reference = _without(changing, measured, turning)
    gain = _gain(channel, reference, _TURNS)
    if gain is None or 1 / _UNITS_APART < gain < _UNITS_APART:
        if slips:
            _check_sideslip(measured, turning, changing[0])
        return gain
    likely = _likely_units(abs(gain))
    sign = "their signs differ (ISO 8855: yaw rate and lateral acceleration are positive to the left)"
    reasons = [r for r in (f"as with {likely}" if likely else "", sign if gain < 0 else "") if r]
    raise RecordingError(
        f"lateral_acceleration is {gain:.3g} times speed x yaw_rate, and should be about once: "
        + ("; ".join(reasons) or "one of the three has another unit"),
        todo="enter m/s, rad/s and m/s^2, in axes of ISO 8855",
    )


def _check_sideslip(measured: Array, turning: Array, changing: Array) -> None:
    """Refuse a lateral speed whose change the acceleration contradicts: of another sign, or in degrees."""
    channel, reference = _without([turning], measured, changing)
    gain = _gain(channel, reference, _CHANGES, _CHANGES_ALIKE)
    if gain is None or gain > _SIDESLIP_IN_DEGREES:
        return
    why = "it is counted to the other side" if gain < 0 else "it is in degrees"
    raise RecordingError(
        f"the lateral acceleration holds {gain:.3g} times the change of the lateral speed (or of speed x "
        f"sideslip), and should hold it about once: {why}",
        todo="enter the sideslip in rad, positive where the vehicle moves to its left (atan2(v_y, v_x))",
    )


def check_steering(steering: Array, turning: Array) -> None:
    """Refuse an angle that is none of the road wheels.

    Parameters
    ----------
    steering : ndarray
        rad.
    turning : ndarray
        Wheelbase times yaw rate over speed: what the angle is where no tire slips, rad.
    """
    gain = _gain(steering, turning, _STEERS)
    if gain is None or 0 < gain < _STEERING_WHEEL:
        return
    why = (
        "it is counted to the right, or the yaw rate is"
        if gain < 0
        else "it is in degrees, or that of the steering wheel"
    )
    raise RecordingError(
        f"`steering` is {gain:.3g} times wheelbase x yaw rate / speed: {why}",
        todo="enter the road-wheel angle in rad, positive to the left (steering-wheel angle over ratio)",
    )


def _without(others: Sequence[Array], *channels: Array) -> tuple[Array, ...]:
    """What of channels is no linear combination of others."""
    basis = np.linalg.qr(np.column_stack(others))[0]
    return tuple(channel - basis @ (basis.T @ channel) for channel in channels)


def _gain(channel: Array, reference: Array, level: float, alike: float = _SAME_MOTION) -> float | None:
    """Least squares through zero; None where the reference is small or the channel shows another thing."""
    power, own = float(np.sum(reference**2)), float(np.sum(channel**2))
    if power <= reference.size * level**2 or own == 0:
        return None
    product = float(np.sum(channel * reference))
    return product / power if abs(product) > alike * np.sqrt(power * own) else None


def _likely_units(gain: float) -> str:
    """Which channels in which units have this gain; empty if none."""
    found = [
        (abs(np.log(gain / np.prod([_AS_IF[name] for name in names]))), names)
        for count in (1, 2, 3)
        for names in combinations(_AS_IF, count)
        if sum(name.startswith("speed") for name in names) < 2
    ]
    distance, names = min(found)
    return " and ".join(names) if distance < np.log(_UNITS_APART) / 2 else ""
