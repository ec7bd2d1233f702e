"""A log of a vehicle's own sensors: where they sit, how they lean, and what their units and signs are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings import Vehicle, axle_recording, read_recording

CAR = Vehicle(mass=1500.0, front_mass=825.0, wheelbase=2.7, yaw_inertia=2400.0, cg_height=0.5)
CAR = replace(CAR, marker_offset=CAR.rear_length)
TIME = np.arange(0.0, 40.0, 0.01)
SPEED, TURN, FREQUENCY = 15.0, 0.3, 0.2
G = 9.80665


def drive(ahead: float = 0.0, left: float = 0.0, **columns: float) -> pd.DataFrame:
    """A slalom whose centre of gravity has no lateral speed, as sensors at a point beside it feel it."""
    phase = 2 * np.pi * FREQUENCY * TIME
    rate, faster = TURN * np.sin(phase), 2 * np.pi * FREQUENCY * TURN * np.cos(phase)
    table = {
        "time": TIME,
        "speed": SPEED - left * rate,
        "yaw_rate": rate,
        "lateral_acceleration": SPEED * rate + ahead * faster - left * rate**2,
        "longitudinal_acceleration": -ahead * rate**2 - left * faster,
        "lateral_speed": ahead * rate,
        "steering": 2.7 * rate / SPEED,
    }
    return pd.DataFrame(table | columns)


@pytest.mark.parametrize("axle", ["front", "rear"])
@pytest.mark.parametrize(("ahead", "left"), [(1.0, 0.0), (0.0, 0.8), (-0.5, -0.8)])
@pytest.mark.parametrize("dropped", [[], ["longitudinal_acceleration"]])
def test_wherever_the_sensors_sit_the_axle_is_the_same(axle, ahead, left, dropped):
    there = replace(CAR, marker_offset=CAR.rear_length + ahead, marker_lateral=left)
    found = axle_recording(drive(ahead, left).drop(columns=dropped), there, axle)
    at_cg = axle_recording(drive(), CAR, axle)
    for channel, near in {"slip_angle": 2e-4, "speed": 0.01, "fy": 15.0, "normal_load": 8.0}.items():
        np.testing.assert_allclose(found[channel], at_cg[channel], atol=near, err_msg=channel)


def test_sideslip_is_measured_where_the_sensors_sit():
    there = replace(CAR, marker_offset=CAR.rear_length + 1.0, marker_lateral=0.8)
    log = drive(1.0, 0.8)
    log["sideslip"] = np.arctan2(log.pop("lateral_speed"), log["speed"])
    slip = axle_recording(log, there)["slip_angle"]
    np.testing.assert_allclose(slip, axle_recording(drive(), CAR)["slip_angle"], atol=2e-4)


def test_an_accelerometer_that_leans_is_said_and_set_right():
    leaning = drive()
    leaning["lateral_acceleration"] *= 1.0 + np.radians(7.0)
    level, said = axle_recording(drive(), CAR), axle_recording(leaning, CAR)
    (note,) = [note for note in said.attrs["notes"] if "lateral_acceleration" in note]
    assert "1.122 times" in note
    assert "rolls by 7.0 deg per g (Vehicle.roll_gradient=0.012)" in note
    assert np.mean(np.abs(said["fy"] - level["fy"]) <= 2 * said["fy_std"]) > 0.95
    stated = axle_recording(leaning, replace(CAR, roll_gradient=np.radians(7.0) / G))
    np.testing.assert_allclose(stated["fy"], level["fy"], atol=1.0)
    assert not any("lateral_acceleration" in note for note in stated.attrs["notes"])
    with pytest.raises(RecordingError, match=r"Vehicle.roll_gradient is 7\.0"):
        replace(CAR, roll_gradient=7.0)


@pytest.mark.parametrize(
    ("factors", "said"),
    [
        ({"lateral_acceleration": 1 / G}, "lateral_acceleration in g"),
        ({"yaw_rate": np.degrees(1.0)}, "yaw_rate in deg/s"),
        ({"speed": 3.6}, "speed in km/h"),
        ({"lateral_acceleration": 1 / G, "speed": 3.6}, "lateral_acceleration in g and speed in km/h"),
        ({"lateral_acceleration": -1.0}, "their signs differ"),
        ({"yaw_rate": -1.0}, "their signs differ"),
        ({"steering": np.degrees(1.0)}, "in degrees, or that of the steering wheel"),
        ({"steering": 15.0}, "in degrees, or that of the steering wheel"),
        ({"steering": -1.0}, "counted to the right"),
    ],
)
@pytest.mark.parametrize("lateral", [True, False], ids=["lateral speed", "without"])
def test_units_and_signs_that_contradict_each_other_are_refused(factors, said, lateral):
    log = drive()
    log.insert(1, "straight", TIME < 2.0)
    still = log["straight"].to_numpy()
    log.loc[still, ["yaw_rate", "lateral_acceleration", "lateral_speed", "steering"]] = 0.0
    log = log.drop(columns=["straight"] if lateral else ["straight", "lateral_speed"])
    axle_recording(log, CAR, "front")
    for channel, factor in factors.items():
        log[channel] *= factor
    with pytest.raises(RecordingError) as error:
        axle_recording(log, CAR, "front")
    assert said in str(error.value)


def test_a_log_in_usual_units_becomes_si(tmp_path):
    log = drive(sideslip=0.02).drop(columns="lateral_speed")
    file = tmp_path / "log.csv"
    names = {
        "time": "Time [s]",
        "speed": "Speed [km/h]",
        "yaw_rate": "Yaw rate [deg/s]",
        "lateral_acceleration": "Lateral acceleration [g]",
        "longitudinal_acceleration": "Longitudinal acceleration [g]",
        "sideslip": "Sideslip [deg]",
        "steering": "Steering [deg]",
    }
    usual = {"speed": 3.6, "yaw_rate": 180 / np.pi, "sideslip": 180 / np.pi, "steering": 180 / np.pi}
    usual |= dict.fromkeys(["lateral_acceleration", "longitudinal_acceleration"], 1 / G)
    log.assign(**{c: log[c] * f for c, f in usual.items()}).rename(columns=names).to_csv(file, index=False)
    found, wanted = (axle_recording(d, CAR, "front") for d in (read_recording(file), log))
    for channel in ("slip_angle", "fy", "normal_load"):
        np.testing.assert_allclose(found[channel], wanted[channel], rtol=1e-6, atol=1e-9)


def test_a_path_in_millimetres_becomes_metres(tmp_path):
    path = pd.DataFrame({"time": TIME, "x": SPEED * TIME, "y": 0.0, "yaw": 0.0})
    file = tmp_path / "path.csv"
    path.assign(x=path["x"] * 1e3, y=0.0).set_axis(
        ["time [s]", "x [mm]", "y [mm]", "yaw [deg]"], axis=1
    ).assign(speed=SPEED).to_csv(file, index=False)
    found = axle_recording(read_recording(file), CAR)
    assert found["speed"].median() == pytest.approx(SPEED)
    assert any("x converted from mm" in note for note in found.attrs["notes"])


def test_the_slip_of_a_vehicle_that_was_read_as_that_of_a_tire_is_said():
    log = drive(slip_angle=0.01).drop(columns="lateral_speed")
    log = log.assign(**{c: log[c] + 0.1 for c in ("yaw_rate", "lateral_acceleration")})
    log["lateral_acceleration"] = log["speed"] * log["yaw_rate"]
    with pytest.raises(RecordingError, match="if that is the vehicle's sideslip, name it `sideslip`"):
        axle_recording(log.iloc[100:250], CAR, bandwidth=5.0)


def test_the_noise_of_a_wheel_speed_is_in_the_slip_ratio():
    noise = np.random.default_rng(0).normal(0.0, 0.15, TIME.size)
    found = axle_recording(drive().assign(wheel_surface_speed=SPEED * 1.02 + noise), CAR)
    off = np.abs(found["slip_ratio"] - 0.02) / found["slip_ratio_std"]
    assert 0.9 < np.mean(off < 2.0) < 0.99


@pytest.mark.parametrize("axle", ["front", "rear"])
def test_the_mean_wheel_has_half_of_the_axles_load_and_forces(axle):
    car = replace(CAR, front_drive_share=0.4)
    whole, mean = (axle_recording(drive(), car, axle, wheels=n) for n in (1, 2))
    for channel in ("fx", "fy", "fy_std", "normal_load", "normal_load_std"):
        np.testing.assert_allclose(mean[channel], whole[channel] / 2)
    np.testing.assert_allclose(mean["slip_angle"], whole["slip_angle"])
    assert any("wheels=2 compares them with a file of one tire" in n for n in whole.attrs["notes"])
    assert any("mean of the axle's two wheels" in n for n in mean.attrs["notes"])
    with pytest.raises(RecordingError, match="wheels=4"):
        axle_recording(drive(), car, axle, wheels=4)


@pytest.mark.parametrize(("factor", "said"), [(-1.0, "to the other side"), (np.degrees(1.0), "degrees")])
@pytest.mark.parametrize("channel", ["lateral_speed", "sideslip"])
def test_a_lateral_speed_that_the_acceleration_contradicts_is_refused(channel, factor, said):
    there = replace(CAR, marker_offset=CAR.rear_length + 1.5)
    log = drive(1.5)
    log["sideslip"] = np.arctan2(log["lateral_speed"], log["speed"])
    log = log.drop(columns={"lateral_speed", "sideslip"} - {channel})
    axle_recording(log, there)
    with pytest.raises(RecordingError, match=said):
        axle_recording(log.assign(**{channel: log[channel] * factor}), there)


def test_text_in_a_channel_is_refused():
    with pytest.raises(RecordingError, match="speed of the drive holds text"):
        axle_recording(drive().assign(speed="fast"), CAR)


def test_a_tenth_of_the_sampling_rate_is_a_bandwidth():
    log = drive().iloc[::10].reset_index(drop=True)
    log["time"] = np.round(log["time"] + 1e-9 * np.sin(TIME[::10]), 10)
    assert len(axle_recording(log, CAR, bandwidth=1.0)) > 20


def test_an_integrated_lateral_speed_says_how_far_it_may_drift():
    """Turns to one side between straights, felt by an accelerometer that leans with the body."""
    rate = TURN * np.clip(np.sin(2 * np.pi * 0.1 * TIME), 0.0, None)
    log = drive().assign(
        yaw_rate=rate, lateral_acceleration=1.1 * SPEED * rate, longitudinal_acceleration=0.0
    )
    found = axle_recording(log.drop(columns="lateral_speed"), CAR)
    true = np.arctan2(-CAR.rear_length * np.interp(found["time"], TIME, rate), SPEED)
    off = np.abs(found["slip_angle"] - true)
    assert np.mean(off < 2 * found["slip_angle_std"]) > 0.9
    assert off.max() > 0.02
    assert any("leans with the body" in note for note in found.attrs["notes"])
    assert not any("times what speed" in note for note in found.attrs["notes"])


@pytest.mark.parametrize("axle", ["front", "rear"])
def test_the_mean_wheel_knows_the_load_that_one_takes_over_from_the_other(axle):
    """Both axles balance the moment of the lateral acceleration about the road: m a_y h = 2 dFz t."""
    car = replace(CAR, track=1.5)
    mean = axle_recording(drive(), car, axle, wheels=2)
    expected = 1500.0 * np.abs(mean["lateral_acceleration"]) * 0.5 / (2.0 * 1.5)
    np.testing.assert_allclose(mean["load_transfer"], expected, atol=2.0)
    assert mean.attrs["assumed"][1] == "load and forces are those of the mean of the axle's two wheels"
    for unknown in (replace(car, track=None), replace(car, cg_height=None)):
        without = axle_recording(drive(), unknown, axle, wheels=2)
        assert "load_transfer" not in without
        assert any("looks like less friction" in note for note in without.attrs["notes"])
    assert "load_transfer" not in axle_recording(drive(), car, axle)
