"""TYDEX: the standard's scaling, axis systems, and the published file."""

import os
from pathlib import Path

import numpy as np
import pytest

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings import read_recording

SHARED = Path(__file__).resolve().parents[3] / "shared" / "recordings" / "tydex"
REAL = SHARED / "DT_195_65R15_demo.tdx"


def need_shared():
    if not REAL.exists() and not os.environ.get("CI"):
        pytest.skip(f"{REAL} is not there: see data/01_raw/recordings/README.md")


def row(key, comment, unit, *values):
    return f"{key:<10}{comment:<30}{unit:<10}" + "".join(f"{v:<10}" for v in values)


def write(path, channels, data, constants=()):
    lines = ["**HEADER", row("RELEASE", "Release of TYDEX-Format", "", "1.3"), "**COMMENTS", "! new tire"]
    lines += ["**CONSTANTS", *constants, "**MEASURCHANNELS", "! a comment", *channels, "**MEASURDATA"]
    lines += [" ".join(f"{v:.8g}" for v in r) for r in data] + ["**END", "rubbish after the end"]
    path.write_text("\n".join(lines))
    return path


def test_scaling_and_units(tmp_path):
    channels = [
        row("RUNTIME", "Running time", "s", 1, 0, 0),
        row("SLIPANGL", "Slip angle", "deg", 2, 1, 0.5),
        row("FZW", "Vertical force", "kN", 1, 0, 0),
        row("FYW", "Lateral force", "N", -1, 0, 0),
        row("TRAJVELW", "Trajectory velocity", "km/h", 1, 0, 0),
        row("LONGSLIP", "Longitudinal slip", "%", 1, 0, 0),
    ]
    data = [[0.0, 1.0, 3.0, 100.0, 36.0, 5.0], [0.1, 2.0, 3.1, 200.0, 36.0, 10.0]]
    constants = [row("INFLPRES", "Inflation pressure", "bar", 2.5), row("TRCKCOND", "Track", "", "DRY")]
    recording = read_recording(write(tmp_path / "a.tdx", channels, data, constants))
    # physical = factor * (measured + offset1) + offset2
    np.testing.assert_allclose(np.degrees(recording["slip_angle"]), [2 * 2 + 0.5, 2 * 3 + 0.5])
    np.testing.assert_allclose(recording["normal_load"], [3000, 3100])
    np.testing.assert_allclose(recording["fy"], [-100, -200])
    np.testing.assert_allclose(recording["speed"], 10.0)
    np.testing.assert_allclose(recording["slip_ratio"], [0.05, 0.1])
    np.testing.assert_allclose(recording["pressure"], 250e3)
    assert not recording.attrs["steady_points"]
    assert recording.attrs["comments"] == ["new tire"]
    assert recording.attrs["constants"]["TRCKCOND"]["value"] == "DRY"


def test_wrapped_rows_and_fortran_exponents(tmp_path):
    file = tmp_path / "a.tdx"
    keys = ["SLIPANGL", "FZW", "FYW"]
    body = "\n".join(row(k, "", u, 1, 0, 0) for k, u in zip(keys, ["deg", "N", "N"], strict=True))
    file.write_text(f"**MEASURCHANNELS\n{body}\n**MEASURDATA\n1 3D3\n-5.0E1\n2 3000\n-90\n**END\n")
    recording = read_recording(file)
    np.testing.assert_allclose(recording["fy"], [-50, -90])
    np.testing.assert_allclose(recording["normal_load"], 3000)


