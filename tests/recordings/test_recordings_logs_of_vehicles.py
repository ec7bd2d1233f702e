"""A driven vehicle's log is no recording of one tire: messages name the functions that read it."""

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings import (
    DART_CAR,
    Vehicle,
    axle_recording,
    check_recording,
    read_dart,
    read_recording,
)

TIME = np.arange(0.0, 8.0, 0.01)
YAW = 0.8 * TIME
POSE = {"vicon x": 1.5 * np.sin(YAW), "vicon y": -1.5 * np.cos(YAW), "vicon yaw": YAW}
REST = ["acc x (IMU)", "acc y (IMU)", "W (IMU)", "throttle", "steering"]
DART = pd.DataFrame({"vicon time": TIME, "elapsed time sensors": TIME, "vel encoder": 1.2} | POSE).assign(
    **dict.fromkeys(REST, 0.0)
)


def test_who_reads_a_dart_drive_is_said_and_reads_it(tmp_path):
    file = tmp_path / "drive.csv"
    DART.to_csv(file, index=False)
    with pytest.raises(RecordingError) as error:
        read_recording(file)
    assert "this is a DART drive: in Python, axle_recording(read_dart(path), DART_CAR)" in error.value.todo
    assert "fy" in axle_recording(read_dart(file), DART_CAR)


@pytest.mark.parametrize("column", ["vicon yaw", "steering"])
def test_a_file_that_read_dart_refuses_is_not_said_to_be_its(tmp_path, column):
    file = tmp_path / "drive.csv"
    DART.drop(columns=column).to_csv(file, index=False)
    with pytest.raises(RecordingError, match="no channel is recognised") as error:
        read_recording(file)
    assert "read_dart" not in error.value.todo
    with pytest.raises(RecordingError, match=f"no DART drive: {column} missing"):
        read_dart(file)


@pytest.mark.parametrize(
    "log",
    [
        pd.DataFrame({"time": TIME, "x": POSE["vicon x"], "y": POSE["vicon y"], "yaw": YAW}),
        pd.DataFrame(
            {"time": TIME, "speed": 12.0, "yaw_rate": 0.3, "lateral_acceleration": 3.6, "sideslip": 0.01}
        ),
    ],
    ids=["pose", "sensors"],
)
def test_who_reads_another_vehicles_log_is_said_and_reads_it(tmp_path, log):
    file = tmp_path / "log.csv"
    log.to_csv(file, index=False)
    recording = read_recording(file)
    advice = {issue.name: issue.advice for issue in check_recording(recording)}["no_force_channel"]
    assert "axle_recording(recording, Vehicle(...))" in advice
    car = Vehicle(mass=1500.0, front_mass=825.0, wheelbase=2.7, yaw_inertia=2400.0)
    table = axle_recording(recording, car, min_speed=0.5)
    assert "no_force_channel" not in {issue.name for issue in check_recording(table)}


def test_a_table_without_a_force_is_no_vehicles_log():
    table = pd.DataFrame({"time": TIME, "slip_angle": 0.01, "normal_load": 4000.0, "speed": 12.0})
    advice = {issue.name: issue.advice for issue in check_recording(table)}["no_force_channel"]
    assert "axle_recording" not in advice


def test_a_car_makers_log_in_usual_names_and_units_is_known_as_one(tmp_path):
    file = tmp_path / "log.csv"
    log = pd.DataFrame({"Time [s]": TIME, "VehicleSpeed [km/h]": 43.2, "YawRate [deg/s]": 17.2})
    log = log.assign(**{"LatAcc [g]": 0.367, "LongAcc [g]": 0.0, "SteeringWheelAngle [deg]": 60.0})
    log.assign(**{"Sideslip angle [deg]": 0.5}).to_csv(file, index=False)
    recording = read_recording(file)
    assert {"speed", "yaw_rate", "lateral_acceleration", "longitudinal_acceleration"} <= set(recording)
    assert recording["lateral_acceleration"].median() == pytest.approx(3.6, rel=0.01)
    advice = {issue.name: issue.advice for issue in check_recording(recording)}["no_force_channel"]
    assert "axle_recording(recording, Vehicle(...))" in advice
