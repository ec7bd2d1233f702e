"""What a report calls noise, errors of a force in another unit, places where the force goes through zero."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from located_mismatch import located
from mismatch_shared import shared
from weighed import all_but

from tire_pipeline.magic_formula import fit_magic_formula
from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.corrected.as_recorded import without_unnamed
from tire_pipeline.recordings import DART_CAR, axle_recording, read_dart, read_recording
from tire_pipeline.tir import read_tir

EXAMPLES = Path(__file__).parents[3] / "examples"
AXLE = ["slip_angle", "normal_load", "fy"]
FEW = {"without": all_but("friction_scale", "stiffness_scale", "force_offset", "force_gain")}
"""Sets of a few effects are weighed where none of the others says what noise is."""


def axle(folder, number=0):
    return axle_recording(
        read_dart(sorted(shared(f"recordings/dart/{folder}").glob("*.csv"))[number]), DART_CAR
    )


@pytest.mark.parametrize(
    ("folder", "number"),
    [
        ("free_driving", 0),
        ("second_session", 0),
        pytest.param("second_session", 1, marks=pytest.mark.long),
    ],
)
def test_noise_is_no_larger_than_what_is_left(folder, number):
    """It was 0.32 N beside an error of 0.19 N: the uncertainty of marker and masses was taken for noise."""
    drive = axle(folder, number)
    assert "slip_angle_std" in drive
    tire = fit_magic_formula(axle("free_driving")[AXLE]).model
    report = explain_mismatch(tire, drive, **FEW)
    fit = report.fit["fy"]
    assert 0.0 < fit.noise_floor <= min(fit.rms_before, fit.rms_after)
    assert report.series["floor_fy"] <= fit.rms_after


def test_the_error_of_a_force_in_kilonewtons_is_in_newtons():
    """It fell to 7.6 N where the same recording in N leaves 58 N.

    Without the equation of the pressure, whose choice in each fold may turn on the last digit.
    """
    tire = read_tir(EXAMPLES / "tire.tir")
    run = read_recording(EXAMPLES / "rig_run.csv", axes="ISO").iloc[::4]
    reports = [explain_mismatch(tire, run.assign(fy=run["fy"] / unit), **FEW) for unit in (1.0, 1e3)]
    assert {report.unnamed.physics.depends_on for report in reports} == {("pressure",)}
    right, wrong = (without_unnamed(report.fit, report.unnamed)["fy"] for report in reports)
    for name in ("noise_floor", "rms_after", "rms_after_low", "rms_after_high"):
        assert getattr(wrong, name) == pytest.approx(getattr(right, name), rel=1e-6)


def test_samples_of_a_stuck_channel_are_no_noise(tire, record):
    """They are taken out before anything is weighed, but are among the rows of which the errors are."""
    recording = record(3)
    whole = explain_mismatch(tire, recording, **FEW).fit["fy"]
    recording.loc[2000:2300, "fy"] = recording["fy"].iloc[2000]
    report = explain_mismatch(tire, recording, **FEW)
    assert [effect.name for effect in report.effects] == ["stuck_channel"]
    errors = report.fit["fy"]
    assert errors.rms_after < 0.5 * errors.rms_before  # what is left does not hold the stuck samples
    assert report.fit["fy"].noise_floor < 1.2 * whole.noise_floor < report.fit["fy"].rms_before


@pytest.fixture(scope="module")
def sweeps_of_slip():
    tire = read_tir(EXAMPLES / "tire.tir")
    time = np.arange(0.0, 120.0, 0.04)
    rig = {"time": time, "slip_angle": 0.15 * np.sin(0.8 * time), "speed": 20.0}
    rig["normal_load"] = np.array([2500.0, 5000.0])[(time // 30.0).astype(int) % 2]
    forces = tire.forces(slip_angle=rig["slip_angle"], normal_load=rig["normal_load"])
    noise = np.random.default_rng(0).normal(0.0, 20.0, time.size)
    return tire, pd.DataFrame(rig).assign(fy=forces.fy + noise)


def test_a_force_to_one_side_where_it_goes_through_zero_is_neither_lower_nor_higher(sweeps_of_slip):
    tire, rig = sweeps_of_slip
    small = rig["slip_angle"].abs() < 0.02
    found, _, said = located(tire, rig.assign(fy=rig["fy"] + 250.0 * small))
    first = found[0]
    assert (first.axis, first.along_force) == ("slip_angle", False)
    assert first.mean == pytest.approx(250.0, rel=0.3)  # the stretch is wider on one side
    assert "lower" not in said
    assert "higher" not in said
    assert f"differs from the model by +{first.mean:.3g} N on average" in said


def test_a_smaller_force_to_both_sides_is_lower_and_its_place_the_largest(sweeps_of_slip):
    tire, rig = sweeps_of_slip
    small = rig["slip_angle"].abs() < 0.02
    found, _, said = located(tire, rig.assign(fy=rig["fy"] * np.where(small, 0.8, 1.0)))
    assert found[0].along_force
    assert -0.2 < found[0].share < -0.1
    assert "% of the force there) lower than the model" in said
