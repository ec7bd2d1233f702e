"""A lag in distance and a lag in time in real recordings: only different speeds tell them apart."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
from mismatch_shared import shared
from weighed import named_sets

from tire_pipeline.magic_formula import fit_magic_formula
from tire_pipeline.mismatch.effects.shared import first_order
from tire_pipeline.recordings import DART_CAR, axle_recording, read_dart, read_recording

AXLE = ["slip_angle", "normal_load", "fy"]
_LONG = pytest.mark.long
IN_TIME = {"time_delay", "low_pass"}


def relaxation_alone(sets):
    """Sets in which a relaxation is named without the lags in time that look like it."""
    return [names for names in sets if "relaxation_length" in names and not IN_TIME & names]


@pytest.fixture(scope="module", params=["SAE", "ISO"])
def belt(request):
    """The flat belt in its own axes, and as its mirror image."""
    rows = read_recording(shared("recordings/calspan/cornering_part.mat"), axes=request.param)
    flat = rows[(rows["camber"].abs() < 0.005) & (rows["pressure"] < 9e4)].reset_index(drop=True)
    channels = ["slip_angle", "normal_load", "fy"]
    return fit_magic_formula(flat.iloc[::5][channels], unloaded_radius=0.2).model, flat


def belt_late_by(flat, delay, every):
    """The flat belt's rows, one of every few, with forces that are late within each sweep."""
    time, force = flat["time"].to_numpy(), flat["fy"].to_numpy()
    piece = np.cumsum(np.diff(time, prepend=time[0]) > 0.05)
    late = force.copy()
    for number in np.unique(piece):
        here = piece == number
        late[here] = np.interp(time[here] - delay, time[here], force[here])
    return flat.assign(fy=late).iloc[::every].reset_index(drop=True)


@pytest.mark.parametrize("delay", [pytest.param(0.02, marks=_LONG), 0.04, pytest.param(0.08, marks=_LONG)])
def test_a_delay_at_one_speed_is_no_relaxation_by_itself(belt, delay):
    tire, flat = belt
    assert relaxation_alone(named_sets(tire, belt_late_by(flat, delay, 5))) == []


@pytest.mark.parametrize("rate", [pytest.param(20, marks=_LONG), pytest.param(50, marks=_LONG), 100])
def test_a_delay_at_one_speed_is_named_beside_the_relaxation(belt, rate):
    """It was a relaxation or a low-pass filter, 0.98, at 50 and 100 Hz."""
    tire, flat = belt
    sets = named_sets(tire, belt_late_by(flat, 0.08, 100 // rate))
    assert any({"relaxation_length", "time_delay"} <= names for names in sets), sets


def steered(command):
    """Road-wheel angle of the DART car by its makers' static map, rad (the car's own channel is a command).

    Coefficients of car 1 as Lorenzo-Lyons/DART publishes them.
    """
    side = 0.5 * (np.tanh(30.0 * (command + 0.019644200801849365)) + 1.0)
    left = 0.3301370143890381 * np.tanh(1.6379064321517944 * (command + 0.019644200801849365))
    right = 0.37879398465156555 * np.tanh(1.6578725576400757 * (command + 0.019644200801849365))
    return side * left + (1.0 - side) * right


def front_axle(path, rate):
    drive = read_dart(path)
    drive = drive.assign(steering=steered(drive["steering_command"]))
    return axle_recording(drive, DART_CAR, "front", rate=rate)[["time", "speed", *AXLE]]


@pytest.mark.parametrize(
    ("rate", "fitted"),
    [pytest.param(None, "ramps", marks=_LONG), (None, "drive"), pytest.param(20.0, "drive", marks=_LONG)],
)
def test_a_steering_actuator_that_lags_is_no_relaxation_of_the_tire(rate, fitted):
    """Its 0.13 s were a relaxation of 0.37 to 1.87 m on a wheel of 0.023 m, without an alternative."""
    folder = shared("recordings/dart")
    (file,) = (folder / "free_driving").glob("*.csv")
    ramps = sorted((folder / "rubber_floor_ramps").glob("*.csv"))[::2]
    drive = front_axle(file, rate)
    rows = drive if fitted == "drive" else pd.concat([front_axle(p, rate) for p in ramps], ignore_index=True)
    sets = named_sets(fit_magic_formula(rows[AXLE], unloaded_radius=0.023).model, drive)
    assert relaxation_alone(sets) == []


@pytest.mark.parametrize("samples", [0.02, 0.1, 0.3, 2.0, 10.0])
def test_what_follows_a_ramp_is_behind_by_its_lag_however_short(samples):
    """A lag of less than a seventh of a sample did nothing: its fit could not leave zero."""
    time = np.arange(200.0)
    behind = first_order(time, np.full(time.size, 1.0 / samples), time == 0.0)
    assert np.allclose(time[150:] - behind[150:], samples)
