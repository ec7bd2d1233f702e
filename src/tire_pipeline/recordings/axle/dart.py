"""The DART drives: a 1:10 car under motion capture (Lorenzo-Lyons/DART, MIT licence)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings.axle.vehicle import Vehicle
from tire_pipeline.recordings.conventions.drive_columns import DART_CHANNELS, DART_COLUMNS, DART_POSE

Array = NDArray[np.float64]
_FRAME = 0.01  # s: the capture's own clock; the stamps are times of arrival
_LONGEST_SENSOR_DELAY = 0.3  # s
_ENCODER_STEP = 0.0413  # m/s: the smallest difference between its values
# A frame that lies further than this from the middle of its neighbours is a mistaken marker: at
# 10 m/s^2 and 30 rad/s^2 a true one lies 0.5 mm and 0.0015 rad off.
_GLITCH = {"x": 5e-3, "y": 5e-3, "yaw": 1.5e-2}

# Figures of the README beside the drives. Not from there, and so marked uncertain: the height of
# the centre of gravity, every `_std`, and the wheel radius: below 1.3 m/s the slip angle swings
# once every 0.155 to 0.158 m in left-hand circles and every 0.126 to 0.138 m in right-hand ones,
# as it would with one crooked left wheel of 0.145 m around (track 0.08 m, circles of 0.6 to 0.8 m).
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
    wheel_radius=0.023,
)


def read_dart(path: str | Path) -> pd.DataFrame:
    """Read one DART drive.

    The motion capture runs at an even 100 Hz while its stamps are times of arrival: after a
    delay several frames arrive in a burst. Each row is assigned to the frame it belongs to; lost
    frames and those that jump out of the path become NaN rows. The car's own channels come at
    about 10 Hz and are held: each new value is taken once, joined by straight lines, and moved
    ahead by the delay at which the car's yaw rate fits that of the pose best.

    Parameters
    ----------
    path : str or Path
        A CSV file with the columns of the published drives, one row a sample of the capture.

    Returns
    -------
    DataFrame
        `time` s from the first frame, evenly spaced; `x`, `y` m, `yaw` rad (unwrapped, as
        recorded), `wheel_surface_speed` m/s, `imu_ax`, `imu_ay` m/s^2, `imu_yaw_rate` rad/s,
        `throttle`, `steering_command` (-1 to 1: a command, no angle).
        `attrs`: `source`, `format`, `own_channel_delay` s, `lost_frames`, `delayed_frames`,
        `mistaken_frames`, `notes`.

    Raises
    ------
    RecordingError
        The file is not such a drive.

    See Also
    --------
    axle_recording : Slip and force of an axle from such a drive.

    Notes
    -----
    The drives: Lorenzo-Lyons/DART, docs/history/recordings.md.

    Examples
    --------
    A made-up drive straight ahead at 1 m/s, of which one frame was lost:

    >>> import numpy as np
    >>> import pandas as pd
    >>> time = np.arange(300) * 0.01
    >>> columns = {"vicon time": time, "elapsed time sensors": time, "vicon x": time, "vel encoder": 1.0}
    >>> zero = ["vicon y", "vicon yaw", "acc x (IMU)", "acc y (IMU)", "W (IMU)", "throttle", "steering"]
    >>> pd.DataFrame(columns).assign(**dict.fromkeys(zero, 0.0)).drop(index=100).to_csv("drive.csv")
    >>> drive = read_dart("drive.csv")
    >>> len(drive), drive.attrs["lost_frames"], bool(np.isnan(drive["x"][100]))
    (300, 1, True)
    """
    raw = _checked_drive(path)
    stamp = raw["vicon time"].to_numpy()
    frames, delayed = _frames(stamp)
    _, first = np.unique(frames, return_index=True)
    count = int(frames[-1]) + 1
    time = np.asarray(np.arange(count) * _FRAME, dtype=np.float64)
    out = pd.DataFrame({"time": time})
    for theirs, ours in DART_POSE.items():
        values = raw[theirs].to_numpy()
        values = np.unwrap(values) if ours == "yaw" else values
        column = np.full(count, np.nan)
        column[frames[first]] = values[first]
        out[ours] = column
    mistaken = _drop_glitches(out)
    delay = _add_own_channels(out, raw, (stamp - stamp[0]), time)
    lost = count - int(first.size)
    out.attrs = {
        "source": str(path),
        "format": "DART",
        "own_channel_delay": delay,
        "lost_frames": lost,
        "delayed_frames": delayed,
        "mistaken_frames": mistaken,
        "notes": [
            f"{lost} of {count} frames lost, {delayed} arrived late and were put in their place, "
            f"{mistaken} jump out of the path and were dropped",
            f"the car's own channels were moved ahead by {delay:.2f} s",
        ],
    }
    # An error that is uniform over one step.
    out.attrs["wheel_surface_speed_std"] = float(_ENCODER_STEP / np.sqrt(12))
    return out


def _checked_drive(path: str | Path) -> pd.DataFrame:
    """The file's columns as numbers, its rows those with a stamp of the motion capture."""
    try:
        raw = pd.read_csv(path)
    except (OSError, ValueError, UnicodeDecodeError) as error:
        raise RecordingError(f"cannot be read ({error})", where=str(path)) from error
    lacking = [c for c in DART_COLUMNS if c not in raw]
    if lacking:
        raise RecordingError(
            f"no DART drive: {', '.join(lacking)} missing",
            where=str(path),
            todo="read other recordings with read_recording, other vehicles' logs with axle_recording",
        )
    try:
        raw = raw.astype(float)
    except (ValueError, TypeError) as error:
        raise RecordingError(f"not all numbers ({error})", where=str(path)) from error
    raw = raw[np.isfinite(raw["vicon time"])].reset_index(drop=True)
    stamp = raw["vicon time"].to_numpy()
    if stamp.size < 100 or (np.diff(stamp) < 0).any() or stamp[-1] - stamp[0] > 86400:
        raise RecordingError("time stamps are too few or unordered", where=str(path))
    return raw