@pytest.mark.parametrize("system", ["W", "H", "C"])
def test_all_axis_systems_give_the_same_forces(tmp_path, system):
    """Forces and moments known in W are written in each system, by rotation and lever arm."""
    rng = np.random.default_rng(0)
    count, radius = 20, 0.31
    camber = rng.uniform(-0.1, 0.1, count)
    force = np.column_stack(
        [rng.normal(0, 500, count), rng.normal(0, 2000, count), rng.uniform(2e3, 5e3, count)]
    )
    moment = rng.normal(0, 50, (count, 3))
    arm = radius * np.column_stack([camber * 0, -np.sin(camber), np.cos(camber)])
    written_force, written_moment = force.copy(), moment.copy()
    if system != "W":
        written_moment = moment - np.cross(arm, force)
    if system == "C":
        for vector in (written_force, written_moment):
            y, z = vector[:, 1].copy(), vector[:, 2].copy()
            vector[:, 1] = y * np.cos(camber) + z * np.sin(camber)
            vector[:, 2] = z * np.cos(camber) - y * np.sin(camber)
    names = [f"{kind}{axis}{system}" for kind in "FM" for axis in "XYZ"]
    channels = [row("INCLANGL", "Inclination", "rad", 1, 0, 0)]
    channels += [row(n, "", "N" if n[0] == "F" else "Nm", 1, 0, 0) for n in names]
    data = np.column_stack([camber, written_force, written_moment])
    constants = [row("LOADRAD", "Loaded radius", "m", radius)]
    recording = read_recording(write(tmp_path / "a.tdx", channels, data, constants))
    np.testing.assert_allclose(recording[["fx", "fy", "normal_load"]], force, rtol=1e-6, atol=1e-3)
    np.testing.assert_allclose(recording[["mx", "my", "mz"]], moment, rtol=1e-5, atol=1e-3)


def test_without_a_loaded_radius_half_of_the_diameter_is_the_arm_and_that_is_said(tmp_path):
    channels = [row(n, "", u, 1, 0, 0) for n, u in (("FYH", "N"), ("FXH", "N"), ("FZH", "N"), ("MXH", "Nm"))]
    constants = [row("OVALLDIA", "Overall diameter", "mm", 600)]
    recording = read_recording(write(tmp_path / "a.tdx", channels, [[1000.0, 0.0, 4000.0, 20.0]], constants))
    np.testing.assert_allclose(recording["mx"], 20.0 - 0.3 * 1000.0)
    assert any("by half of OVALLDIA" in text for text in recording.attrs["conversions"])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("**MEASURCHANNELS\nFZW  {x}\n", "without measurements"),
        ("**MEASURCHANNELS\n**MEASURDATA\n1 2\n", "MEASURCHANNELS is empty"),
        ("**MEASURCHANNELS\n{c}\n**MEASURDATA\n1 x\n", "something other than numbers"),
        ("**MEASURCHANNELS\n{c}\n**MEASURDATA\n1 2 3\n4\n", r"a.tdx:4: a data row does not hold 1"),
        ("**MEASURCHANNELS\n{c}\n**MEASURDATA\n", "MEASURDATA is empty"),
        ("**MEASURCHANNELS\n{b}\n**MEASURDATA\n1\n", "factor and offsets"),
    ],
)
def test_bad_files_name_the_line(tmp_path, text, message):
    good, bad = row("FZW", "", "N", 1, 0, 0), row("FZW", "", "N", "one", 0, 0)
    file = tmp_path / "a.tdx"
    file.write_text(text.replace("{c}", good).replace("{b}", bad))
    with pytest.raises(RecordingError, match=message):
        read_recording(file, format="TYDEX")


def test_the_published_file():
    need_shared()
    recording = read_recording(REAL)
    assert len(recording) == 111
    assert recording.attrs["steady_points"]
    assert recording.attrs["constants"]["OVALLDIA"]["value"] == 580
    assert recording["normal_load"].between(700, 9400).all()
    np.testing.assert_allclose(recording["pressure"], 250e3)
    # ISO W: a positive slip angle gives a negative lateral force and a positive aligning moment,
    # a positive camber a negative lateral force.
    turned = recording[recording["slip_angle"].abs() > np.radians(0.9)]
    assert (np.sign(turned["fy"]) == -np.sign(turned["slip_angle"])).all()
    small = turned[turned["slip_angle"].abs() < np.radians(3)]
    assert (np.sign(small["mz"]) == np.sign(small["slip_angle"])).all()
    straight = recording[recording["slip_angle"].abs() < np.radians(0.1)]
    heavy = straight[straight["normal_load"] > 4000]
    slope = np.polyfit(heavy["camber"], heavy["fy"], 1)[0]
    assert slope < 0
