"""``tire fit``: a file from recordings, and what a poor fit says."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
from command_line import page, record, run, told

from tire_pipeline.tir import read_tir

pytestmark = pytest.mark.slow


def test_fit_writes_what_was_measured(folder):
    record("run.csv")
    before = (folder / "run.csv").read_bytes()
    found = told("fit", "run.csv", "-o", "out.tir", "--unloaded-radius", "0.305")
    fitted = read_tir("out.tir")
    assert fitted.value("UNLOADED_RADIUS") == 0.305
    assert (folder / "run.csv").read_bytes() == before
    assert fitted.coefficients["PDY1"] == pytest.approx(found["coefficients"]["PDY1"])
    assert found["relative_rms"]["fy"] < 0.01
    angles = pd.read_csv("run.csv")["slip_angle"]
    assert fitted.ranges["slip_angle"][2:] == pytest.approx((angles.min(), angles.max()), abs=1e-6)
    assert "camber" not in fitted.ranges, "one camber is no range"
    there = read_tir("a.tir").forces(slip_angle=0.1, normal_load=4500.0).fy
    assert fitted.forces(slip_angle=0.1, normal_load=4500.0).fy == pytest.approx(there, rel=0.02)
    assert "Points: measured at pure slip" in page(folder / "out_fit.html")
    assert "out.tir" in run("fit", "run.csv", "-o", "out.tir", code=2).stderr


def test_fit_gives_no_residual_of_a_force_that_it_could_not_fit(folder):
    record("run.csv", seconds=30.0)
    pd.read_csv("run.csv").assign(fx=12.0).to_csv("run.csv", index=False)
    found = told("fit", "run.csv", "-o", "out.tir", "--no-page")
    assert "fx" in found["not_fitted"]
    assert "fx" not in found["relative_rms"]
    shown = run("fit", "run.csv", "-o", "out2.tir", "--no-page").stdout
    assert "Fx: recorded, but" in shown
    assert "note: not determined by the data: no camber sweeps: PDY3" in shown
    assert "There is no longitudinal force" in run("show", "out.tir", "--no-page").stdout


def test_a_poor_fit_does_not_look_like_a_success(folder):
    record("run.csv", seconds=30.0)
    degrees = pd.read_csv("run.csv").assign(slip_angle=lambda r: np.degrees(r["slip_angle"]))
    degrees.to_csv("run.csv", index=False)
    result = run("fit", "run.csv", "-o", "out.tir")
    lines = result.stdout.split("\n")
    assert lines[1].startswith("POOR FIT of Fy, not to be used:")
    assert "slip_angle looks like degrees" in result.stdout.replace("\n", " ")
    assert "POOR FIT of Fy, not to be used" in page(folder / "out_fit.html")
    assert "POOR FIT of Fy, not to be used" in (folder / "out.tir").read_text()


def test_fit_takes_several_recordings_together(folder):
    record("run1.csv", seconds=30.0)
    record("run2.csv", seed=1, seconds=30.0)
    found = told("fit", "run1.csv", "run2.csv", "-o", "out.tir", "--start", "a.tir", "--no-page")
    assert found["recordings"] == ["run1.csv", "run2.csv"]
    assert any("joined" in note for note in found["notes"])


def test_fit_takes_each_slip_from_its_own_recording(folder):
    """It was refused: each lacked a slip that varies in the other, and had no force in common with it."""
    record("cornering.csv", seconds=30.0)
    table = pd.read_csv("cornering.csv")
    ratio, load = table["slip_angle"].to_numpy(), table["normal_load"].to_numpy()
    fx = read_tir("a.tir").forces(slip_ratio=ratio, normal_load=load).fx
    braking = table[["time", "normal_load"]].assign(slip_ratio=ratio, fx=fx)
    braking.to_csv("braking.csv", index=False)
    both = ("fit", "cornering.csv", "braking.csv", "-o", "out.tir", "--no-page")
    assert "--name braking.csv:slip_angle=0" in run(*both, code=2).stderr
    found = told(*both, "--name", "braking.csv:slip_angle=0", "--name", "cornering.csv:slip_ratio=0")
    assert sorted(found["relative_rms"]) == ["fx", "fy"]
    assert found["coefficients"]["PKX1"] == pytest.approx(read_tir("a.tir").value("PKX1"), rel=0.02)


def test_fit_says_which_slip_ratio_it_was_given(folder):
    record("run.csv", seconds=30.0)
    slip = 0.1 * np.sin(np.linspace(0.0, 40.0, len(pd.read_csv("run.csv"))))
    ratio = {"wheel_speed": (1.0 + slip) / 0.31 * 10.0, "speed": 10.0, "loaded_radius": 0.3}
    given = pd.read_csv("run.csv").assign(slip_ratio=0.3 / 0.31 * (1.0 + slip) - 1.0, **ratio)
    given.to_csv("run.csv", index=False)
    found = told("fit", "run.csv", "-o", "out.tir", "--no-page")
    assert any("which is wheel_speed x loaded_radius / speed - 1" in note for note in found["notes"])
