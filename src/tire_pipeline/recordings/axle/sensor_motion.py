"""A vehicle's planar motion from its own sensors: speed, yaw rate, lateral acceleration."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings.axle.body_motion import BodyMotion, EvenDrive, even_drive, fast_and_good
from tire_pipeline.recordings.axle.kinematics import acceleration_gain
from tire_pipeline.recordings.axle.smoothing import Smoother, white_noise_std
from tire_pipeline.recordings.axle.vehicle import Vehicle
from tire_pipeline.recordings.conventions.drive_columns import MOTION_CHANNELS
from tire_pipeline.unit_definitions import GRAVITY

Array = NDArray[np.float64]
# Straight running: below these the lateral speed is taken as zero.
_STRAIGHT_YAW_RATE, _STRAIGHT_ACCELERATION, _STRAIGHT_SECONDS = 0.02, 0.2, 0.5
_INTEGRATED = "lateral speed integrated between stretches of straight running; road bank is taken as zero"
_LEANING_UNKNOWN = (
    "without the lateral speed nothing tells whether lateral_acceleration leans with the body, which adds "
    "up to a sixth to fy: Vehicle.roll_gradient, or a sensor that is kept level"
)
# A wheel's circumference, on which a speed rests, is hardly known better.
_GAIN_NOTED = 0.02


def from_sensors(drive: pd.DataFrame, vehicle: Vehicle, bandwidth: float) -> BodyMotion:
    """Smooth the vehicle's own sensors, all taken to sit at the marker's place.

    Parameters
    ----------
    drive : DataFrame
        `time` s, `speed` m/s, `yaw_rate` rad/s, `lateral_acceleration` m/s^2; optional
        `longitudinal_acceleration` m/s^2, `lateral_speed` m/s or `sideslip` rad. Without the
        last two the lateral speed is integrated between stretches of straight running, and its
        uncertainty grows with the distance in time from them.
    vehicle : Vehicle
    bandwidth : float
        Half-power frequency, Hz.

    Raises
    ------
    RecordingError
        A required column is missing, or the lateral speed cannot be computed.
    """
    lacking = [name for name in MOTION_CHANNELS if name not in drive]
    if lacking:
        raise RecordingError(
            f"the drive has neither a pose nor {', '.join(lacking)}",
            todo="add x, y, yaw or speed, yaw_rate, lateral_acceleration",
        )
    even = even_drive(drive, MOTION_CHANNELS, bandwidth)
    log = _log_of(even, vehicle)
    table, smoother, speed, rate, ay, stds = even.table, even.smoother, log.speed, log.rate, log.ay, log.stds
    keep, slope = smoother.gain(0, 0), smoother.gain(0, 1)
    vy, vy_std, how = _lateral_speed(log, vehicle)
    turning, vx = smoother.smooth(rate), smoother.smooth(speed)
    if "longitudinal_acceleration" in table:
        raw, left = _filled(table["longitudinal_acceleration"]), vehicle.marker_lateral
        ax = smoother.smooth(raw) + left * smoother.smooth(rate, 1)
        ax_std = np.hypot(white_noise_std(raw) * keep, left * stds[1] * slope)
    else:
        ax = smoother.smooth(speed, 1) - turning * vy
        ax_std = stds[0] * slope
    lateral = smoother.smooth(ay)
    used = fast_and_good(vx, even.good)
    gain, said = _gain_of(lateral, turning, vx, vy if how != _INTEGRATED else None, smoother, used, vehicle)
    notes = [*even.notes, how + _not_used(table, how), *said]
    one = np.ones_like(speed)
    return BodyMotion(
        time=table["time"].to_numpy(dtype=float),
        ahead=vehicle.marker_offset,
        vx=vx,
        vy=vy,
        yaw_rate=turning,
        yaw_acceleration=smoother.smooth(rate, 1),
        ax=ax,
        ay=lateral,
        vx_std=one * stds[0] * keep,
        vy_std=vy_std,
        yaw_rate_std=one * stds[1] * keep,
        yaw_acceleration_std=one * stds[1] * slope,
        ax_std=one * ax_std,
        ay_std=one * stds[2] * keep,
        good=even.good,
        smoother=smoother,
        noise=dict(zip(("speed_std", "yaw_rate_std", "ay_std"), stds, strict=True)),
        notes=notes,
        ay_gain_std=abs(gain - 1.0),
    )


@dataclass(frozen=True)
class _Log:
    """A vehicle's log on an even time line, as of a point on the middle line that stays upright.

    Parameters
    ----------
    table : pandas.DataFrame
        As recorded.
    smoother : Smoother
    recorded : ndarray, shape (n,)
        Speed where the sensor is, m/s.
    speed, rate, ay : ndarray, shape (n,)
        Speed, m/s; yaw rate, rad/s; lateral acceleration, m/s^2.
    stds : tuple of float
        Standard deviations of the white noise of the three.
    """

    table: pd.DataFrame
    smoother: Smoother
    recorded: Array
    speed: Array
    rate: Array
    ay: Array
    stds: tuple[float, float, float]


def _log_of(even: EvenDrive, vehicle: Vehicle) -> _Log:
    """Move a log to the vehicle's middle line and set it upright.

    A point beside it turns on another circle, and a sensor that leans with the body feels a part of gravity.
    """
    recorded, rate, ay = (_filled(even.table[name]) for name in MOTION_CHANNELS)
    noise = [white_noise_std(s) for s in (recorded, rate, ay)]
    left, felt = vehicle.marker_lateral, vehicle.felt_acceleration
    speed, lateral = recorded + left * rate, ay / felt + left * rate**2
    stds = (float(np.hypot(noise[0], left * noise[1])), noise[1], noise[2] / felt)
    return _Log(even.table, even.smoother, recorded, speed, rate, lateral, stds)


def _gain_of(
    lateral: Array,
    turning: Array,
    vx: Array,
    vy: Array | None,
    smoother: Smoother,
    used: NDArray[np.bool_],
    vehicle: Vehicle,
) -> tuple[float, list[str]]:
    """Lateral acceleration over that of the motion (1 where nothing tells it), and what is said of it."""
    follows = [turning, vx**2 * turning] if vy is None else [vy]
    changing = [np.gradient(part, smoother.dt)[used] for part in follows]
    gain = acceleration_gain(lateral[used], (turning * vx)[used], changing, vy is not None)
    if vy is None:
        return 1.0, [_LEANING_UNKNOWN]
    if gain is None:
        return 1.0, []
    return gain, [_gain_in_words(gain, vehicle)] if abs(gain - 1.0) > _GAIN_NOTED else []


def _not_used(table: pd.DataFrame, how: str) -> str:
    """What is to be said of a slip angle that the log holds; empty if none."""
    if how != _INTEGRATED or "slip_angle" not in table:
        return ""
    return "; its slip_angle is not used: if that is the vehicle's sideslip, name it `sideslip`"


def _drift_of_a_step(anchors: NDArray[np.intp], drift: Array) -> float:
    """Standard deviation of the integral's error from one sample to the next, m/s, from what the turns leave.

    Where the vehicle runs straight again the integral should be what it was: what it is off by is the sum of
    leaning, bank, bias and gain of the sensors over the turn.
    """
    steps = np.diff(anchors)
    turns = steps > 1
    if not turns.any():
        return 0.0
    return float(np.sqrt(np.sum(np.diff(drift)[turns] ** 2) / np.sum(steps[turns])))


def _gain_in_words(gain: float, vehicle: Vehicle) -> str:
    """What a lateral acceleration means that is not that of the motion."""
    rolls = np.degrees(gain * vehicle.felt_acceleration - 1.0)
    reason = (
        f"a sensor that leans with a body that rolls by {rolls:.1f} deg per g "
        f"(Vehicle.roll_gradient={np.radians(rolls) / GRAVITY:.2g}), a banked road, "
        if rolls > 0
        else "a banked road, "
    )
    return (
        f"lateral_acceleration is {gain:.3f} times what speed and yaw_rate give: {reason}"
        "or a gain or offset of a sensor. fy is off by as much, and fy_std holds that"
    )


def _filled(column: pd.Series) -> Array:
    values = column.to_numpy(dtype=float)
    here = np.flatnonzero(np.isfinite(values))
    if here.size == 0:
        raise RecordingError(f"`{column.name}` holds no number", todo="check the column")
    return np.asarray(np.interp(np.arange(values.size), here, values[here]))


def _lateral_speed(log: _Log, vehicle: Vehicle) -> tuple[Array, Array, str]:
    """Return the lateral speed, its standard deviation and where it comes from."""
    table, recorded, smoother = log.table, log.recorded, log.smoother
    for name in ("lateral_speed", "sideslip"):
        if name in table:
            raw = _filled(table[name])
            std = white_noise_std(raw) * smoother.gain(0, 0)
            if name == "lateral_speed":
                return smoother.smooth(raw), std * np.ones_like(raw), "lateral_speed as recorded"
            moving = np.abs(raw[np.abs(recorded) >= 0.5 * np.abs(recorded).max()])
            if np.quantile(moving, 0.98) > np.pi / 2:
                raise RecordingError(
                    f"`sideslip` reaches {np.quantile(moving, 0.98):.3g} rad", todo="enter rad, not degrees"
                )
            value = smoother.smooth(recorded * np.tan(raw))
            return value, std * np.abs(recorded), "lateral speed from the recorded sideslip"
    return *_integrated(log, vehicle), _INTEGRATED


def _integrated(log: _Log, vehicle: Vehicle) -> tuple[Array, Array]:
    """Lateral speed from the acceleration, anchored where the vehicle runs straight, and its deviation."""
    speed, rate, ay, smoother, stds = log.speed, log.rate, log.ay, log.smoother, log.stds
    # Where nothing turns fast the rear axle hardly slips.
    straight_vy = vehicle.marker_offset * smoother.smooth(rate)
    dt = smoother.dt
    steady = np.abs(smoother.smooth(rate)) < _STRAIGHT_YAW_RATE
    steady &= np.abs(smoother.smooth(ay)) < _STRAIGHT_ACCELERATION
    width = max(1, round(_STRAIGHT_SECONDS / dt))
    straight = np.convolve(steady, np.ones(width), "same") >= width - 0.5
    if not straight.any():
        raise RecordingError(
            "no stretch of straight running, so the lateral speed cannot be integrated"
            + _not_used(log.table, _INTEGRATED),
            todo="add the pose, lateral_speed or sideslip, or record straight running too",
        )
    anchors = np.flatnonzero(straight)
    raw = np.concatenate([[0.0], np.cumsum((ay - rate * speed)[1:] * dt)])
    # The drift is a straight line from one anchor to the next: a constant sensor offset.
    drift = (raw - straight_vy)[anchors]
    value = raw - np.interp(np.arange(raw.size), anchors, drift)
    index = np.arange(raw.size)
    before = np.maximum.accumulate(np.where(straight, index, -1))
    after = np.minimum.accumulate(np.where(straight, index, raw.size)[::-1])[::-1]
    near_before, near_after = (index - before).astype(float), (after - index).astype(float)
    near_before[before < 0] = np.inf
    near_after[after == raw.size] = np.inf
    gap = near_before + near_after
    with np.errstate(invalid="ignore"):
        steps = np.where(np.isfinite(gap), near_before * near_after / np.maximum(gap, 1), 0)
    steps = np.where(np.isfinite(gap), steps, np.minimum(near_before, near_after))
    one_step = np.hypot(dt * np.hypot(stds[2], np.abs(speed) * stds[1]), _drift_of_a_step(anchors, drift))
    return smoother.smooth(value), one_step * np.sqrt(steps)
