"""A simulated single-track vehicle whose axle forces are known."""

from dataclasses import replace
from functools import cache

import numpy as np
import pandas as pd
import pytest
from scipy.integrate import solve_ivp
from scipy.stats import chi2

from tire_pipeline.concealed.scoring.rows import share_row
from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings import DART_CAR, Vehicle, axle_recording

pytestmark = pytest.mark.slow

CAR = Vehicle(
    mass=1500,
    front_mass=800,
    wheelbase=2.7,
    yaw_inertia=2500,
    yaw_inertia_std=250,
    axle_mass_std=8,
    cg_height=0.5,
    marker_offset=1.0,
    marker_offset_std=0.02,
    yaw_offset=0.0,
    yaw_offset_std=0.002,
)
# Speed, largest steering, lateral stiffness and peak over load, position and yaw noise.
SCALES = {
    "car": (CAR, 20.0, 0.05, 20.0, 1.0, 5e-3, 1e-3),
    "model car": (DART_CAR, 2.0, 0.2, 10.0, 0.8, 5e-5, 6e-4),
}


def drive_of(vehicle, speed, steer, stiffness, friction, noise, yaw_noise, seed, seconds=40.0):
    """Pose of the marker with noise, and the true slip angles and axle forces."""
    rng = np.random.default_rng(seed)
    phase, frequency = rng.uniform(0, 6.28, 3), np.array([0.08, 0.21, 0.43])
    a, b = vehicle.front_length, vehicle.rear_length

    def steering(t):
        waves = np.sin(2 * np.pi * np.multiply.outer(np.asarray(t), frequency) + phase)
        return steer * waves @ np.array([0.5, 0.3, 0.2])

    def tire(slip, mass):
        top = friction * mass * 9.80665
        return -top * np.tanh(stiffness / friction * slip)

    def forces(t, vy, r):
        front = np.arctan2(vy + a * r, speed) - steering(t)
        rear = np.arctan2(vy - b * r, speed)
        return front, rear, tire(front, vehicle.front_mass), tire(rear, vehicle.mass - vehicle.front_mass)

    def rhs(t, s):
        _, _, yaw, vy, r = s
        _, _, fyf, fyr = forces(t, vy, r)
        across = fyf * np.cos(steering(t))
        return [
            speed * np.cos(yaw) - vy * np.sin(yaw),
            speed * np.sin(yaw) + vy * np.cos(yaw),
            r,
            (across + fyr) / vehicle.mass - speed * r,
            (a * across - b * fyr) / vehicle.yaw_inertia,
        ]

    t = np.arange(0, seconds, 0.01)
    s = solve_ivp(rhs, (0, seconds), np.zeros(5), t_eval=t, method="LSODA", rtol=1e-8, atol=1e-9).y
    front, rear, fyf, fyr = forces(t, s[3], s[4])
    ahead = vehicle.marker_offset - b
    heading = s[2]
    drive = pd.DataFrame(
        {
            "time": t,
            "x": s[0] + ahead * np.cos(heading) + rng.normal(0, noise, t.size),
            "y": s[1] + ahead * np.sin(heading) + rng.normal(0, noise, t.size),
            "yaw": np.mod(heading - vehicle.yaw_offset + rng.normal(0, yaw_noise, t.size), 2 * np.pi),
            "steering": steering(t),
        }
    )
    truth = pd.DataFrame(
        {"time": t, "front_slip": front, "rear_slip": rear, "front_fy": fyf, "rear_fy": fyr, "r": s[4]}
    )
    return drive, truth


def drawn(vehicle, rng):
    """A vehicle whose true figures lie about the stated ones as their uncertainty says."""
    front, rear = rng.normal(0, vehicle.axle_mass_std, 2)
    return replace(
        vehicle,
        front_mass=vehicle.front_mass + front,
        yaw_inertia=vehicle.yaw_inertia + rng.normal(0, vehicle.inertia_std),
        mass=vehicle.mass + front + rear,
        marker_offset=vehicle.marker_offset + rng.normal(0, vehicle.marker_offset_std),
        yaw_offset=vehicle.yaw_offset + rng.normal(0, vehicle.yaw_offset_std),
    )


@cache
def drawn_drive(scale, seed):
    vehicle, *rest = SCALES[scale]
    return drive_of(drawn(vehicle, np.random.default_rng(1000 + seed)), *rest, seed=seed)


