"""What a corrected model writes: coefficients where the format has some, the sidecar for the rest."""

import numpy as np
import pytest

from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch import CorrectedModel
from tire_pipeline.mismatch.corrected.model import force_limits
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.model.nominal import Reference
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.tir import read_tir


def corrected(tire, recording, name, **parameters):
    """The model with one effect put in."""
    data = prepare(tire, recording).data
    changes = ((name, {**catalogue()[name].zeros(data), **parameters}),)
    return CorrectedModel(tire, changes, ("fy",), Reference(pressure_nominal=data.nominal.pressure))


def test_friction_goes_into_the_coefficients_of_the_file(tire, record, tmp_path):
    recording = record(0)
    model = corrected(tire, recording, "friction_scale", friction=-0.12)
    again = read_tir(model.to_tir(tmp_path / "c.tir"))
    assert again.coefficients["LMUY"] == pytest.approx(0.88)
    assert again.metadata.get("sidecar") is None
    at = {n: recording[n].to_numpy() for n in ("slip_angle", "normal_load")}
    np.testing.assert_allclose(again.forces(**at).fy, model.predict(recording)["fy"], atol=20.0)


def test_what_the_format_has_no_place_for_stands_in_the_sidecar(tire, record, tmp_path):
    model = corrected(tire, record(0), "inflation_pressure", friction=-0.35)
    again = read_tir(model.to_tir(tmp_path / "corrected.tir"))
    written = again.metadata["sidecar"]["inflation_pressure"]
    assert written["parameters"]["friction"] == pytest.approx(-0.35)
    assert written["reference"]["pressure_nominal"] == model.reference.pressure_nominal
    as_it_was = {name: again.coefficients[name] for name in tire.coefficients}
    assert as_it_was == pytest.approx(dict(tire.coefficients))


def test_an_effect_is_not_put_into_a_recording_that_lacks_its_channel(tire, record):
    model = corrected(tire, record(0), "inflation_pressure", friction=0.2)
    with pytest.raises(RecordingError, match="inflation_pressure needs the channel pressure"):
        model.predict(record(1).drop(columns=["fy", "pressure"]))


def test_a_row_without_slip_costs_no_other_row(tire, record):
    """A lag carried a hole on to the end of the run, and an equation beside it ended in a traceback."""
    recording = record(0)
    model = corrected(tire, recording, "relaxation_length", length=0.3)
    holes = np.arange(len(recording)) % 50 == 7
    found = model.predict(recording.assign(slip_angle=recording["slip_angle"].mask(holes)))["fy"]
    assert np.array_equal(np.isnan(found), holes)
    whole = model.predict(recording)["fy"]
    assert np.max(np.abs(found - whole)) < 0.02 * np.max(np.abs(whole))


def test_a_clipped_force_is_predicted_clipped(tire, record):
    wrong = record().assign(fy=lambda r: np.clip(r["fy"], -3500.0, 3400.0))
    findings = prepare(tire, wrong).findings
    assert [each.name for each in findings] == ["clipping"]
    model = CorrectedModel(tire, (), ("fy",), limits=force_limits(findings, ("fy",)))
    predicted = model.predict(wrong.drop(columns="fy"))["fy"]
    assert (predicted.min(), predicted.max()) == (-3500.0, 3400.0)
