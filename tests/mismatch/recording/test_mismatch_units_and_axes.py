"""Before any explanation: the units and axes that a recording must be in."""

from functools import partial

import numpy as np
import pandas as pd
import pytest
from mismatch_shared import shared
from turned_axes import TURNED, cambered, leaning, misread
from weighed import all_but, without_visible

from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula.fitting import fit_magic_formula
from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.effects.sensor.sign_convention import excludes_sae
from tire_pipeline.mismatch.model.plain_forces import forces_at
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.recordings import read_recording


def findings(tire, recording):
    return [(f.name, f.channel) for f in prepare(tire, recording).findings]


def in_each_draw(tire, recorded, draws):
    """What is found before any explanation in ``recorded(seed)``: what holds has to hold in every draw."""
    found = {tuple(findings(tire, recorded(seed))) for seed in draws}
    assert len(found) == 1, found
    return list(*found)


def brake_sweeps(tire, thrust, seed):
    """Brake sweeps at zero slip angle, and a side force by a camber that the model does not know."""
    rng = np.random.default_rng(seed)
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
def test_a_force_that_the_model_does_not_have_says_nothing_about_its_unit(braked, thrust, draws):
    """A thousandth of it always left less: "Fy wrong by 1000 (kN)"."""
    assert in_each_draw(braked, lambda seed: brake_sweeps(braked, thrust, seed), draws) == []


@pytest.mark.parametrize(
    ("channel", "factor"), [("fx", 1e-3), ("fx", 1.0 / 4.4482216), ("slip_ratio", 100.0)]
)
def test_the_unit_of_a_force_that_the_model_has_is_still_found(braked, channel, factor, draws):
    def wrong(seed):
        recording = brake_sweeps(braked, 265.0, seed)
        return recording.assign(**{channel: recording[channel] * factor})

    assert in_each_draw(braked, wrong, draws) == [("unit_error", channel)]


@pytest.mark.parametrize(
    ("channel", "factor", "said"),
    [
        ("fx", 1e-3, "kN taken for N"),
        ("fx", 1e3, "N taken for kN"),
        ("fx", 1.0 / 4.4482216, "lbf taken for N"),
        ("slip_ratio", 100.0, "percent taken for a ratio"),
    ],
)
def test_the_unit_of_the_values_is_told_from_the_one_that_they_were_taken_for(braked, channel, factor, said):
    """A force in lbf was "the inverse of pound-force for newton"."""
    recording = brake_sweeps(braked, 265.0, 0)
    (found,) = prepare(braked, recording.assign(**{channel: recording[channel] * factor})).findings
    assert found.text.endswith(f"({said})")


def a_dozen_points(tire, seed, share=0.0, noise=0.0):
    """Six slip angles at two loads; noise of the force in shares of it and in N."""
    angles, loads = np.meshgrid([-0.12, -0.06, 0.0, 0.06, 0.1, 0.15], [3000.0, 5000.0])
    points = pd.DataFrame({"slip_angle": angles.ravel(), "normal_load": loads.ravel()})
    fy = tire.forces(slip_angle=points["slip_angle"], normal_load=points["normal_load"]).fy
    rough = np.random.default_rng(seed).standard_normal(len(points))
    return points.assign(fy=fy * (1.0 + share * rough) + noise * rough)


@pytest.mark.parametrize("unit", [4.4482216, 9.80665, 1000.0])
def test_a_dozen_points_are_enough_for_a_wrong_unit(tire, unit, draws):
    for seed in draws:
        points = a_dozen_points(tire, seed, share=0.01)
        (found,) = prepare(tire, points.assign(fy=points["fy"] / unit)).findings
        assert (found.name, found.channel) == ("unit_error", "fy")
        assert found.parameters["ratio"][0] == pytest.approx(1.0 / unit)


