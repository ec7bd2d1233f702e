"""Before any explanation: whether a recording carries an answer."""

import numpy as np
import pandas as pd
import pytest
from worthless_slip import AXLE, RUINS, free_drive, without_slip

from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula.fitting import fit_magic_formula
from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.recording.prepare import prepare


@pytest.fixture(scope="module")
def on_the_floor():
    """A drive, and a fit to it."""
    return fit_magic_formula(free_drive()[AXLE]).model, free_drive()


def test_nothing_is_told_of_an_unusable_drive_and_nothing_written(on_the_floor, tmp_path):
    tire, drive = on_the_floor
    report = explain_mismatch(tire, without_slip(drive, "shuffled", 1.0, seed=3))
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
def test_a_drive_whose_slip_is_worth_nothing_is_unusable(on_the_floor, how, size, draws):
    tire, drive = on_the_floor
    stopped = [prepare(tire, without_slip(drive, how, size, seed)).stopped for seed in draws]
    assert stopped == ["unusable"] * len(draws)


@pytest.mark.parametrize(("how", "size"), RUINS)
def test_nor_does_a_model_help_that_was_fitted_to_it(how, size):
    """One draw of each; a fit takes a second, so the others are in ``rates``."""
    drive = without_slip(free_drive(), how, size, seed=0)
    assert prepare(fit_magic_formula(drive[AXLE]).model, drive).stopped == "unusable"


@pytest.mark.parametrize(("how", "size"), RUINS)
def test_a_rig_sweep_whose_slip_is_worth_nothing_is_unusable(tire, record, how, size, draws):
    stopped = [prepare(tire, without_slip(record(seed), how, size, seed)).stopped for seed in draws]
    assert stopped == ["unusable"] * len(draws)


def test_the_drive_as_it_is_can_be_used(on_the_floor):
    tire, drive = on_the_floor
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
    assert [prepare(tire, record(seed, **change)).question for seed in range(2)] == [None] * 2


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


@pytest.mark.parametrize(("rows", "said"), [([100], "1 sample in holes"), ([100, 300], "2 samples in holes")])
def test_a_note_counts_in_the_singular_where_there_is_one(tire, record, rows, said):
    run = record()
    run.loc[rows, "fy"] = np.nan
    assert any(note.startswith(said) for note in prepare(tire, run).notes)


def test_a_force_that_the_file_has_nothing_of_is_left_out_by_name(tire, braked):
    """A cornering file beside a brake test: "look at how slip ratio was measured", and nothing explained."""
    rng = np.random.default_rng(4)
    n = 600
    at = {
        "slip_ratio": 0.2 * np.sin(np.linspace(0.0, 40.0, n)),
        "slip_angle": np.repeat([0.05, -0.05, 0.1], n // 3),
        "normal_load": np.tile(np.repeat([2000.0, 4000.0], n // 6), 3),
    }
    forces = braked.forces(**at)
    recording = pd.DataFrame({**at, "fx": forces.fx, "fy": forces.fy + rng.normal(0.0, 20.0, n)})
    prepared = prepare(tire, recording)
    assert set(prepared.data.outputs) == {"fy"}
    assert any("the file has no coefficients of Fx" in note for note in prepared.notes)
    alone = prepare(tire, recording.drop(columns="fy"))
    assert alone.stopped == "unusable"
    assert "no coefficients of Fx" in alone.question.why
