"""What comes before any explanation: axes, units, clipping, and whether a recording carries an answer."""

import numpy as np
import pandas as pd
import pytest
from mismatch_shared import shared
from scipy.ndimage import uniform_filter1d

from tire_pipeline.concealed import make_case
from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.magic_formula.fitting import fit_magic_formula
from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.recordings import DART_CAR, axle_recording, read_dart, read_recording
from tire_pipeline.tir import read_tir

AXLE = ["slip_angle", "normal_load", "fy"]


def findings(tire, recording):
    return [(f.name, f.channel) for f in prepare(tire, recording).findings]


# Units


def braked(tire: TireModel) -> TireModel:
    return tire.replace(PCX1=1.6, PDX1=1.1, PEX1=0.1, PKX1=22.0, PKX3=0.2)


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
def test_a_force_that_the_model_does_not_have_says_nothing_about_its_unit(tire, thrust):
    """A thousandth of it always left less: "Fy wrong by 1000 (kN)"."""
    assert findings(braked(tire), brake_sweeps(braked(tire), thrust)) == []


@pytest.mark.parametrize(
    ("channel", "factor"), [("fx", 1e-3), ("fx", 1.0 / 4.4482216), ("slip_ratio", 100.0)]
)
def test_the_unit_of_a_force_that_the_model_has_is_still_found(tire, channel, factor):
    recording = brake_sweeps(braked(tire), 265.0)
    wrong = recording.assign(**{channel: recording[channel] * factor})
    assert findings(braked(tire), wrong) == [("unit_error", channel)]


# Axes


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
    [("slip_angle", "fy"), ("fy",), ("camber",), ("slip_angle",), ("camber", "fy"), ("slip_angle", "camber")],
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


def test_a_camber_of_another_size_is_no_sign(cambered):
    """The model's thrust is half of the true one: that has a size, and is physics."""
    tire, recording = cambered
    assert findings(tire.replace(PVY3=0.17), recording) == []


def test_a_doubt_about_axes_that_the_forces_do_not_settle_stays_open(tire, record, tmp_path):
    r = record(0, friction=0.9)
    path = tmp_path / "rig.csv"
    r.assign(normal_load=-r["normal_load"]).to_csv(path, index=False)
    report = explain_mismatch(tire, read_recording(path))
    assert report.corrected.question is not None
    assert "negative throughout" in report.summary
    assert any("ISO W axes, which were not stated" in a for a in report.assumed)
    page = report.to_html(tmp_path / "page.html").read_text()
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


# Clipping


def slow_sine(limit=np.inf, digits=5, noise=0.0):
    t = np.arange(0.0, 180.0, 0.01)
    force = 5500.0 * np.sin(2.0 * np.pi * t / 90.0) + noise * np.random.default_rng(0).standard_normal(t.size)
    force = np.clip(force, -limit, limit)
    return t, np.array([float(f"{f:.{digits}g}") for f in force])


@pytest.mark.parametrize("digits", [3, 4, 5, 6, 15])
@pytest.mark.parametrize("noise", [0.0, 0.3, 30.0])
def test_the_crest_of_a_slow_sine_in_few_digits_is_not_clipped(tire, digits, noise):
    t, force = slow_sine(digits=digits, noise=noise)
    r = pd.DataFrame({"time": t, "slip_angle": force / 1e5, "normal_load": 4000.0 + t, "fy": force})
    assert [f for f in prepare(tire, r).findings if f.name == "clipping"] == []


@pytest.mark.parametrize("limit", [5490.0, 5300.0, 3000.0])
@pytest.mark.parametrize("digits", [4, 5, 15])
def test_a_limit_is_found_whatever_the_digits(tire, limit, digits):
    t, force = slow_sine(limit, digits)
    r = pd.DataFrame({"time": t, "slip_angle": force / 1e5, "normal_load": 4000.0 + t, "fy": force})
    assert "fy" in [f.channel for f in prepare(tire, r).findings if f.name == "clipping"]