@pytest.mark.parametrize(("unit", "said"), [(4.4482216, "lbf"), (9.80665, "kgf")])
def test_load_and_force_in_one_other_unit_are_asked_about(tire, unit, said, draws):
    """They were another tire's, or another change of friction with load: forces go nearly with the load."""
    for seed in draws:
        points = a_dozen_points(tire, seed, share=0.01)
        assert not any("were taken for" in q.why for q in prepare(tire, points).questions)
        scaled = points.assign(fy=points["fy"] / unit, normal_load=points["normal_load"] / unit)
        (question,) = prepare(tire, scaled).questions
        assert f"normal_load and fy are in {said}, and were taken for N" in question.why
        assert "state it" in question.todo


@pytest.mark.parametrize("turned", ["slip_angle", "fy"])
def test_a_dozen_points_are_enough_for_a_sign_that_is_wrong_throughout(tire, turned, draws):
    """Which of both is turned they do not tell: the finding names one, and the other beside it."""
    assert in_each_draw(tire, lambda seed: a_dozen_points(tire, seed, noise=20.0), draws) == []
    for seed in draws:
        points = a_dozen_points(tire, seed, noise=20.0)
        (found,) = prepare(tire, points.assign(**{turned: -points[turned]})).findings
        assert (found.name, found.channel, found.alike) == ("sign_convention", "slip_angle", (("fy",),))


@pytest.mark.parametrize("gain", [1.07, 1.0])
@pytest.mark.parametrize("turned", TURNED, ids=", ".join)
def test_axes_that_nobody_stated_are_found_and_asked_for(tire, turned, gain):
    for seed in range(2):
        prepared = prepare(leaning(tire), misread(cambered(tire, seed), turned, gain))
        found = [(each.name, each.channel) for each in prepared.findings]
        assert found == [("sign_convention", ", ".join(turned))]
        assert prepared.question is not None
        assert any("taken as -1 times" in a for a in prepared.assumed)


@pytest.mark.parametrize("cambers", ["none", "one", "three"])
def test_a_tire_of_the_other_side_is_asked_about(tire, cambers):
    """Its axes were right, and stated: that it "agrees only in other axes" was not true."""
    recording = misread(cambered(tire, 0), ("slip_angle", "camber", "fy"), 1.0)
    if cambers != "three":
        recording = recording[recording["camber"] == 0.0]
    asked = prepare(leaning(tire), recording.drop(columns="camber" if cambers == "none" else [])).question
    assert "is of a tire of the other side" in asked.why
    assert "TYRESIDE" in asked.todo
    if cambers == "three":
        sae = prepare(leaning(tire), misread(cambered(tire, 0), ("slip_angle", "fy"), 1.0)).question
        assert "other side" not in sae.why


def test_while_axes_are_open_no_physics_is_named_and_nothing_written(tire, tmp_path):
    """How often no physics is named, whatever was turned: ``rates``."""
    wrong = misread(cambered(tire, 1), ("slip_angle", "fy"), 1.07)
    report = explain_mismatch(leaning(tire), wrong, without=all_but("camber", "force_gain", "friction_scale"))
    assert [e.output for e in report.effects if e.name == "sign_convention"] == ["slip_angle, fy"]
    assert not [e.name for e in report.effects if e.kind == "physics"]
    assert report.corrected.question is not None
    assert "axes" in report.summary
    assert any("taken as -1 times" in a for a in report.assumed)
    with pytest.raises(RecordingError, match="nothing corrected is written") as caught:
        report.corrected.to_tir(tmp_path / "corrected.tir")
    assert "axes=" in caught.value.todo
    assert not list(tmp_path.iterdir())


