"""A driven vehicle's recording -> one recording per axle, by the inverse single-track model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any, Literal

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings.axle.body_motion import (
    SHARE_OF_SPEED_KEPT,
    BodyMotion,
    evenly_spaced,
    fast_and_good,
    from_pose,
)
from tire_pipeline.recordings.axle.drive_units import drive_in_si
from tire_pipeline.recordings.axle.kinematics import check_steering
from tire_pipeline.recordings.axle.sensor_motion import from_sensors
from tire_pipeline.recordings.axle.smoothing import white_noise_std
from tire_pipeline.recordings.axle.vehicle import Vehicle
from tire_pipeline.recordings.conventions.drive_columns import POSE_COLUMNS
from tire_pipeline.unit_definitions import GRAVITY

Array = NDArray[np.float64]
Axle = Literal["front", "rear"]
_WHEELS = {
    1: "the whole axle: wheels=2 compares them with a file of one tire",
    2: "the mean of the axle's two wheels",
}
_READ_AS = "columns in ISO W axes and SI units, from the motion of a vehicle"
_FORCES_AND_LOAD = ("fx", "fx_std", "fy", "fy_std", "fy_noise_std", "normal_load", "normal_load_std")


@dataclass(frozen=True)
class _AxleState:
    fy: Array
    fy_noise: Array
    fy_unsure: Array
    slip_angle: Array
    slip_noise: Array
    slip_unsure: Array
    speed: Array
    normal_load: Array
    load_std: Array


def axle_recording(
    drive: pd.DataFrame,
    vehicle: Vehicle,
    axle: Axle = "rear",
    *,
    bandwidth: float = 2.5,
    min_speed: float | None = None,
    rate: float | None = None,
    wheels: Literal[1, 2] = 1,
) -> pd.DataFrame:
    """Slip, load and force of one axle of a driven vehicle, with their uncertainty.

    The inverse single-track model: with the centre of gravity a (b) behind the front (ahead of
    the rear) axle, wheelbase l, mass m and yaw inertia J,

    ``F_y,rear = (m a a_y - J r') / l`` and ``F_y,front = (m b a_y + J r') / l``

    in the vehicle's axes (Mitschke and Wallentowitz, "Dynamik der Kraftfahrzeuge", single-track
    model; signs of ISO 8855). The slip angle is that of the axle's middle, ``atan2(v_y, v_x)``
    less the road-wheel angle: a positive slip angle causes a negative `fy`, as in ISO W.

    Parameters
    ----------
    drive : DataFrame, one row a sample
        `time` s and either the pose (`x`, `y` m, `yaw` rad) or the vehicle's own sensors
        (`speed` m/s, `yaw_rate` rad/s, `lateral_acceleration` m/s^2 at the marker, and, where
        there is one, `lateral_speed` m/s or `sideslip` rad). `steering`, the road-wheel angle in
        rad, is needed for the front axle. `wheel_surface_speed` m/s (or `wheel_speed` rad/s with
        `vehicle.wheel_radius`) determines the slip ratio.
    vehicle : Vehicle
        Masses, lengths and inertia, SI, with their uncertainties.
    axle : {"rear", "front"}
        The axle whose two wheels are taken as one.
    bandwidth : float
        Half-power frequency of the differentiation, Hz. What is faster is not in the result.
    min_speed : float, optional
        Slower samples are left out, m/s. Left out: a sixth of the largest speed and, where
        `vehicle.wheel_radius` is known, the speed below which the filter lets through more than a
        tenth of the power of what happens once a wheel turn (a bent or unbalanced wheel makes the
        body wobble, and that wobble is no slip of the tire).
    rate : float, optional
        Samples a second in the result, Hz. Left out: twice the bandwidth, as samples nearer to each
        other share their filter and add no information. `float("inf")`: those of the drive (see
        `attrs["independent_samples"]`).
    wheels : {1, 2}
        Into how many tires the axle's load and forces are divided. 1: the axle is taken as one tire, for
        a model that was fitted to the axle. 2: the mean of its two, for a file of one tire; then
        `load_transfer` (N) is added, by how much their loads differ from the mean where each axle takes
        half, if `vehicle` has `cg_height` and `track`.

    Returns
    -------
    DataFrame
        `time`, `slip_angle`, `slip_ratio` (if known), `normal_load`, `speed`, `fy`, `fx` (if
        known), each of them with `<name>_std` (noise and unknown vehicle together) and, for
        `fy` and `slip_angle`, `<name>_noise_std` (differentiation noise alone); `turn_slip` 1/m,
        the curvature of the axle's path (yaw rate over speed, positive to the left); `yaw_rate`,
        `lateral_acceleration`, and `segment`, a number for each uninterrupted piece. Forces and load
        are those of the whole axle unless `wheels` is 2. `attrs` holds `bandwidth_hz`,
        `independent_samples`, `noise`, `vehicle`, `notes`, and `assumed`, which a report shows.

    Raises
    ------
    RecordingError
        A needed column is missing, or nothing is left.

    See Also
    --------
    Vehicle : Masses, lengths and inertia.
    read_dart : A drive to begin with.

    Notes
    -----
    Source and uncertainties: docs/reference/recordings.md.

    Examples
    --------
    A circle of 50 m at 15 m/s: the rear axle, which carries 675 kg, pushes with 675 kg times 4.5 m/s^2,
    less what the filter takes.

    >>> import numpy as np
    >>> import pandas as pd
    >>> from tire_pipeline.recordings import Vehicle
    >>> time = np.arange(0.0, 20.0, 0.01)
    >>> yaw = 0.3 * time
    >>> drive = pd.DataFrame({"time": time, "x": 50.0 * np.sin(yaw), "y": -50.0 * np.cos(yaw), "yaw": yaw})
    >>> car = Vehicle(mass=1500.0, front_mass=825.0, wheelbase=2.7, yaw_inertia=2400.0)
    >>> rear = axle_recording(drive, car, "rear")
    >>> round(float(rear["fy"].median())), round(float(rear["turn_slip"].median()), 3)
    (3037, 0.02)
    """
    if axle not in ("front", "rear"):
        raise RecordingError(f"axle={axle!r}", todo='choose "front" or "rear"')
    if axle == "front" and "steering" not in drive:
        raise RecordingError(
            "the front axle's slip angle needs the road-wheel angle",
            todo="add a column `steering` in rad, or take the rear axle",
        )
    if wheels not in (1, 2):
        raise RecordingError(
            f"wheels={wheels!r}", todo="choose 1 (the axle as one tire) or 2 (its mean wheel)"
        )
    drive, notes = drive_in_si(drive)
    if set(POSE_COLUMNS) <= set(drive.columns):
        motion = from_pose(drive, vehicle, bandwidth)
    else:
        motion = from_sensors(drive, vehicle, bandwidth)
    even = evenly_spaced(drive)[0]
    state = _axle_state(motion, vehicle, axle, even)
    notes += motion.notes
    table = _table(motion, state)
    _add_longitudinal(table, motion, state, vehicle, axle, even, notes)
    of_tires = table.columns.intersection(_FORCES_AND_LOAD)
    table[of_tires] /= wheels
    whose = f"load and forces are those of {_WHEELS[wheels]}"
    notes.append(whose)
    if wheels == 2:
        _add_load_transfer(table, motion, vehicle, notes)
    out = _finish(table, motion, vehicle, axle, min_speed, rate, notes, drive.attrs)
    out.attrs["assumed"] = [_READ_AS, whose]
    return out


def _add_load_transfer(table: pd.DataFrame, motion: BodyMotion, vehicle: Vehicle, notes: list[str]) -> None:
    """By how much the loads of the two wheels differ from their mean, if each axle takes half of it."""
    if vehicle.cg_height is None or vehicle.track is None:
        notes.append(
            "without Vehicle.cg_height and track the load that one wheel takes over from the other is "
            "unknown: it looks like less friction in fast turns"
        )
        return
    ay = _lateral_at_cg(motion, vehicle)
    table["load_transfer"] = np.abs(vehicle.mass * ay * vehicle.cg_height / (2.0 * vehicle.track))


def _axle_state(motion: BodyMotion, vehicle: Vehicle, axle: Axle, even: pd.DataFrame) -> _AxleState:
    """Force, slip and load of the axle with their noise and their unknowns."""
    length, mass = vehicle.wheelbase, vehicle.mass
    rear = axle == "rear"
    arm = vehicle.front_length if rear else vehicle.rear_length
    sign = -1.0 if rear else 1.0
    to_cg = vehicle.rear_length - motion.ahead
    ax, ax_std = _ahead_at_cg(motion, vehicle)
    ay = _lateral_at_cg(motion, vehicle)
    fy = (mass * arm * ay + sign * vehicle.yaw_inertia * motion.yaw_acceleration) / length
    per_yaw = (mass * arm * to_cg + sign * vehicle.yaw_inertia) / length
    noise = np.hypot(mass * arm / length * motion.ay_std, per_yaw * motion.yaw_acceleration_std)
    unsure = np.sqrt(
        (vehicle.inertia_std * motion.yaw_acceleration / length) ** 2
        + (vehicle.axle_mass_std * ay) ** 2
        + (mass * arm / length * motion.ay_gain_std * motion.ay) ** 2
        + (mass * arm / length * motion.yaw_acceleration * vehicle.marker_offset_std) ** 2
        + (mass * arm / length * ax * vehicle.yaw_offset_std) ** 2
    )
    to_axle = (0.0 if rear else length) - motion.ahead
    vy = motion.vy + to_axle * motion.yaw_rate
    speed = np.maximum(np.hypot(motion.vx, vy), 1e-6)
    slip = np.arctan2(vy, motion.vx)
    slip_noise = np.hypot(motion.vy_std, to_axle * motion.yaw_rate_std) / speed
    slip_unsure = np.hypot(vehicle.yaw_offset_std, vehicle.marker_offset_std * motion.yaw_rate / speed)
    if not rear:
        steering = even["steering"].to_numpy(dtype=float)
        known = np.isfinite(steering)
        if not known.any():
            raise RecordingError("`steering` holds no number", todo="enter road-wheel angles in rad")
        filled = np.interp(np.arange(steering.size), np.flatnonzero(known), steering[known])
        wheel = motion.smoother.smooth(filled)
        ahead = fast_and_good(motion.vx, motion.good)
        check_steering(wheel[ahead], (length * motion.yaw_rate / np.maximum(motion.vx, 1e-6))[ahead])
        slip = slip - wheel
        # Lateral force in the wheel's axes; the driving force's share is added with `fx`.
        fy, noise, unsure = (v / np.cos(wheel) for v in (fy, noise, unsure))
    static = vehicle.front_mass if not rear else mass - vehicle.front_mass
    height = vehicle.cg_height or 0.0
    shift = mass * ax / length * (1.0 if rear else -1.0)
    load = static * GRAVITY + shift * height
    load_std = np.sqrt(
        (vehicle.axle_mass_std * GRAVITY) ** 2
        + (shift * vehicle.cg_height_std) ** 2
        + (mass / length * height * ax_std) ** 2
    )
    return _AxleState(
        fy, noise, unsure, slip, slip_noise, slip_unsure, speed, load, load_std * np.ones_like(fy)
    )


def _lateral_at_cg(motion: BodyMotion, vehicle: Vehicle) -> Array:
    """Acceleration to the left at the centre of gravity."""
    return motion.ay + (vehicle.rear_length - motion.ahead) * motion.yaw_acceleration


def _ahead_at_cg(motion: BodyMotion, vehicle: Vehicle) -> tuple[Array, Array]:
    """Acceleration ahead at the centre of gravity, and its noise: the marker's way is another circle."""
    to_cg = vehicle.rear_length - motion.ahead
    ax = motion.ax - to_cg * motion.yaw_rate**2
    return ax, np.hypot(motion.ax_std, 2.0 * to_cg * motion.yaw_rate * motion.yaw_rate_std)


