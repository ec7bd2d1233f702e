"""Before any explanation: the units and axes that a recording must be in."""

import numpy as np
import pandas as pd
import pytest
from mismatch_shared import shared
from weighed import without_visible

from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula.fitting import fit_magic_formula
from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.recordings import read_recording


def findings(tire, recording):
    return [(f.name, f.channel) for f in prepare(tire, recording).findings]


def brake_sweeps(tire, thrust):
    """Brake sweeps at zero slip angle, and a side force by a camber that the model does not know."""
    rng = np.random.default_rng(0)
    t = np.arange(0.0, 80.0, 0.02)
    slip = -0.1 * (1.0 - np.cos(2.0 * np.pi * t / 5.0))
    load = np.array([2000.0, 4000.0, 6000.0, 3000.0])[(t // 20.0).astype(int)]
    fx = tire.forces(slip_ratio=slip, normal_load=load).fx
    return pd.DataFrame(
        {
            "time": t,
            "slip_angle": 2e-4 * rng.standard_normal(t.size),
            "slip_ratio": slip,
            "normal_load": load + 8.0 * rng.standard_normal(t.size),
            "fx": fx + 20.0 * rng.standard_normal(t.size),
            "fy": thrust * load / 4000.0 + 20.0 * rng.standard_normal(t.size),
        }
    )


@pytest.mark.parametrize("thrust", [0.0, 265.0, -400.0])
def test_a_force_that_the_model_does_not_have_says_nothing_about_its_unit(braked, thrust):
    """A thousandth of it always left less: "Fy wrong by 1000 (kN)"."""
    assert findings(braked, brake_sweeps(braked, thrust)) == []


@pytest.mark.parametrize(
    ("channel", "factor"), [("fx", 1e-3), ("fx", 1.0 / 4.4482216), ("slip_ratio", 100.0)]
)
def test_the_unit_of_a_force_that_the_model_has_is_still_found(braked, channel, factor):
    recording = brake_sweeps(braked, 265.0)
    wrong = recording.assign(**{channel: recording[channel] * factor})
    assert findings(braked, wrong) == [("unit_error", channel)]


@pytest.mark.parametrize("unit", [4.4482216, 9.80665, 1000.0])
def test_a_dozen_points_are_enough_for_a_wrong_unit(tire, unit):
    angles, loads = np.meshgrid([-0.12, -0.06, 0.0, 0.06, 0.1, 0.15], [3000.0, 5000.0])
    points = pd.DataFrame({"slip_angle": angles.ravel(), "normal_load": loads.ravel()})
    fy = tire.forces(slip_angle=points["slip_angle"], normal_load=points["normal_load"]).fy
    noise = 1.0 + 0.01 * np.random.default_rng(3).standard_normal(len(points))
    (found,) = prepare(tire, points.assign(fy=fy * noise / unit)).findings
    assert (found.name, found.channel) == ("unit_error", "fy")
    assert found.parameters["ratio"][0] == pytest.approx(1.0 / unit)


@pytest.mark.parametrize("turned", ["slip_angle", "fy"])
def test_a_dozen_points_are_enough_for_a_sign_that_is_wrong_throughout(tire, turned):
    angles, loads = np.meshgrid([-0.12, -0.06, 0.0, 0.06, 0.1, 0.15], [3000.0, 5000.0])
    points = pd.DataFrame({"slip_angle": angles.ravel(), "normal_load": loads.ravel()})
    fy = tire.forces(slip_angle=points["slip_angle"], normal_load=points["normal_load"]).fy
    points["fy"] = fy + 20.0 * np.random.default_rng(3).standard_normal(len(points))
    assert findings(tire, points) == []
    (found,) = prepare(tire, points.assign(**{turned: -points[turned]})).findings
    assert found.name == "sign_convention"
    assert turned in {found.channel, *(name for names in found.alike for name in names)}


@pytest.fixture(scope="module")
def cambered(tire):
    """A model with camber thrust and ply steer, and what it records at three cambers."""
    leaned = tire.replace(PVY3=0.35, PHY1=0.004, PVY4=-0.1)
    rng = np.random.default_rng(1)
    t = np.arange(0.0, 90.0, 0.02)
    slip = 0.15 * np.sin(2.0 * np.pi * t / 7.5)
    camber = np.radians([0.0, 3.0, -2.0])[(t // 30.0).astype(int)]
    load = np.array([2500.0, 5000.0])[(t // 15.0).astype(int) % 2]
    fy = leaned.forces(slip_angle=slip, camber=camber, normal_load=load).fy
    frame = pd.DataFrame({"time": t, "slip_angle": slip, "camber": camber, "normal_load": load})
    return leaned, frame.assign(fy=fy + 20.0 * rng.standard_normal(t.size))


@pytest.mark.parametrize("gain", [1.07, pytest.param(1.0, marks=pytest.mark.long)])
@pytest.mark.parametrize(
    "turned",
    [
        ("slip_angle", "fy"),
        ("fy",),
        ("camber",),
        pytest.param(("slip_angle",), marks=pytest.mark.long),
        pytest.param(("camber", "fy"), marks=pytest.mark.long),
        ("slip_angle", "camber"),
    ],
)
def test_axes_that_nobody_stated_are_the_finding_and_no_physics(cambered, turned, gain, tmp_path):
    tire, recording = cambered
    wrong = recording.assign(fy=gain * recording["fy"])
    wrong = wrong.assign(**{n: -wrong[n] for n in turned})
    report = explain_mismatch(tire, wrong)
    (found,) = [e for e in report.effects if e.name == "sign_convention"]
    assert found.output == ", ".join(turned)
    assert not [e.name for e in report.effects if e.kind == "physics"]
    assert report.corrected.question is not None
    assert "axes" in report.summary
    assert any("taken as -1 times" in a for a in report.assumed)
    with pytest.raises(RecordingError, match="nothing corrected is written") as caught:
        report.corrected.to_tir(tmp_path / "corrected.tir")
    assert "axes=" in caught.value.todo
    assert not list(tmp_path.iterdir())


def test_a_slip_angle_that_is_off_by_twice_the_ply_steer_is_no_sign(tire):
    """Turned axes would show the model's ply steer on the other side: so does an offset of twice its size."""
    steered = tire.replace(PHY1=-0.003, PVY1=0.0)
    slip = 0.15 * np.sin(2.0 * np.pi * np.arange(0.0, 60.0, 0.02) / 7.5)
    load = np.where(np.arange(slip.size) < slip.size // 2, 2500.0, 5000.0)
    fy = steered.forces(slip_angle=slip, normal_load=load).fy
    frame = pd.DataFrame({"time": np.arange(0.0, 60.0, 0.02), "normal_load": load})
    fy = fy + 20.0 * np.random.default_rng(1).standard_normal(slip.size)
    assert findings(steered, frame.assign(slip_angle=slip - 0.006, fy=fy)) == []


@pytest.mark.parametrize(("thrust", "over_load"), [(0.35, -0.1), (1.0, -0.3)])
def test_a_drift_of_the_force_is_no_sign(tire, thrust, over_load):
    """Sweeps at one camber, and later at another: a drift adds to the second what a mirrored thrust would."""
    leaned = tire.replace(PVY3=thrust, PVY4=over_load)
    t = np.r_[np.arange(0.0, 25.0, 0.02), np.arange(170.0, 182.5, 0.02)]
    slip = 0.15 * np.sin(2.0 * np.pi * t / 12.5)
    camber, load = np.where(t < 100.0, 0.0, 0.028), np.full(t.size, 2500.0)
    fy = leaned.forces(slip_angle=slip, camber=camber, normal_load=load).fy
    fy = fy + 20.0 * np.random.default_rng(1).standard_normal(t.size)
    recorded = pd.DataFrame({"time": t, "slip_angle": slip, "camber": camber, "normal_load": load})
    for drift in (-400.0, -200.0, -100.0, -50.0, 50.0, 100.0, 200.0, 400.0):
        assert findings(leaned, recorded.assign(fy=fy + drift * t / t[-1])) == []


def test_a_camber_of_another_size_is_no_sign(cambered):
    """The model's thrust is half of the true one: that has a size, and is physics."""
    tire, recording = cambered
    assert findings(tire.replace(PVY3=0.17), recording) == []


def test_a_doubt_about_axes_that_the_forces_do_not_settle_stays_open(tire, record, tmp_path):
    r = record(0, friction=0.9).iloc[:1250]
    path = tmp_path / "rig.csv"
    r.assign(normal_load=-r["normal_load"]).to_csv(path, index=False)
    report = explain_mismatch(tire, read_recording(path))
    assert report.corrected.question is not None
    assert "negative throughout" in report.summary
    assert any("ISO W axes, which were not stated" in a for a in report.assumed)
    page = without_visible(report).to_html(tmp_path / "page.html").read_text()
    assert "Assumed:" in page
    with pytest.raises(RecordingError, match="negative throughout"):
        report.corrected.to_tir(tmp_path / "corrected.tir")
    settled = explain_mismatch(tire, read_recording(path, axes="ISO"))
    assert settled.corrected.question is None
    assert settled.corrected.to_tir(tmp_path / "corrected.tir").exists()


@pytest.mark.slow
@pytest.mark.parametrize("gain", [1.0, 1.07])
def test_a_real_rig_file_in_sae_axes_is_not_explained_by_camber(gain, tmp_path):
    """Read as ISO with a gain it was "explained: camber", and a corrected file was written."""
    file = shared("recordings/calspan") / "cornering_part.mat"
    told, untold = (read_recording(file, axes=axes).iloc[::5] for axes in ("SAE", None))
    rows = told["pressure"] > 75e3
    tire = fit_magic_formula(told[rows][["slip_angle", "camber", "normal_load", "fy"]]).model
    wrong = untold[rows].assign(fy=gain * untold["fy"][rows])
    report = explain_mismatch(tire, wrong)
    assert [e.output for e in report.effects if e.name == "sign_convention"] == ["slip_angle, fy"]
    assert "camber" not in [e.name for e in report.effects]
    with pytest.raises(RecordingError, match="only in other axes"):
        report.corrected.to_tir(tmp_path / "corrected.tir")
    assert prepare(tire, told[rows]).question is None
    level = told["camber"][rows].abs() < 0.01
    assert "negative throughout" in prepare(tire, wrong[level]).question.why
