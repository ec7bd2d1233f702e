"""Drives on a circle and along a line, whose axle forces, loads and slips a line of arithmetic gives."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.recordings import Vehicle, axle_recording

CAR = Vehicle(mass=1500.0, front_mass=825.0, wheelbase=2.7, yaw_inertia=2400.0, front_drive_share=0.3)
REAR_LENGTH = 2.7 * 825.0 / 1500.0
TIME = np.arange(0.0, 12.0, 0.01)
RATE, SPEED = 0.3, 15.0
G = 9.80665


def circle(ahead: float = 0.0, left: float = 0.0) -> pd.DataFrame:
    """To the left; the rear axle rolls without slip, and the marker lies ahead of it and to the left."""
    yaw = RATE * TIME
    x = SPEED / RATE * np.sin(yaw) + ahead * np.cos(yaw) - left * np.sin(yaw)
    y = -SPEED / RATE * np.cos(yaw) + ahead * np.sin(yaw) + left * np.cos(yaw)
    return pd.DataFrame({"time": TIME, "x": x, "y": y, "yaw": yaw, "steering": 0.05})


@pytest.mark.parametrize(("ahead", "left"), [(0.0, 0.0), (2.0, 0.0), (-0.5, 0.0), (0.0, 0.8), (1.0, -0.8)])
def test_wherever_the_marker_lies_the_axle_has_the_same_speed_slip_and_forces(ahead: float, left: float):
    vehicle = replace(CAR, marker_offset=ahead, marker_lateral=left)
    rear = axle_recording(circle(ahead, left), vehicle).median()
    assert rear["speed"] == pytest.approx(SPEED, rel=2e-3)
    assert rear["slip_angle"] == pytest.approx(0.0, abs=2e-4)
    assert rear["fy"] == pytest.approx(675.0 * RATE * SPEED, rel=5e-3)
    assert rear["fx"] == pytest.approx(-0.7 * 1500.0 * REAR_LENGTH * RATE**2, rel=0.02)
    front = axle_recording(circle(ahead, left), vehicle, "front").median()
    assert front["slip_angle"] == pytest.approx(np.arctan2(2.7 * RATE, SPEED) - 0.05, abs=2e-4)
    assert front["fy"] == pytest.approx(825.0 * RATE * SPEED / np.cos(0.05), rel=5e-3)


@pytest.mark.parametrize("ahead", [-0.5, 0.0, REAR_LENGTH, 2.5])
def test_wherever_the_marker_lies_the_same_load_is_transferred(ahead: float):
    vehicle = replace(CAR, marker_offset=ahead, cg_height=0.5)
    front, rear = (axle_recording(circle(ahead), vehicle, axle).median() for axle in ("front", "rear"))
    to_the_rear = -1500.0 * REAR_LENGTH * RATE**2 * 0.5 / 2.7
    assert front["normal_load"] - 825.0 * G == pytest.approx(-to_the_rear, rel=0.02)
    assert rear["normal_load"] - 675.0 * G == pytest.approx(to_the_rear, rel=0.02)


@pytest.mark.parametrize("forward", [2.0, -2.0])
def test_along_a_line_mass_times_acceleration_is_shared_and_moves_the_load(forward: float):
    x = 30.0 * TIME + 0.5 * forward * TIME**2
    noise = np.random.default_rng(0).normal(0.0, 1e-4, (2, TIME.size))
    drive = pd.DataFrame({"time": TIME, "x": x + noise[0], "y": noise[1], "yaw": 0.0, "steering": 0.0})
    vehicle = replace(CAR, cg_height=0.5)
    front, rear = (axle_recording(drive, vehicle, axle).median() for axle in ("front", "rear"))
    assert front["fx"] == pytest.approx(0.3 * 1500.0 * forward, rel=0.01)
    assert rear["fx"] == pytest.approx(0.7 * 1500.0 * forward, rel=0.01)
    assert rear["fx_std"] / front["fx_std"] == pytest.approx(0.7 / 0.3)
    to_the_rear = 1500.0 * forward * 0.5 / 2.7
    assert front["normal_load"] == pytest.approx(825.0 * G - to_the_rear, abs=5.0)
    assert rear["normal_load"] == pytest.approx(675.0 * G + to_the_rear, abs=5.0)


@pytest.mark.parametrize(
    ("channel", "value", "across"),
    [("lateral_speed", -0.4, -0.4), ("sideslip", -0.03, SPEED * np.tan(-0.03))],
)
def test_a_vehicles_own_sensors_give_its_slip_and_its_force_ahead(channel: str, value: float, across: float):
    columns = {"speed": SPEED, "yaw_rate": RATE, "lateral_acceleration": RATE * SPEED, channel: value}
    rear = axle_recording(pd.DataFrame({"time": TIME, **columns}), CAR).median()
    assert rear["slip_angle"] == pytest.approx(np.arctan2(across, SPEED), abs=1e-6)
    assert rear["fy"] == pytest.approx(675.0 * RATE * SPEED, rel=1e-6)
    ahead_of_the_axle = -RATE * across - REAR_LENGTH * RATE**2
    assert rear["fx"] == pytest.approx(0.7 * 1500.0 * ahead_of_the_axle, rel=1e-6)
