"""Column names of a driven vehicle's log, and the functions that read such a log."""

from __future__ import annotations

from collections.abc import Iterable

POSE_COLUMNS = ("x", "y", "yaw")
"""Of a body whose path was recorded."""
MOTION_CHANNELS = ("speed", "yaw_rate", "lateral_acceleration")
"""Of a body that carries its own sensors."""
DRIVE_CHANNELS = frozenset(
    ("time", *POSE_COLUMNS, *MOTION_CHANNELS, "longitudinal_acceleration", "lateral_speed", "sideslip")
) | {"steering", "wheel_speed", "wheel_surface_speed"}
"""All that the motion of a vehicle and the slip of its tires are computed from."""
DART_POSE = {"vicon x": "x", "vicon y": "y", "vicon yaw": "yaw"}
DART_CHANNELS = {
    "vel encoder": "wheel_surface_speed",
    "acc x (IMU)": "imu_ax",
    "acc y (IMU)": "imu_ay",
    "W (IMU)": "imu_yaw_rate",
    "throttle": "throttle",
    "steering": "steering_command",
}
DART_COLUMNS = ("vicon time", "elapsed time sensors", *DART_POSE, *DART_CHANNELS)
"""All that a published DART drive has."""


def reader_of_drive(columns: Iterable[str]) -> str:
    """Return which functions read the log of a driven vehicle; "" if the columns are not those of one.

    Parameters
    ----------
    columns : iterable of str
        Names as the file has them, or canonical ones.

    Examples
    --------
    >>> reader_of_drive(["time", "x", "y", "yaw"]).split(":")[0]
    'this is the log of a driven vehicle'
    >>> reader_of_drive(["time", "slip_angle", "fy"])
    ''
    """
    held = set(columns)
    if held.issuperset(DART_COLUMNS):
        what, call = "a DART drive", "axle_recording(read_dart(path), DART_CAR)"
    elif "time" in held and (held.issuperset(POSE_COLUMNS) or "yaw_rate" in held):
        what, call = "the log of a driven vehicle", "axle_recording(recording, Vehicle(...))"
    else:
        return ""
    return (
        f"this is {what}: in Python, {call} makes a recording of one axle of it, which its method "
        "to_csv('axle.csv', index=False) writes (functions of tire_pipeline.recordings; "
        "docs/reference/recordings.md, Driven vehicles)"
    )
