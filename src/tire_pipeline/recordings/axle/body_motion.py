"""A vehicle's planar motion at one point of it, from its pose or from its own sensors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings.axle.smoothing import (
    Smoother,
    make_smoother,
    reached_by_gap,
    white_noise_std,
)
from tire_pipeline.recordings.axle.vehicle import Vehicle

Array = NDArray[np.float64]
# Missing samples in a row that a straight line fills; longer ones are cut out.
FILLED_SAMPLES = 2
# Share of the largest speed below which samples are left out.
SHARE_OF_SPEED_KEPT = 1 / 6


@dataclass(frozen=True)
class BodyMotion:
    """Motion of the reference point, ISO vehicle axes (x ahead, y left, yaw rate to the left).

    All arrays have one entry a sample. `*_std` are standard deviations of independent noise.

    Parameters
    ----------
    time : ndarray
        s, evenly spaced.
    ahead : float
        Distance of the reference point ahead of the rear axle, m.
    vx, vy, yaw_rate, yaw_acceleration, ax, ay : ndarray
        m/s, m/s, rad/s, rad/s^2, m/s^2, m/s^2.
    good : ndarray of bool
        False where a sample rests on missing data.
    ay_gain_std : float
        Standard uncertainty of a factor on `ay`, the same throughout.
    """

    time: Array
    ahead: float
    vx: Array
    vy: Array
    yaw_rate: Array
    yaw_acceleration: Array
    ax: Array
    ay: Array
    vx_std: Array
    vy_std: Array
    yaw_rate_std: Array
    yaw_acceleration_std: Array
    ax_std: Array
    ay_std: Array
    good: NDArray[np.bool_]
    smoother: Smoother
    noise: dict[str, float]
    notes: list[str]
    ay_gain_std: float = 0.0


def fast_and_good(vx: Array, good: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the samples that rest on no missing data and are fast enough to be kept."""
    return good & (vx > SHARE_OF_SPEED_KEPT * np.quantile(vx, 0.99))


def evenly_spaced(drive: pd.DataFrame) -> tuple[pd.DataFrame, float, list[str]]:
    """Put a drive on an even time base; samples that are not there become NaN.

    Returns
    -------
    drive : DataFrame
    dt : float
        Sample interval, s.
    notes : list of str
    """
    if "time" not in drive:
        raise RecordingError("the drive has no time", todo="add a column `time` in s")
    time = drive["time"].to_numpy(dtype=float)
    order = np.flatnonzero(np.isfinite(time))
    if order.size < 20:
        raise RecordingError(f"the drive has {order.size} samples", todo="at least 20 are needed")
    if (np.diff(time[order]) < 0).any():
        raise RecordingError("the drive's time runs backwards", todo="sort or split it first")
    steps = np.diff(time[order])
    if not (steps > 0).any():
        raise RecordingError("the drive's time stands still", todo="check the time column")
    dt = float(np.median(steps[steps > 0]))
    # The median of jittery stamps is slightly off: refine it on the whole length.
    frames = np.round((time[order] - time[order[0]]) / dt)
    if frames[-1] > 20 * order.size:
        raise RecordingError(
            "over 95% of the samples are missing on an even time base", todo="split the drive"
        )
    dt = float(np.polyfit(frames, time[order], 1)[0]) if frames[-1] > 0 else dt
    frames = np.round((time[order] - time[order[0]]) / dt).astype(np.int64)
    notes: list[str] = []
    off = np.abs(time[order] - time[order[0]] - frames * dt)
    if np.quantile(off, 0.95) > 0.2 * dt:
        notes.append(
            f"time stamps scatter by {np.quantile(off, 0.95):.2g} s around an even {dt:.4g} s; "
            "each sample is put on the nearest even instant"
        )
    _, first = np.unique(frames, return_index=True)
    table = drive.iloc[order[first]].set_index(frames[first])
    table = table.reindex(np.arange(frames[-1] + 1))
    table["time"] = time[order[0]] + np.arange(frames[-1] + 1) * dt
    return table.reset_index(drop=True), dt, notes


@dataclass(frozen=True)
class EvenDrive:
    """A drive on an even time base, with its smoother.

    Attributes
    ----------
    table : DataFrame
    smoother : Smoother
    missing : ndarray of bool
        Where a needed channel has no number.
    good : ndarray of bool
        False where the smoother reaches a gap, or beyond an end of the drive.
    notes : list of str
    """

    table: pd.DataFrame
    smoother: Smoother
    missing: NDArray[np.bool_]
    good: NDArray[np.bool_]
    notes: list[str]


def even_drive(drive: pd.DataFrame, needed: Sequence[str], bandwidth: float) -> EvenDrive:
    """Put a drive on an even time base, and say where its needed channels can be smoothed.

    Parameters
    ----------
    drive : DataFrame
    needed : sequence of str
        Channels.
    bandwidth : float
        Half-power frequency of the smoothing, Hz.

    Raises
    ------
    RecordingError
        The drive is too short, or no sample has all needed channels.
    """
    table, dt, notes = evenly_spaced(drive)
    smoother = make_smoother(dt, bandwidth)
    if len(table) <= 2 * smoother.long:
        raise RecordingError(
            f"{len(table)} samples are too few for a bandwidth of {bandwidth:g} Hz",
            todo=f"at least {2 * smoother.long + 1} are needed",
        )
    missing = ~np.isfinite(table[list(needed)].to_numpy(dtype=float)).all(axis=1)
    if missing.all():
        raise RecordingError(
            f"the drive holds no finite sample of {', '.join(needed)}", todo="check these columns"
        )
    good = ~reached_by_gap(missing, smoother.reach, FILLED_SAMPLES)
    # Window ends extrapolate: cut them.
    good[: smoother.reach] = good[-smoother.reach :] = False
    return EvenDrive(table, smoother, missing, good, notes)


