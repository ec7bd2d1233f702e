"""The aligning moment: it agrees or not, and what is missing in it is found, proved and put in."""

from __future__ import annotations

import json

import numpy as np
import pytest

from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.proof.held_out import recorded_moments
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.mismatch.unnamed_physics.found import from_sidecar
from tire_pipeline.tir import read_tir

ARM = 0.012


@pytest.fixture(scope="module")
def with_trail(tire):
    """The small rig's tire with a pneumatic trail."""
    return tire.replace(QBZ1=10.0, QBZ9=18.0, QCZ1=1.1, QDZ1=0.12, QDZ6=0.002, QEZ1=-1.5)


@pytest.fixture(scope="module")
def rig(with_trail, record):
    """Return a function that gives a recording whose moment is another one: ``rig(change)``."""

    def run(change=lambda moment, recording: moment):
        recording = record(0)
        forces = with_trail.forces(
            slip_angle=recording["slip_angle"], normal_load=recording["normal_load"], outputs=("mz",)
        )
        noise = np.random.default_rng(7).standard_normal(len(recording))
        misfit = 0.01 * np.ptp(forces.mz) * np.sin(recording["slip_angle"] / 0.03)
        return recording.assign(mz=change(np.asarray(forces.mz + misfit), recording) + 0.8 * noise)

    return run


@pytest.fixture(scope="module")
def about_another_point(with_trail, rig):
    """What is said of a moment that was recorded about a point 12 mm from the file's."""
    return explain_mismatch(with_trail, rig(lambda moment, recording: moment + ARM * recording["fy"]))


def test_a_moment_that_agrees_is_said_to_with_its_error(with_trail, rig):
    report = explain_mismatch(with_trail, rig())
    assert report.verdict == "agrees"
    assert report.unnamed.physics is None
    assert "Mz" in report.summary
    assert "There is nothing to correct" in report.summary


def test_a_moment_about_another_point_is_found_as_the_side_force_with_an_arm(about_another_point, with_trail):
    report = about_another_point
    assert report.verdict == "unexplained"
    assert report.effects == []
    assert report.summary.startswith("Fy agrees with the recording, Mz does not")
    assert "the side force, with an arm" in report.summary
    [(output, sizes)] = report.unnamed.physics.coefficients.items()
    assert output == "mz"
    assert sizes[0].value * with_trail.coefficients["UNLOADED_RADIUS"] == pytest.approx(ARM, rel=0.1)
    assert [idea.name for idea in report.unnamed.ideas] == ["a moment taken about another point"]
    before, after, _ = report.unnamed.unseen["mz"]
    assert after < 0.3 * before
    assert report.fit["mz"].rms_after < 0.3 * report.fit["mz"].rms_before
    assert report.fit["fy"].rms_after == report.fit["fy"].rms_before


def test_another_recording_is_predicted_with_the_arm(about_another_point, with_trail, rig):
    second = rig(lambda moment, recording: moment + ARM * recording["fy"]).iloc[500:2500]
    plain = with_trail.forces(slip_angle=second["slip_angle"], normal_load=second["normal_load"]).mz
    predicted = about_another_point.corrected.predict(second.drop(columns="mz"))["mz"]
    before, after = (np.sqrt(np.mean((second["mz"] - x) ** 2)) for x in (plain, predicted))
    assert after < 0.3 * before


def test_the_sidecar_holds_the_moments_equation_and_reads_back(about_another_point, tmp_path):
    written = about_another_point.corrected.to_tir(tmp_path / "corrected.tir")
    sidecar = json.loads(next(tmp_path.glob("*.json")).read_text(encoding="utf-8"))
    entry = sidecar["effects"]["unnamed"]
    assert list(entry["equation"]) == ["mz"]
    assert from_sidecar(entry) == about_another_point.unnamed.physics
    assert read_tir(written).coefficients["QDZ1"] == 0.12


@pytest.mark.parametrize(
    ("change", "acts_on"),
    [
        (lambda moment, recording: 1.3 * moment, "the aligning moment, by a factor"),
        (lambda moment, recording: moment + 9.0, "a constant aligning moment"),
    ],
    ids=["a gain", "an offset"],
)
def test_a_fault_of_the_moment_is_named_by_how_it_acts(with_trail, rig, change, acts_on):
    report = explain_mismatch(with_trail, rig(change))
    assert report.verdict == "unexplained"
    assert report.unnamed.physics.acts_on == acts_on
    assert set(report.unnamed.physics.equations) == {"mz"}


def test_a_moment_with_the_other_sign_is_a_question_of_its_sign(with_trail, rig):
    report = explain_mismatch(with_trail, rig(lambda moment, recording: -moment))
    assert report.verdict == "unexplained"
    assert report.unnamed.physics is None
    assert "check the sign of the recorded Mz" in report.summary


def test_beside_a_named_effect_the_moment_that_stays_off_is_told(with_trail, rig):
    recording = rig(lambda moment, recording: 1.5 * moment)
    report = explain_mismatch(with_trail, recording.assign(fy=recording["fy"] + 400.0))
    assert "force_offset" in {name for effect in report.effects for name in effect.names}
    assert any("The aligning moment does not agree" in text for text in report.head.remarks)
    assert "mz" in report.unnamed.physics.equations


def test_the_page_gives_the_moment_its_unit(about_another_point, tmp_path):
    page = about_another_point.to_html(tmp_path / "page.html").read_text(encoding="utf-8")
    assert "Mz (N m)" in page
    assert "</code> N m</p>" in page
    assert "Mz recorded - simulated (N m)" in page


def test_a_moment_that_agrees_has_no_figure(with_trail, rig, tmp_path):
    page = explain_mismatch(with_trail, rig()).to_html(tmp_path / "page.html").read_text(encoding="utf-8")
    assert "Mz (N m)" in page
    assert "Mz recorded - simulated" not in page


def test_a_moment_with_a_short_hole_is_judged(with_trail, rig):
    """A slip that steps passes the peak of Mz in a sample, which stands out; then nothing was said of Mz."""
    recording = rig()
    recording.loc[[400, 900, 901], "mz"] = np.nan
    data = prepare(with_trail, recording).data
    assert recorded_moments(data) == ("mz",)
    assert np.abs(data.channels["mz"][400] - rig()["mz"][400]) < 20.0
    recording.loc[400:420, "mz"] = np.nan
    assert recorded_moments(prepare(with_trail, recording).data) == ()
