"""Before any explanation: whether a recording carries an answer."""

import numpy as np
import pytest
from mismatch_shared import shared
from scipy.ndimage import uniform_filter1d

from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula.fitting import fit_magic_formula
from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.recordings import DART_CAR, axle_recording, read_dart

AXLE = ["slip_angle", "normal_load", "fy"]


def ruined(slip, time, how, size=1.0):
    rng = np.random.default_rng(3)
    spread = slip.std()
    if how == "shuffled":
        return rng.permutation(slip)
    width = max(int(size / np.median(np.diff(time))), 1)
    if how == "smoothed":
        return uniform_filter1d(slip, width)
    if how == "still":
        return slip.mean() + 1e-4 * rng.standard_normal(slip.size)
    noise = uniform_filter1d(rng.standard_normal(slip.size), width if how == "slow noise" else 1)
    return slip + 1.5 * spread * noise / noise.std()


_LONG = pytest.mark.long
RUINS = [("shuffled", 1.0), ("smoothed", 20.0), ("still", 1.0), ("noise", 1.0), ("slow noise", 2.0)]


@pytest.fixture(scope="module")
def free_drive():
    (file,) = (shared("recordings/dart") / "free_driving").glob("*.csv")
    drive = axle_recording(read_dart(file), DART_CAR)
    return fit_magic_formula(drive[AXLE]).model, drive


def check_unusable(report, tmp_path):
    assert report.verdict == "unusable"
    assert not [e for e in report.effects if e.kind == "physics"]
    assert "%" in report.summary
    assert "Look at" in report.next_experiment
    assert all(c["gain"] is None and not c["accepted"] for c in report.candidates)
    with pytest.raises(RecordingError, match="nothing corrected is written"):
        report.corrected.to_tir(tmp_path / "corrected.tir")
    assert "unusable" in report.to_html(tmp_path / "page.html").read_text()
    assert report.to_dict()["question"]["verdict"] == "unusable"


@pytest.mark.parametrize(("how", "size"), RUINS)
def test_a_drive_whose_slip_is_worth_nothing_is_unusable(free_drive, how, size, tmp_path):
    tire, drive = free_drive
    slip = ruined(drive["slip_angle"].to_numpy(), drive["time"].to_numpy(), how, size)
    check_unusable(explain_mismatch(tire, drive.assign(slip_angle=slip)), tmp_path)


@pytest.mark.parametrize(
    ("how", "size"),
    [ruin if ruin[0] in ("noise", "slow noise") else pytest.param(*ruin, marks=_LONG) for ruin in RUINS],
)
def test_nor_does_a_model_help_that_was_fitted_to_it(free_drive, how, size, tmp_path):
    """Of the log in the issue eight fits were tried."""
    _, drive = free_drive
    slip = ruined(drive["slip_angle"].to_numpy(), drive["time"].to_numpy(), how, size)
    wrong = drive.assign(slip_angle=slip)
    check_unusable(explain_mismatch(fit_magic_formula(wrong[AXLE]).model, wrong), tmp_path)


@pytest.mark.parametrize(
    ("how", "size"),
    [ruin if ruin[0] in ("shuffled", "slow noise") else pytest.param(*ruin, marks=_LONG) for ruin in RUINS],
)
def test_a_rig_sweep_whose_slip_is_worth_nothing_is_unusable(tire, record, how, size, tmp_path):
    r = record(0)
    slip = ruined(r["slip_angle"].to_numpy(), r["time"].to_numpy(), how, size)
    check_unusable(explain_mismatch(tire, r.assign(slip_angle=slip)), tmp_path)


def test_the_drive_as_it_is_can_be_used(free_drive):
    tire, drive = free_drive
    assert prepare(tire, drive).question is None


@pytest.mark.parametrize(
    "change",
    [
        {"friction": 0.5},
        {"stiffness": 0.6},
        {"offset": 1500.0},
        {"delay": 0.3},
        {"pressure_effect": 0.6},
        {"noise": 300.0},
    ],
)
def test_what_is_far_off_but_driven_by_slip_can_be_used(tire, record, change):
    assert prepare(tire, record(0, **change)).question is None


def test_a_slip_ratio_that_means_nothing_is_left_out(braked, record):
    """Free rolling in the consortium's files: SL is -1 throughout."""
    prepared = prepare(braked.replace(RBY1=10.0, RCY1=1.0), record(0).assign(slip_ratio=-1.0))
    assert prepared.question is None
    assert any("slip_ratio is -1 throughout" in n for n in prepared.notes)
    assert "slip_ratio" not in prepared.data.present


def test_one_force_that_its_slip_does_not_drive_is_left_out(braked, record):
    r = record(0)
    rng = np.random.default_rng(0)
    t = r["time"].to_numpy()
    slip = 0.08 * np.sin(2.0 * np.pi * t / 11.0)
    fx = braked.forces(slip_ratio=slip, normal_load=r["normal_load"].to_numpy()).fx
    fy = braked.forces(
        slip_angle=r["slip_angle"].to_numpy(), slip_ratio=slip, normal_load=r["normal_load"].to_numpy()
    ).fy
    r = r.assign(slip_ratio=slip, fy=fy, fx=rng.permutation(fx))
    prepared = prepare(braked, r)
    assert prepared.question is None
    assert prepared.data.outputs == ("fy",)
    assert any(n.startswith("fx is left out") for n in prepared.notes)