def _table(motion: BodyMotion, state: _AxleState) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "time": motion.time,
            "slip_angle": state.slip_angle,
            "normal_load": state.normal_load,
            "speed": state.speed,
            "fy": state.fy,
            "fy_std": np.hypot(state.fy_noise, state.fy_unsure),
            "fy_noise_std": state.fy_noise,
            "slip_angle_std": np.hypot(state.slip_noise, state.slip_unsure),
            "slip_angle_noise_std": state.slip_noise,
            "normal_load_std": state.load_std,
            "turn_slip": motion.yaw_rate / state.speed,
            "yaw_rate": motion.yaw_rate,
            "lateral_acceleration": motion.ay,
        }
    )


def _add_longitudinal(
    table: pd.DataFrame,
    motion: BodyMotion,
    state: _AxleState,
    vehicle: Vehicle,
    axle: Axle,
    even: pd.DataFrame,
    notes: list[str],
) -> None:
    """Slip ratio from a wheel speed, `fx` from the longitudinal acceleration, where known."""
    surface, std = None, None
    if "wheel_surface_speed" in even:
        surface = even["wheel_surface_speed"].to_numpy(dtype=float)
        std = even.attrs.get("wheel_surface_speed_std")
    elif "wheel_speed" in even and vehicle.wheel_radius:
        surface = even["wheel_speed"].to_numpy(dtype=float) * vehicle.wheel_radius
    elif "wheel_speed" in even:
        notes.append("wheel_speed is there but Vehicle.wheel_radius is not: no slip_ratio")
    if surface is not None and np.isfinite(surface).any():
        steered = state.speed * np.cos(state.slip_angle)
        ahead = np.maximum(steered, 1e-6)
        table["slip_ratio"] = surface / ahead - 1.0
        std = white_noise_std(surface) if std is None else float(std)
        noise = np.hypot(std, motion.vx_std * surface / ahead) / ahead
        table["slip_ratio_std"] = noise
    share = vehicle.front_drive_share
    if share is None:
        return
    part = share if axle == "front" else 1.0 - share
    ax, ax_std = _ahead_at_cg(motion, vehicle)
    table["fx"] = part * vehicle.mass * ax
    table["fx_std"] = part * vehicle.mass * ax_std
    notes.append("fx: mass times acceleration, without aerodynamic drag and rolling resistance")


