"""Several recordings explained together, and one held out."""

from __future__ import annotations

import numpy as np
import pytest
from weighed import all_but, without_visible

from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch import Explainer, explain_mismatch, explain_recordings
from tire_pipeline.mismatch.several import predict_held_out

FEW = Explainer(without=all_but("friction_scale", "stiffness_scale", "force_offset"))
"""What is named does not matter here: few effects are weighed."""


@pytest.fixture(scope="module")
def together(tire, record):
    runs = {name: record(seed, friction=0.7).iloc[:2500] for name, seed in (("a", 5), ("b", 6), ("c", 7))}
    return explain_recordings(tire, runs, held_out="b", explainer=FEW), runs


def test_the_corrected_model_predicts_the_recording_that_was_held_out(together):
    """How often what two share predicts the third: ``rates``."""
    report, runs = together
    error = report.held_out.errors["fy"]
    assert report.recordings == ("a", "c")
    assert (report.held_out.recording, report.held_out.samples) == ("b", len(runs["b"]))
    predicted = report.corrected.predict(runs["b"])["fy"]
    assert error.rms_after == pytest.approx(np.sqrt(np.mean((runs["b"]["fy"] - predicted) ** 2)))
    assert error.ratio_low <= error.rms_after / error.rms_before <= error.ratio_high
    assert "in b, which was held out, the RMS error of Fy" in report.summary


def test_the_held_out_recording_takes_no_part(tire, together, record):
    report, runs = together
    other = {**runs, "b": record(8, friction=1.3).iloc[:2500]}
    again = explain_recordings(tire, other, held_out="b", explainer=FEW)
    assert again.corrected.changes == report.corrected.changes
    assert again.held_out.errors["fy"] != report.held_out.errors["fy"]


def test_page_and_data_have_the_held_out_recording(together, tmp_path):
    report = without_visible(together[0])
    data = report.to_dict()
    assert data["recordings"] == ["a", "c"]
    assert data["held_out"]["errors"]["fy"]["rms_after"] == report.held_out.errors["fy"].rms_after
    page = report.to_html(tmp_path / "page.html").read_text()
    assert "Tested on a held-out recording" in page
    assert "Explained together: a, c." in page


def test_moments_and_samples_without_numbers(together, record):
    report, _ = together
    other = record(9, friction=0.88).iloc[:1000].copy()
    other.loc[other.index[:10], "slip_angle"] = np.nan
    other.loc[other.index[10:20], "fy"] = np.nan
    fit = predict_held_out(report.corrected, other, "d")
    assert fit.samples == 990
    assert np.isfinite(fit.errors["fy"].rms_after)
    with pytest.raises(RecordingError, match="none of the forces"):
        predict_held_out(report.corrected, other.drop(columns="fy"), "d")


def test_a_name_that_is_not_there_and_nothing_left_are_errors(tire, record):
    one = record(1).iloc[:1500]
    with pytest.raises(RecordingError, match="no recording 'x' to hold out"):
        explain_recordings(tire, {"a": one, "b": one}, held_out="x")
    with pytest.raises(RecordingError, match="only recording is held out"):
        explain_recordings(tire, {"a": one}, held_out="a")


def test_a_report_is_drawn_and_fits_in_a_notebook(together):
    report, _ = together
    figure = report.plot()
    texts = [
        text
        for part in figure.subfigs
        for axis in part.axes
        for text in (axis.get_xlabel(), axis.get_ylabel())
    ]
    assert {"time (s)", "Fy recorded - simulated (N)", "slip angle (deg)", "normal load (kN)"} <= set(texts)
    assert "recorded minus simulated" in figure.subfigs[0].get_supxlabel()
    assert repr(report).startswith(f"MismatchReport({report.verdict!r}: ")
    assert "<th>RMS before</th>" in report._repr_html_()


def test_a_radius_that_no_wheel_has_is_noted_of_one_recording_and_of_several(tire, record):
    runs = {name: record(seed).iloc[:1500].assign(loaded_radius=305.0) for name, seed in (("a", 5), ("b", 6))}
    said = [note for note in explain_recordings(tire, runs, explainer=FEW).notes if "no wheel has" in note]
    assert [note.partition(" is ")[0] for note in said] == ["a: loaded_radius", "b: loaded_radius"]
    alone = explain_mismatch(tire, runs["a"], without=all_but("force_offset"))
    assert [n.partition(" is ")[0] for n in alone.notes if "no wheel has" in n] == ["loaded_radius"]