def errors_in_stds(scale, axle, seed):
    """Errors of the axle's force and slip angle on one drive, over their stated standard deviations."""
    drive, truth = drawn_drive(scale, seed)
    found = axle_recording(drive, SCALES[scale][0], axle)
    true = {"fy": f"{axle}_fy", "slip_angle": f"{axle}_slip"}
    return {
        name: (found[name] - np.interp(found["time"], truth["time"], truth[column])) / found[f"{name}_std"]
        for name, column in true.items()
    }


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("axle", ["rear", "front"])
def test_axle_is_recovered_within_its_stated_uncertainty(scale, axle):
    """Of ten vehicles. An error is nearly the same along a drive, so mean squares add to a chi-squared."""
    drives = [errors_in_stds(scale, axle, seed) for seed in range(10)]
    for name in ("fy", "slip_angle"):
        squares = sum(float(np.mean(drive[name] ** 2)) for drive in drives)
        assert chi2.ppf(0.001, 10) < squares < chi2.ppf(0.999, 10), (name, squares)


@pytest.mark.long
@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("axle", ["rear", "front"])
def test_two_stated_deviations_hold_nine_errors_in_ten(scale, axle):
    drives = [errors_in_stds(scale, axle, seed) for seed in range(100)]
    for name in ("fy", "slip_angle"):
        shares = [float(np.mean(np.abs(drive[name]) < 2.0)) for drive in drives]
        interval = np.mean(shares) + 1.96 * np.array([-1.0, 1.0]) * np.std(shares) / np.sqrt(len(shares))
        assert 0.90 <= np.mean(shares) <= 0.999, (name, interval)


def with_and_without_noise(axle, seed):
    """The axle of the model car as it is stated: with the noise of its sensors, and without it."""
    vehicle, *rest = SCALES["model car"]
    drive, _ = drive_of(vehicle, *rest, seed=seed, seconds=80.0)
    still, _ = drive_of(vehicle, *rest[:-2], 0.0, 0.0, seed=seed, seconds=80.0)
    return axle_recording(drive, vehicle, axle), axle_recording(still, vehicle, axle)


@pytest.mark.long
@pytest.mark.parametrize("axle", ["rear", "front"])
def test_noise_alone_is_as_large_as_stated(axle):
    """Errors scatter as the noise column says, within a fifth: share of drives."""
    right = []
    for seed in range(8):
        found, exact = with_and_without_noise(axle, seed)
        stated = [found[f"{name}_noise_std"].median() for name in ("fy", "slip_angle")]
        there = [np.std(found[name] - exact[name]) for name in ("fy", "slip_angle")]
        right.append(np.all(np.abs(np.divide(there, stated) - 1.0) < 0.2))
    row = share_row(axle, right)
    print(f"{row['value']:.2f} ({row['low']:.2f} to {row['high']:.2f}) of {row['n']}")
    assert row["high"] >= 0.9


@pytest.mark.parametrize("axle", ["rear", "front"])
def test_without_noise_the_force_is_exact(axle):
    vehicle, *rest = SCALES["model car"]
    still, truth = drive_of(vehicle, *rest[:-2], 0.0, 0.0, seed=3, seconds=80.0)
    exact = axle_recording(still, vehicle, axle)
    true = np.interp(exact["time"], truth["time"], truth[f"{axle}_fy"])
    assert np.max(np.abs(exact["fy"] - true)) < 0.01 * truth[f"{axle}_fy"].abs().max()


def test_signs_iso():
    """Turning left: yaw rate and lateral force positive, slip angle negative."""
    vehicle, *rest = SCALES["car"]
    drive, _ = drive_of(vehicle, *rest, seed=1)
    rear = axle_recording(drive, vehicle, rate=np.inf)
    left = rear["yaw_rate"] > 0.15
    assert left.sum() > 100
    assert (rear.loc[left, "fy"] > 0).mean() > 0.95
    assert np.corrcoef(rear["slip_angle"], rear["fy"])[0, 1] < -0.9


def test_drop_outs_are_cut_and_bridged():
    vehicle, *rest = SCALES["model car"]
    drive, truth = drive_of(vehicle, *rest, seed=5)
    holed = drive.drop(index=[700, 701, *range(1500, 1560)])
    found = axle_recording(holed, vehicle, rate=np.inf)
    assert found["segment"].max() == 2
    assert not found["time"].between(15.0, 15.6).any()
    assert found["time"].between(7.0, 7.02).any()
    true = np.interp(found["time"], truth["time"], truth["rear_fy"])
    assert np.mean(np.abs(found["fy"] - true) < 2 * found["fy_std"]) > 0.9