def test_a_slip_angle_that_is_off_by_twice_the_ply_steer_is_no_sign(tire, draws):
    """Turned axes would show the model's ply steer on the other side: so does an offset of twice its size."""
    steered = tire.replace(PHY1=-0.003, PVY1=0.0)
    slip = 0.15 * np.sin(2.0 * np.pi * np.arange(0.0, 60.0, 0.02) / 7.5)
    load = np.where(np.arange(slip.size) < slip.size // 2, 2500.0, 5000.0)
    fy = steered.forces(slip_angle=slip, normal_load=load).fy
    frame = pd.DataFrame({"time": np.arange(0.0, 60.0, 0.02), "normal_load": load})

    def recorded(seed):
        noise = 20.0 * np.random.default_rng(seed).standard_normal(slip.size)
        return frame.assign(slip_angle=slip - 0.006, fy=fy + noise)

    assert in_each_draw(steered, recorded, draws) == []


@pytest.mark.parametrize(("thrust", "over_load"), [(0.35, -0.1), (1.0, -0.3)])
def test_a_drift_of_the_force_is_no_sign(tire, thrust, over_load):
    """Sweeps at one camber, and later at another: a drift adds to the second what a mirrored thrust would."""
    leaned = tire.replace(PVY3=thrust, PVY4=over_load)
    t = np.r_[np.arange(0.0, 25.0, 0.02), np.arange(170.0, 182.5, 0.02)]
    slip = 0.15 * np.sin(2.0 * np.pi * t / 12.5)
    camber, load = np.where(t < 100.0, 0.0, 0.028), np.full(t.size, 2500.0)
    fy = leaned.forces(slip_angle=slip, camber=camber, normal_load=load).fy
    plain = pd.DataFrame({"time": t, "slip_angle": slip, "camber": camber, "normal_load": load})
    for seed, drift in enumerate((-400.0, -200.0, -100.0, -50.0, 50.0, 100.0, 200.0, 400.0)):
        noise = 20.0 * np.random.default_rng(seed).standard_normal(t.size)
        assert findings(leaned, plain.assign(fy=fy + drift * t / t[-1] + noise)) == []


def test_a_camber_of_another_size_is_no_sign(tire, draws):
    """The model's thrust is half of the true one: that has a size, and is physics."""
    assert in_each_draw(leaning(tire).replace(PVY3=0.17), lambda seed: cambered(tire, seed), draws) == []


def test_a_doubt_about_axes_that_the_forces_do_not_settle_stays_open(tire, record, tmp_path):
    r = record(0, friction=0.9).iloc[:1250]
    path = tmp_path / "rig.csv"
    r.assign(normal_load=-r["normal_load"]).to_csv(path, index=False)
    few = all_but("friction_scale", "force_offset")
    report = explain_mismatch(tire, read_recording(path), without=few)
    assert report.corrected.question is not None
    assert "negative throughout" in report.summary
    assert any("ISO W axes, which were not stated" in a for a in report.assumed)
    page = without_visible(report).to_html(tmp_path / "page.html").read_text()
    assert "How the recording was read:" in page
    with pytest.raises(RecordingError, match="negative throughout"):
        report.corrected.to_tir(tmp_path / "corrected.tir")
    settled = explain_mismatch(tire, read_recording(path, axes="ISO"), without=few)
    assert settled.corrected.question is None
    assert settled.corrected.to_tir(tmp_path / "corrected.tir").exists()


@pytest.mark.parametrize("stiffer", [1.0, 1.15, 1.3])
def test_another_stiffness_does_not_settle_the_axes(tire, stiffer):
    """A stiffer tire in SAE axes, read as ISO, was an offset of the slip angle, and no axes were open."""
    file = leaning(tire).replace(PHY1=0.008, PKY1=-20.0, PKY2=2.0)
    recorded = cambered(tire, 1).iloc[:3000]
    inputs = {name: recorded[name].to_numpy() for name in ("slip_angle", "camber", "normal_load")}
    recorded = recorded.assign(fy=file.replace(PKY1=-20.0 * stiffer).forces(**inputs, limits="ignore").fy)
    for read, excluded in ((misread(recorded, ("slip_angle", "fy"), 1.0), False), (recorded, True)):
        channels = {name: read[name].to_numpy() for name in read}
        assert excludes_sae(channels, partial(forces_at, file)) is excluded


@pytest.mark.slow
@pytest.mark.parametrize("gain", [1.0, pytest.param(1.07, marks=pytest.mark.long)])
def test_a_real_rig_file_in_sae_axes_is_not_explained_by_camber(gain, tmp_path):
    """Read as ISO with a gain it was "explained: camber", and a corrected file was written."""
    file = shared("recordings/calspan") / "cornering_part.mat"
    told, wrongly = (read_recording(file, axes=axes).iloc[::5] for axes in ("SAE", "ISO"))
    assert read_recording(file).iloc[::5].equals(told)  # its camber tells
    rows = told["pressure"] > 75e3
    tire = fit_magic_formula(told[rows][["slip_angle", "camber", "normal_load", "fy"]]).model
    wrong = wrongly[rows].assign(fy=gain * wrongly["fy"][rows])
    report = explain_mismatch(tire, wrong, without=all_but("camber", "force_gain", "friction_scale"))
    assert [e.output for e in report.effects if e.name == "sign_convention"] == ["slip_angle, fy"]
    assert "camber" not in [e.name for e in report.effects]
    with pytest.raises(RecordingError, match="only in other axes"):
        report.corrected.to_tir(tmp_path / "corrected.tir")
    assert prepare(tire, told[rows]).question is None
    level = told["camber"][rows].abs() < 0.01
    wrong.attrs["axes_unclear"] = "Fz is negative throughout"  # as where one camber alone is in the file
    assert "negative throughout" in prepare(tire, wrong[level]).question.why


def test_halves_of_a_real_table_have_the_same_axes(draws):
    """The asymmetry of a file that was fitted to 56 points is off by as much as turned signs change."""
    table = read_recording(shared("recordings/tydex") / "DT_195_65R15_demo.tdx")
    table = table[["slip_angle", "camber", "normal_load", "pressure", "fy"]]
    found = []
    for seed in (*draws, 77):
        rows = np.random.default_rng(seed).permutation(len(table))
        fitted, other = (table.iloc[np.sort(r)].reset_index(drop=True) for r in (rows[:56], rows[56:]))
        found += findings(fit_magic_formula(fitted, version="5.2", starts=2).model, other)
    assert found == []


def test_units_of_channels_that_no_explanation_uses_are_not_listed(tire, record, tmp_path):
    """On a real rig's page they stood first: effective and loaded radius, wheel speed."""
    r = record(0).iloc[:400].assign(loaded_radius=30.0)
    path = tmp_path / "rig.csv"
    r.rename(columns={"loaded_radius": "RL [cm]", "speed": "V [km/h]"}).to_csv(path, index=False)
    recording = read_recording(path, axes="ISO")
    assert any("RL from cm to m" in text for text in recording.attrs["conversions"])
    assumed = prepare(tire, recording).assumed
    assert any("speed: V converted from km/h" in text for text in assumed)
    assert not any("loaded_radius" in text for text in assumed)


@pytest.mark.parametrize(("mirrored", "stated"), [(True, False), (True, True), (False, False)])
def test_axes_that_nobody_stated_are_open_where_others_agree_better(tire, record, tmp_path, mirrored, stated):
    """A positive load, no camber, a lag, and a ply steer to the other side: "conicity or ply steer", 0.99."""
    asymmetric = tire.replace(PHY1=0.004)
    r = record(3).iloc[:1500].assign(camber=0.0)
    late = r["slip_angle"].shift(3, fill_value=0.0)
    r["fy"] = asymmetric.forces(slip_angle=late, normal_load=r["normal_load"], limits="ignore").fy
    if mirrored:
        r = r.assign(slip_angle=-r["slip_angle"], fy=-r["fy"])
    path = tmp_path / "rig.csv"
    r[["time", "slip_angle", "camber", "normal_load", "fy"]].to_csv(path, index=False)
    question = prepare(asymmetric, read_recording(path, axes="ISO" if stated else None)).question
    if mirrored and not stated:
        assert "in SAE axes the RMS difference of Fy is" in question.why
    else:
        assert question is None