def _frames(stamp: Array) -> tuple[NDArray[np.int64], int]:
    """Frame numbers from times of arrival: a frame never arrives before it is taken."""
    seen = np.round((stamp - stamp[0]) / _FRAME).astype(np.int64)
    frames = seen.copy()
    for i in range(frames.size - 2, -1, -1):
        frames[i] = min(frames[i], frames[i + 1] - 1)
    frames -= frames[0]
    return frames, int((frames < seen - seen[0]).sum())


def _drop_glitches(out: pd.DataFrame) -> int:
    """Blank single frames that jump out of the path, the worst first; at most one in a hundred."""
    bad = np.zeros(len(out), dtype=bool)
    for name, limit in _GLITCH.items():
        values = out[name].to_numpy(copy=True)
        known = np.flatnonzero(np.isfinite(values))
        path = values[known]
        for _ in range(len(out) // 100):
            off = np.abs(path[1:-1] - (path[:-2] + path[2:]) / 2)
            # Neighbours on the far side of a hole lie off without being wrong.
            off[(known[2:] - known[:-2]) > 2] = 0
            worst = int(off.argmax()) + 1
            if off[worst - 1] <= limit:
                break
            bad[known[worst]] = True
            path[worst] = (path[worst - 1] + path[worst + 1]) / 2
    out.loc[bad, list(_GLITCH)] = np.nan
    return int(bad.sum())


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
    delays = np.arange(0.0, _LONGEST_SENSOR_DELAY, 0.01)
    misfit = [np.std(own - np.interp(at - d, time, rate)) for d in delays]
    delay = float(delays[int(np.argmin(misfit))])
    for theirs, ours in DART_CHANNELS.items():
        out[ours] = np.interp(time, at - delay, raw[theirs].to_numpy()[new])
    return delay
