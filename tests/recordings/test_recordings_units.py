"""Every unit has the size that the field gives it."""

from __future__ import annotations

import numpy as np
import pytest

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings import read_recording


@pytest.mark.parametrize(
    ("name", "unit", "column", "si"),
    [
        ("t", "min", "time", 420.0),
        ("t", "us", "time", 7e-6),
        ("SA", "mrad", "slip_angle", 0.007),
        ("FZ", "daN", "normal_load", 70.0),
        ("FZ", "lbf", "normal_load", 31.1375513068235),
        ("FZ", "kp", "normal_load", 68.64655),
        ("MZ", "kNm", "mz", 7000.0),
        ("MZ", "Nmm", "mz", 0.007),
        ("MZ", "ft-lb", "mz", 9.49072563832),
        ("MZ", "in-lb", "mz", 0.790893803193),
        ("V", "mm/s", "speed", 0.007),
        ("V", "mph", "speed", 3.12928),
        ("V", "ft/s", "speed", 2.1336),
        ("P", "hPa", "pressure", 700.0),
        ("P", "MPa", "pressure", 7e6),
        ("P", "psi", "pressure", 48263.301051),
        ("TSTC", "K", "tread_temperature", -266.15),
        ("TSTC", "degF", "tread_temperature", -13.888888889),
        ("RL", "cm", "loaded_radius", 0.07),
        ("RL", "inch", "loaded_radius", 0.1778),
        ("RL", "ft", "loaded_radius", 2.1336),
        ("wheel_speed", "rpm", "wheel_speed", 0.73303828584),
        ("wheel_speed", "rev/s", "wheel_speed", 43.982297150),
        ("yaw_rate", "deg/s", "yaw_rate", 0.12217304764),
        ("lateral_acceleration", "g", "lateral_acceleration", 68.64655),
    ],
)
def test_the_size_of_a_unit(tmp_path, name: str, unit: str, column: str, si: float):
    file = tmp_path / "a.csv"
    file.write_text(f"{name} [{unit}],FY [N]\n7,1\n7,2\n")
    np.testing.assert_allclose(read_recording(file)[column], si, rtol=1e-9)


def test_a_channel_that_no_column_holds_may_be_a_number(tmp_path):
    file = tmp_path / "braking.csv"
    file.write_text("SL [-],FZ [N],FX [N]\n-0.1,4000,-3000\n0.1,4000,3000\n", "utf-8")
    named = read_recording(file, names={"slip_angle": 0, "camber": "2"}, units={"camber": "deg"})
    assert named["slip_angle"].tolist() == [0.0, 0.0]
    assert named["camber"].to_numpy() == pytest.approx(np.radians([2.0, 2.0]))
    assert "slip_angle is 0 throughout, as was stated" in named.attrs["notes"]
    with pytest.raises(RecordingError, match="slip_angel is stated to be 0, but it is no channel"):
        read_recording(file, names={"slip_angel": 0})
