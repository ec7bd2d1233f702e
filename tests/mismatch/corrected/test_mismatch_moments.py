"""Moments take no part in the search; the corrected model gives them, and the report their errors."""

import numpy as np
import pytest
from turned_axes import cambered, leaning, misread
from weighed import all_but

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch import CorrectedModel, explain_mismatch
from tire_pipeline.mismatch.recording.prepare import prepare

MOMENTS = {"QBZ1": 8.0, "QCZ1": 1.1, "QDZ1": 0.12, "QBZ9": 10.0, "QSX1": 0.01, "QSX3": 0.03}


@pytest.fixture(scope="module")
def with_moments(tire, record):
    """The rig's recording with friction down by 15%, and moments of a tire of that friction."""
    model = TireModel.from_coefficients({**tire.coefficients, **MOMENTS}, version="5.2")
    recording = record(5, friction=0.85)
    rng = np.random.default_rng(2)
    inputs = {c: recording[c].to_numpy() for c in ("slip_angle", "normal_load")}
    less = model.replace(LMUY=0.85).forces(**inputs)
    n = len(recording)
    return model, recording.assign(mz=less.mz + rng.normal(0, 1.0, n), mx=less.mx + rng.normal(0, 1.0, n))


@pytest.mark.slow
def test_moments_are_corrected_though_no_fit_has_seen_them(with_moments):
    """How often they are, and by how much: ``rates``."""
    model, recording = with_moments
    report = explain_mismatch(model, recording, without=all_but("friction_scale", "force_offset"))
    assert set(report.fit) == {"fy", "mx", "mz"}
    predicted = report.corrected.predict(recording.drop(columns=["fy", "mz", "mx"]))
    assert list(predicted) == ["fy", "mx", "mz"]
    left = recording["mz"] - predicted["mz"]
    assert np.sqrt(np.mean(left**2)) == pytest.approx(report.fit["mz"].rms_after, rel=0.05)


@pytest.mark.slow
def test_a_model_without_moments_gives_none(tire, with_moments):
    report = explain_mismatch(tire, with_moments[1], without=all_but("friction_scale"))
    assert set(report.fit) == {"fy"}
    assert list(report.corrected.predict(with_moments[1])) == ["fy"]


@pytest.mark.slow
def test_a_moment_that_the_correction_would_make_worse_stays_as_it_was(with_moments):
    """The side force is 15% less, the moments are the file's: the correction took Mz from 1 to 21 N m."""
    model, recording = with_moments
    at = {c: recording[c].to_numpy() for c in ("slip_angle", "normal_load")}
    noise = np.random.default_rng(3).normal(0.0, 1.0, len(recording))
    as_filed = recording.assign(mz=model.forces(**at).mz + noise).drop(columns="mx")
    report = explain_mismatch(model, as_filed, without=all_but("friction_scale", "force_offset"))
    assert [e.name for e in report.effects] == ["friction_scale"]
    left = as_filed["mz"] - report.corrected.predict(as_filed)["mz"]
    assert np.sqrt(np.mean(left**2)) < 1.1  # the noise alone
    assert report.fit["mz"].rms_after < 1.1
    assert "the corrected model leaves these as they were" in str(report.head)


@pytest.mark.parametrize("lag", ["time_delay", "low_pass"])
def test_a_lag_of_the_force_channels_is_one_of_the_moments(tire, record, lag):
    """Fy and Mz were late, and only Fy was corrected: Mz kept 3.4 of 3.8 N m."""
    model = TireModel.from_coefficients({**tire.coefficients, **MOMENTS}, version="5.2")
    recording = record(5, delay=0.1)
    time, slip, load = (recording[c].to_numpy() for c in ("time", "slip_angle", "normal_load"))
    late = np.interp(time - 0.1, time, model.forces(slip_angle=slip, normal_load=load).mz)
    report = explain_mismatch(model, recording.assign(mz=late), without=all_but(lag))
    assert [e.name for e in report.effects] == [lag]
    assert report.fit["mz"].rms_after < 0.5 * report.fit["mz"].rms_before


@pytest.mark.parametrize(
    "channels", [("slip_angle", "fy", "mz"), ("slip_angle", "fy")], ids=["turned", "as it is"]
)
def test_an_aligning_moment_has_the_other_sign_with_the_side_force_if_the_recording_says_so(tire, channels):
    """The moment of a file in SAE axes stood on the other side of the recorded one: 3 N m became 20."""
    model = leaning(TireModel.from_coefficients({**tire.coefficients, **MOMENTS}, version="5.2"))
    recording = cambered(tire, 0)
    at = {c: recording[c].to_numpy() for c in ("slip_angle", "camber", "normal_load")}
    recording = misread(recording.assign(mz=model.forces(**at).mz), channels, 1.0)
    prepared = prepare(model, recording)
    assert prepared.factors == dict.fromkeys(channels, -1.0)
    assert [f.channel for f in prepared.findings] == [", ".join(channels)]
    plain = CorrectedModel(model, (), ("fy",), moments=("mz",), factors=prepared.factors)
    assert np.allclose(plain.predict(recording)["mz"], recording["mz"])
