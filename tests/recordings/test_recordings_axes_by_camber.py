"""Axes of a file: stated, told by the force of a leaning wheel, and those in which Fy rises with slip."""

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.recordings import check_recording, read_recording


def written(folder, axes, cambers=(0.0, 2.0), of_load=-1.0):
    """A CSV of sweeps at some cambers (deg) in ISO or SAE axes, with a load of some sign; and its true Fy."""
    rng = np.random.default_rng(2)
    slip = np.tile(0.15 * np.sin(np.linspace(0.0, 8.0 * np.pi, 400)), len(cambers))
    camber, load = np.repeat(np.radians(cambers), 400), np.tile([3000.0, 4500.0], 200 * len(cambers))
    fy = -load * (np.tanh(12.0 * slip) + camber) + 20.0 * rng.standard_normal(slip.size)
    y = -1.0 if axes == "SAE" else 1.0
    table = pd.DataFrame({"SA [deg]": y * np.degrees(slip), "IA [deg]": np.degrees(camber)})
    table = table.assign(**{"FZ [N]": of_load * load, "FY [N]": y * fy})
    table.to_csv(folder / "run.csv", index=False)
    return folder / "run.csv", fy


@pytest.mark.parametrize("axes", ["ISO", "SAE"])
def test_a_negative_load_and_camber_tell_the_axes(tmp_path, axes):
    file, fy = written(tmp_path, axes)
    recording = read_recording(file)
    np.testing.assert_allclose(recording["fy"], fy, atol=1e-6)
    assert recording.attrs["assumed"][0].startswith(f"{axes} axes, which were not stated: Fz is negative")
    assert recording.attrs["axes_unclear"] == ""
    assert (recording["normal_load"] > 0.0).all()
    assert not any("read it with axes" in note for note in recording.attrs["notes"])
    assert not any("ISO W assumed" in note for note in recording.attrs["notes"])


def test_without_camber_the_axes_stay_open(tmp_path):
    file, fy = written(tmp_path, "SAE", cambers=(0.0, 0.0))
    recording = read_recording(file)
    np.testing.assert_allclose(recording["fy"], -fy, atol=1e-6)
    assert "as in SAE axes" in recording.attrs["axes_unclear"]


def test_stated_axes_are_taken(tmp_path):
    file, fy = written(tmp_path, "SAE")
    recording = read_recording(file, axes="ISO")
    np.testing.assert_allclose(recording["fy"], -fy, atol=1e-6)
    assert recording.attrs["assumed"][0] == "ISO axes, as stated"
    assert "camber_of_other_sign" in {issue.name for issue in check_recording(recording)}


def test_with_a_positive_load_the_axes_are_not_changed_but_the_check_tells(tmp_path):
    file, fy = written(tmp_path, "SAE", of_load=1.0)
    recording = read_recording(file)
    np.testing.assert_allclose(recording["fy"], -fy, atol=1e-6)
    assert "camber_of_other_sign" in {issue.name for issue in check_recording(recording)}


@pytest.mark.parametrize("spelt", ["adapted SAE", "adapted_sae"])
def test_adapted_sae_axes_are_read_and_told(tmp_path, spelt):
    """Pacejka's axes: y to the right, and a slip angle that causes a side force of its own sign."""
    file, fy = written(tmp_path, "ISO", of_load=1.0)
    table = pd.read_csv(file)
    table = table.assign(**{"FY [N]": -fy, "MZ [Nm]": 0.03 * fy, "simulated_fy [N]": -fy})
    table.to_csv(file, index=False)
    assert "side_force_of_other_sign" in {issue.name for issue in check_recording(read_recording(file))}
    recording = read_recording(file, axes=spelt)
    for name, right in (("fy", fy), ("simulated_fy", fy), ("mz", -0.03 * fy)):
        np.testing.assert_allclose(recording[name], right, atol=1e-6)
    np.testing.assert_allclose(np.degrees(recording["slip_angle"]), table["SA [deg]"], atol=1e-6)
    assert "side_force_of_other_sign" not in {issue.name for issue in check_recording(recording)}


def test_simulated_forces_are_in_the_axes_of_the_recorded_ones(tmp_path):
    file, fy = written(tmp_path, "SAE", of_load=1.0)
    table = pd.read_csv(file)
    table.assign(**{"simulated_fy [N]": -fy}).to_csv(file, index=False)
    np.testing.assert_allclose(read_recording(file, axes="SAE")["simulated_fy"], fy, atol=1e-6)