def _points(count, seed, noise=15.0):
    """Steady points of a made-up force, in the digits of a table."""
    rng = np.random.default_rng(seed)
    slip = rng.uniform(-0.18, 0.18, count)
    load = rng.choice([2000.0, 3500.0, 5000.0], count)
    fy = load * np.tanh(12.0 * slip) + noise * rng.standard_normal(count)
    return pd.DataFrame({"slip_angle": slip, "normal_load": load, "fy": np.round(fy, 2)})


def _limits(tire, points):
    return [f for f in prepare(tire, points).findings if f.name == "clipping"]


@pytest.mark.parametrize("seed", range(10))
def test_three_of_few_points_at_a_limit_of_either_sign_are_clipped(tire, seed):
    points = _points(30, seed)
    limit = np.sort(np.abs(points["fy"]))[-3] - 1.0
    assert len(_limits(tire, points.assign(fy=points["fy"].clip(-limit, limit)))) == 1
    assert _limits(tire, points) == []


@pytest.mark.parametrize("seed", range(10))
def test_points_that_coincide_for_another_reason_are_not_clipped(tire, seed):
    """Coarse digits where the tire slides, a table with each row four times, a curve with a symmetry."""
    points = _points(60, seed, noise=0.0)
    sliding = points.assign(fy=np.round(points["fy"] / 100.0))
    repeated = pd.concat([points] * 4).sample(frac=1.0, random_state=seed).assign(row=range(240))
    mirrored = pd.concat([points, points.assign(slip_angle=-points["slip_angle"], fy=-points["fy"])])
    for table in (sliding, repeated, mirrored):
        assert _limits(tire, table) == []


@pytest.mark.parametrize("unit", [4.4482216, 9.80665, 1000.0])
def test_a_dozen_points_are_enough_for_a_wrong_unit(tire, unit):
    angles, loads = np.meshgrid([-0.12, -0.06, 0.0, 0.06, 0.1, 0.15], [3000.0, 5000.0])
    points = pd.DataFrame({"slip_angle": angles.ravel(), "normal_load": loads.ravel()})
    fy = tire.forces(slip_angle=points["slip_angle"], normal_load=points["normal_load"]).fy
    noise = 1.0 + 0.01 * np.random.default_rng(3).standard_normal(len(points))
    (found,) = prepare(tire, points.assign(fy=fy * noise / unit)).findings
    assert (found.name, found.channel) == ("unit_error", "fy")
    assert found.parameters["ratio"][0] == pytest.approx(1.0 / unit)


def test_no_limit_is_named_where_no_sample_stands_at_one(tire, record):
    """A load sensitivity was taken for clipping twice: the largest forces are the ones that lack."""
    r = record(0)
    low = 1.0 - 0.25 * np.clip((r["normal_load"] - 3000.0) / 3000.0, 0.0, None)
    report = explain_mismatch(tire, r.assign(fy=r["fy"] * low))
    assert "clipping" not in [n for e in report.effects for n in (e.name, *e.alternatives)]
    (row,) = [c for c in report.candidates if c["name"] == "clipping"]
    assert row["gain"] is None


# Recordings that carry no answer


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


@pytest.mark.parametrize(("how", "size"), RUINS)
def test_nor_does_a_model_help_that_was_fitted_to_it(free_drive, how, size, tmp_path):
    """Of the log in the issue eight fits were tried."""
    _, drive = free_drive
    slip = ruined(drive["slip_angle"].to_numpy(), drive["time"].to_numpy(), how, size)
    wrong = drive.assign(slip_angle=slip)
    check_unusable(explain_mismatch(fit_magic_formula(wrong[AXLE]).model, wrong), tmp_path)


@pytest.mark.parametrize(("how", "size"), RUINS)
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