def _finish(
    table: pd.DataFrame,
    motion: BodyMotion,
    vehicle: Vehicle,
    axle: Axle,
    min_speed: float | None,
    rate: float | None,
    notes: list[str],
    source: Mapping[Any, Any],
) -> pd.DataFrame:
    """Cut what is missing or too slow, thin, number the pieces, and write the attributes."""
    keep, limit = _usable(table, motion, vehicle, min_speed)
    table["segment"] = np.cumsum(np.diff(keep.astype(int), prepend=0) == 1)
    dt = motion.smoother.dt
    step = _thinning_step(motion, rate)
    every = np.zeros(keep.size, dtype=bool)
    every[::step] = True
    seconds = keep.sum() * dt
    out = table.loc[keep & every].reset_index(drop=True)
    notes.append(f"{1 - motion.good.mean():.1%} of the samples rest on drop-outs or ends: cut")
    if vehicle.cg_height is None:
        notes.append("cg_height unknown: no longitudinal load transfer")
    first = ["time", "slip_angle", "slip_ratio", "normal_load", "speed", "fx", "fy"]
    out = out[[c for c in first if c in out] + [c for c in out if c not in first]]
    out.attrs = {
        "source": source.get("source", "drive"),
        "format": "axle",
        "axle": axle,
        "bandwidth_hz": motion.smoother.bandwidth,
        "sample_rate_hz": 1 / (step * dt),
        "independent_samples": max(1, int(seconds * 2 * motion.smoother.bandwidth)),
        "noise": motion.noise,
        "vehicle": asdict(vehicle),
        "min_speed": limit,
        "notes": [*source.get("notes", []), *notes],
    }
    return out