def from_pose(drive: pd.DataFrame, vehicle: Vehicle, bandwidth: float) -> BodyMotion:
    """Differentiate a recorded pose.

    Parameters
    ----------
    drive : DataFrame
        `time` s, `x`, `y` m, `yaw` rad (counted to the left; wrapped or not).
    vehicle : Vehicle
        Holds the marker's position and the yaw offset.
    bandwidth : float
        Half-power frequency of the smoothing, Hz.
    """
    even = even_drive(drive, ("x", "y", "yaw"), bandwidth)
    smoother, good = even.smoother, even.good
    x, y, yaw = _gaps_filled(even.table, even.missing)
    yaw = yaw + vehicle.yaw_offset
    ahead, left, turning = _seen_from_the_vehicle(x, y, yaw, smoother, vehicle)
    vx, vy, rate = (smoother.smooth(s) for s in (ahead, left, turning))
    vx_dot, vy_dot, rate_dot = (smoother.smooth(s, 1) for s in (ahead, left, turning))
    noise = PoseNoise.of(even, (x, y, yaw), (ahead, left, turning), np.hypot(vx, vy))
    position_std, yaw_std = noise.position_std, noise.yaw_std
    g0, g1, h0 = (smoother.gain(a, b) for a, b in ((1, 0), (1, 1), (0, 0)))
    vx_std, vx_dot_std = noise.more_ahead * position_std * g0, noise.more_ahead * position_std * g1
    vy_std = np.hypot(noise.more_left * position_std * g0, vx * yaw_std * h0)
    turned = noise.more_yaw * yaw_std * smoother.rotation_gain()
    ay_noise = noise.more_left * position_std * g1
    return BodyMotion(
        time=even.table["time"].to_numpy(dtype=float),
        ahead=vehicle.marker_offset,
        vx=vx,
        vy=vy,
        yaw_rate=rate,
        yaw_acceleration=rate_dot,
        ax=vx_dot - rate * vy,
        ay=vy_dot + rate * vx,
        vx_std=vx_std,
        vy_std=vy_std,
        yaw_rate_std=noise.more_yaw * yaw_std * g0,
        yaw_acceleration_std=noise.more_yaw * yaw_std * g1,
        ax_std=np.sqrt(vx_dot_std**2 + (vy * turned) ** 2 + (rate * vy_std) ** 2),
        ay_std=np.sqrt(ay_noise**2 + (vx * turned) ** 2 + (rate * vx_std) ** 2),
        good=good,
        smoother=smoother,
        noise=noise.summary(good, even.missing),
        notes=even.notes,
    )


@dataclass(frozen=True)
class PoseNoise:
    """Noise of a recorded pose, and the factor by which a smoothed speed is noisier than white noise implies.

    Attributes
    ----------
    position_std, yaw_std : float
        m, rad.
    more_ahead, more_left, more_yaw : ndarray
        Factors, one a sample.
    """

    position_std: float
    yaw_std: float
    more_ahead: Array
    more_left: Array
    more_yaw: Array

    @classmethod
    def of(
        cls, even: EvenDrive, pose: tuple[Array, ...], speeds: tuple[Array, ...], smoothed_speed: Array
    ) -> PoseNoise:
        """Measure it where the vehicle moves, in `x, y, yaw` and in speeds ahead, to the left and of yaw."""
        moving = ~even.missing & even.good & (smoothed_speed > 0.1 * smoothed_speed.max())
        stds = [white_noise_std(np.where(moving, s, np.nan)) for s in pose]
        position_std, yaw_std = float(np.sqrt((stds[0] ** 2 + stds[1] ** 2) / 2)), stds[2]
        ahead, left, turning = speeds
        more_ahead, more_left = (even.smoother.inflation(s, position_std, moving) for s in (ahead, left))
        more_yaw = even.smoother.inflation(turning, yaw_std, moving)
        return cls(position_std, yaw_std, more_ahead, more_left, more_yaw)

    def summary(self, good: NDArray[np.bool_], missing: NDArray[np.bool_]) -> dict[str, float]:
        """Return the values for a recording's attributes."""
        return {
            "position_std_m": self.position_std,
            "yaw_std_rad": self.yaw_std,
            "inflation_lateral": float(np.median(self.more_left[good])) if good.any() else 1.0,
            "inflation_yaw": float(np.median(self.more_yaw[good])) if good.any() else 1.0,
            "missing_share": float(missing.mean()),
        }


def _seen_from_the_vehicle(
    x: Array, y: Array, yaw: Array, smoother: Smoother, vehicle: Vehicle
) -> tuple[Array, Array, Array]:
    """Speed ahead, speed to the left and yaw rate of a marker's way."""
    world_x, world_y, turning = smoother.first(x), smoother.first(y), smoother.first(yaw)
    cos, sin = np.cos(yaw), np.sin(yaw)
    # A marker to the left of the middle line moves ahead by -lateral * yaw rate.
    ahead = world_x * cos + world_y * sin + vehicle.marker_lateral * turning
    left = world_y * cos - world_x * sin
    return ahead, left, turning


def _gaps_filled(table: pd.DataFrame, missing: NDArray[np.bool_]) -> tuple[Array, Array, Array]:
    """Position and unwrapped yaw with straight lines over what is missing."""
    index, here = np.arange(len(table)), np.flatnonzero(~missing)
    x, y, yaw = (table[c].to_numpy(dtype=float)[here] for c in ("x", "y", "yaw"))
    return (
        np.interp(index, here, x),
        np.interp(index, here, y),
        np.interp(index, here, np.unwrap(yaw)),
    )