def test_a_slip_ratio_that_means_nothing_is_left_out(tire, record):
    """Free rolling in the consortium's files: SL is -1 throughout."""
    prepared = prepare(braked(tire).replace(RBY1=10.0, RCY1=1.0), record(0).assign(slip_ratio=-1.0))
    assert prepared.question is None
    assert any("slip_ratio is -1 throughout" in n for n in prepared.notes)
    assert "slip_ratio" not in prepared.data.present


def test_one_force_that_its_slip_does_not_drive_is_left_out(tire, record):
    model = braked(tire)
    r = record(0)
    rng = np.random.default_rng(0)
    t = r["time"].to_numpy()
    slip = 0.08 * np.sin(2.0 * np.pi * t / 11.0)
    fx = model.forces(slip_ratio=slip, normal_load=r["normal_load"].to_numpy()).fx
    fy = model.forces(
        slip_angle=r["slip_angle"].to_numpy(), slip_ratio=slip, normal_load=r["normal_load"].to_numpy()
    ).fy
    r = r.assign(slip_ratio=slip, fy=fy, fx=rng.permutation(fx))
    prepared = prepare(model, r)
    assert prepared.question is None
    assert prepared.data.outputs == ("fy",)
    assert any(n.startswith("fx is left out") for n in prepared.notes)


# Another tire


def check_another(report, tmp_path):
    assert report.verdict == "another tire"
    assert report.effects == []
    assert "cornering stiffness" in report.summary
    assert "load" in report.summary
    with pytest.raises(RecordingError, match="file of this tire"):
        report.corrected.to_tir(tmp_path / "corrected.tir")
    assert "another tire" in report.to_html(tmp_path / "page.html").read_text()


def test_a_recording_of_another_size_asks_for_the_file(tmp_path):
    """195/65 R15 against the file of a 185/80 R14 was "another slip stiffness and fall of friction"."""
    tire = read_tir(shared("tir") / "projectchrono__chrono__mf_185_80R14.tir")
    points = read_recording(shared("recordings/tydex") / "DT_195_65R15_demo.tdx")
    check_another(explain_mismatch(tire, points), tmp_path)


def test_another_tire_on_the_rig_asks_for_the_file(tire, record, tmp_path):
    other = tire.replace(PDY1=0.9, PDY2=-0.25, PKY1=30.0, PKY2=1.4, PEY1=-0.3)
    check_another(explain_mismatch(other, record(0)), tmp_path)


@pytest.mark.slow
def test_public_files_against_real_recordings_are_another_tire():
    """None of the 16 is of one of these tires; friction and stiffness alone may be a state of the same."""
    calspan = read_recording(shared("recordings/calspan") / "cornering_part.mat", axes="SAE").iloc[::5]
    points = read_recording(shared("recordings/tydex") / "DT_195_65R15_demo.tdx")
    recordings = (calspan[calspan["pressure"] > 75e3].drop(columns="slip_ratio"), points)
    asked = [
        prepare(read_tir(file), recording).stopped == "another tire"
        for file in sorted(shared("tir").glob("*.tir"))
        for recording in recordings
    ]
    assert len(asked) == 32
    assert np.mean(asked) >= 0.9


@pytest.mark.parametrize(
    "change",
    [
        {"friction": 0.7},
        {"stiffness": 0.7},
        {"stiffness": 1.4, "friction": 1.2},
        {"stiffness": 0.8, "friction": 1.2, "offset": 200.0},
        {"pressure_effect": 0.5},
        {"delay": 0.1},
    ],
)
def test_a_state_of_the_same_tire_is_no_other_tire(tire, record, change):
    assert prepare(tire, record(0, **change)).question is None


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["nothing", "single", "pair", "artefact", "ambiguous", "unknown"])
@pytest.mark.parametrize("count", [1, pytest.param(10, marks=pytest.mark.long)])
def test_simulated_cases_raise_no_question(kind, count):
    """Signs and units that are an artefact of the case aside."""
    for seed in range(880001, 880001 + count):
        case, answer = make_case(seed, kind)
        question = prepare(case.tire, case.recording).question
        assert question is None or "sign_convention" in [e.name for e in answer.effects], (seed, question)