def _usable(
    table: pd.DataFrame, motion: BodyMotion, vehicle: Vehicle, min_speed: float | None
) -> tuple[NDArray[np.bool_], float]:
    """Which samples rest on no gap and are fast enough, and the least speed (m/s)."""
    fast = table["speed"].to_numpy()
    limit = float(np.quantile(fast[motion.good], 0.99)) * SHARE_OF_SPEED_KEPT if motion.good.any() else 0.0
    if vehicle.wheel_radius:
        limit = max(limit, motion.smoother.stop * 2 * np.pi * vehicle.wheel_radius)
    limit = limit if min_speed is None else min_speed
    keep = motion.good & (fast >= limit) & (motion.vx > 0) & np.isfinite(table["fy"].to_numpy())
    keep &= np.isfinite(table["slip_angle"].to_numpy())
    if not keep.any():
        raise RecordingError(
            "no sample is left after drop-outs and slow parts are cut", todo="lower min_speed"
        )
    return keep, limit


def _thinning_step(motion: BodyMotion, rate: float | None) -> int:
    """One of how many samples is kept; without a rate what the smoothing leaves independent."""
    dt = motion.smoother.dt
    rate = min(2 * motion.smoother.bandwidth, 1 / dt) if rate is None else rate
    if rate != np.inf and not 0 < rate <= 1 / dt * 1.001:
        raise RecordingError(f"rate={rate:g} Hz", todo=f"choose up to {1 / dt:g} Hz")
    return max(1, round(1 / (rate * dt)))
