"""The DART drives: a 1:10 car under motion capture (Lorenzo-Lyons/DART, MIT licence)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings.vehicle import Vehicle

Array = NDArray[np.float64]
_FRAME = 0.01  # s: the capture's own clock; the stamps are times of arrival
_POSE = {"vicon x": "x", "vicon y": "y", "vicon yaw": "yaw"}
_OWN = {
    "vel encoder": "wheel_surface_speed",
    "acc x (IMU)": "imu_ax",
    "acc y (IMU)": "imu_ay",
    "W (IMU)": "imu_yaw_rate",
    "throttle": "throttle",
    "steering": "steering_command",
}
_LONGEST_DELAY = 0.3  # s

# Figures of the README beside the drives. Not from there, and so marked uncertain: the height of
# the centre of gravity and every `_std`.
DART_CAR = Vehicle(
    mass=1.580,
    front_mass=0.847,
    wheelbase=0.1735,
    yaw_inertia=0.0048,
    yaw_inertia_std=0.0015,
    axle_mass_std=0.005,
    track=0.08,
    cg_height=0.035,
    cg_height_std=0.015,
    marker_offset=0.115,
    marker_offset_std=0.002,
    yaw_offset=0.0077,
    yaw_offset_std=0.004,
)


def read_dart(path: str | Path) -> pd.DataFrame:
    """Read one DART drive.

    The motion capture runs at an even 100 Hz while its stamps are times of arrival: after a
    delay several frames arrive in a burst. Each row is given back the frame it belongs to; lost
    frames become NaN rows. The car's own channels come at about 10 Hz and are held: each new
    value is taken once, joined by straight lines, and moved ahead by the delay at which the
    car's yaw rate fits that of the pose best.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    DataFrame
        `time` s from the first frame, evenly spaced; `x`, `y` m, `yaw` rad (unwrapped, as
        recorded), `wheel_surface_speed` m/s, `imu_ax`, `imu_ay` m/s^2, `imu_yaw_rate` rad/s,
        `throttle`, `steering_command` (-1 to 1: a command, no angle).
        `attrs`: `source`, `format`, `own_channel_delay` s, `lost_frames`, `delayed_frames`,
        `notes`.

    Raises
    ------
    RecordingError
        The file is not such a drive.
    """
    try:
        raw = pd.read_csv(path)
    except (OSError, ValueError, UnicodeDecodeError) as error:
        raise RecordingError(f"cannot be read ({error})", where=str(path)) from error
    lacking = [c for c in ("vicon time", "elapsed time sensors", *_POSE, *_OWN) if c not in raw]
    if lacking:
        raise RecordingError(
            f"no DART drive: {', '.join(lacking)} missing", where=str(path), todo="see its README"
        )
    try:
        raw = raw.astype(float)
    except (ValueError, TypeError) as error:
        raise RecordingError(f"not all numbers ({error})", where=str(path)) from error
    raw = raw[np.isfinite(raw["vicon time"])].reset_index(drop=True)
    stamp = raw["vicon time"].to_numpy()
    if stamp.size < 100 or (np.diff(stamp) < 0).any() or stamp[-1] - stamp[0] > 86400:
        raise RecordingError("time stamps are too few or unordered", where=str(path))
    frames, delayed = _frames(stamp)
    _, first = np.unique(frames, return_index=True)
    count = int(frames[-1]) + 1
    time = np.asarray(np.arange(count) * _FRAME, dtype=np.float64)
    out = pd.DataFrame({"time": time})
    for theirs, ours in _POSE.items():
        values = raw[theirs].to_numpy()
        values = np.unwrap(values) if ours == "yaw" else values
        column = np.full(count, np.nan)
        column[frames[first]] = values[first]
        out[ours] = column
    delay = _add_own_channels(out, raw, (stamp - stamp[0]), time)
    lost = int(out["x"].isna().sum())
    out.attrs = {
        "source": str(path),
        "format": "DART",
        "own_channel_delay": delay,
        "lost_frames": lost,
        "delayed_frames": delayed,
        "notes": [
            f"{lost} of {count} frames lost, {delayed} arrived late and were put in their place",
            f"the car's own channels were moved ahead by {delay:.2f} s",
        ],
    }
    # Half a step of the encoder's resolution, uniformly distributed, and the hold between values.
    out.attrs["wheel_surface_speed_std"] = 0.0413 / np.sqrt(12)
    return out


def _frames(stamp: Array) -> tuple[NDArray[np.int64], int]:
    """Frame numbers from times of arrival: a frame never arrives before it is taken."""
    seen = np.round((stamp - stamp[0]) / _FRAME).astype(np.int64)
    frames = seen.copy()
    for i in range(frames.size - 2, -1, -1):
        frames[i] = min(frames[i], frames[i + 1] - 1)
    frames -= frames[0]
    return frames, int((frames < seen - seen[0]).sum())


def _add_own_channels(out: pd.DataFrame, raw: pd.DataFrame, stamp: Array, time: Array) -> float:
    """Join the held channels by lines, find their delay by the yaw rate, and add them."""
    new = raw["elapsed time sensors"].diff().fillna(0).to_numpy() > 0
    if new.sum() < 10:
        return 0.0
    at = stamp[new]
    yaw = out["yaw"].interpolate(limit_direction="both").to_numpy()
    width = 11
    rate = np.convolve(np.gradient(yaw, _FRAME), np.ones(width) / width, "same")
    own = raw["W (IMU)"].to_numpy()[new]
    delays = np.arange(0.0, _LONGEST_DELAY, 0.01)
    misfit = [np.std(own - np.interp(at - d, time, rate)) for d in delays]
    delay = float(delays[int(np.argmin(misfit))])
    for theirs, ours in _OWN.items():
        out[ours] = np.interp(time, at - delay, raw[theirs].to_numpy()[new])
    return delay