def test_own_sensors_with_straights_recover_the_force_and_slip():
    """Without a pose: speed, yaw rate and lateral acceleration at the centre of gravity."""
    vehicle, *rest = SCALES["car"]
    vehicle = replace(vehicle, marker_offset=vehicle.rear_length)
    turn, truth = drive_of(vehicle, *rest[:-2], 0.0, 0.0, seed=2)
    rng = np.random.default_rng(0)
    ay = (truth["front_fy"] * np.cos(turn["steering"]) + truth["rear_fy"]) / vehicle.mass
    own = pd.DataFrame(
        {
            "time": np.arange(len(turn) + 200) * 0.01,
            "speed": rest[0],
            "yaw_rate": np.concatenate([np.zeros(200), truth["r"]]),
            "lateral_acceleration": np.concatenate([np.zeros(200), ay]),
        }
    )
    own["lateral_acceleration"] += rng.normal(0, 0.05, len(own))
    own["yaw_rate"] += rng.normal(0, 0.001, len(own))
    found = axle_recording(own, vehicle)
    true = np.interp(found["time"] - 2.0, truth["time"], truth["rear_fy"], left=0.0)
    late = found["time"] > 3.0
    assert np.mean(np.abs(found["fy"] - true)[late] < 2 * found["fy_std"][late]) > 0.9
    slip = np.interp(found["time"] - 2.0, truth["time"], truth["rear_slip"], left=0.0)
    assert np.mean(np.abs(found["slip_angle"] - slip)[late] < 2 * found["slip_angle_std"][late]) > 0.9
    assert any("integrated" in note for note in found.attrs["notes"])


def test_rate_thins_and_attributes_say_how_independent():
    vehicle, *rest = SCALES["model car"]
    drive, _ = drive_of(vehicle, *rest, seed=5)
    full, thin = axle_recording(drive, vehicle, rate=np.inf), axle_recording(drive, vehicle, rate=5.0)
    assert len(full) == pytest.approx(20 * len(thin), abs=20)
    seconds = len(full) * 0.01
    assert full.attrs["independent_samples"] == int(seconds * 2 * full.attrs["bandwidth_hz"])
    assert thin.attrs["independent_samples"] == full.attrs["independent_samples"]


def test_driving_force_and_slip_ratio_where_known():
    vehicle, *rest = SCALES["car"]
    drive, _ = drive_of(vehicle, *rest, seed=5)
    drive["wheel_speed"] = 1.02 * rest[0] / 0.3
    full = replace(vehicle, wheel_radius=0.3, front_drive_share=0.0)
    rear = axle_recording(drive, full)
    assert rear["slip_ratio"].median() == pytest.approx(0.02, abs=0.005)
    assert {"fx", "fx_std", "slip_ratio_std"} <= set(rear.columns)
    assert "slip_ratio" not in axle_recording(drive, vehicle)
    assert (axle_recording(drive, full, "front")["fx"] == 0).all()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d.drop(columns="time"), "no time"),
        (lambda d: d.drop(columns="x"), "neither a pose nor"),
        (lambda d: d.head(15), "15 samples"),
        (lambda d: d.assign(x=np.nan), "no finite sample"),
        (lambda d: d.iloc[::-1], "backwards"),
        (lambda d: d.assign(time=0.0), "stands still"),
        (lambda d: d.head(60), "too few"),
    ],
)
def test_bad_drives_say_what_is_wrong(change, message):
    vehicle, *rest = SCALES["car"]
    drive, _ = drive_of(vehicle, *rest, seed=5, seconds=4.0)
    with pytest.raises(RecordingError, match=message):
        axle_recording(change(drive), vehicle)


def test_front_axle_needs_steering_and_vehicle_needs_sense():
    drive, _ = drive_of(CAR, *SCALES["car"][1:], seed=5, seconds=4.0)
    with pytest.raises(RecordingError, match="road-wheel angle"):
        axle_recording(drive.drop(columns="steering"), CAR, "front")
    with pytest.raises(RecordingError, match="front_mass"):
        replace(CAR, front_mass=2000)
    with pytest.raises(RecordingError, match="yaw_inertia"):
        replace(CAR, yaw_inertia=0)
    with pytest.raises(RecordingError, match="mass is nan"):
        replace(CAR, mass=float("nan"))
    with pytest.raises(RecordingError, match="bandwidth"):
        axle_recording(drive, CAR, bandwidth=50.0)
