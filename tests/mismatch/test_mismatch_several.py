"""Several recordings explained together, and one held out."""

from __future__ import annotations

import re

import numpy as np
import pytest
from weighed import all_but, without_visible

from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch import Explainer, explain_mismatch, explain_recordings
from tire_pipeline.mismatch.corrected.apart import apart, in_words
from tire_pipeline.mismatch.corrected.model import CorrectedModel
from tire_pipeline.mismatch.each_run import check_conventions
from tire_pipeline.mismatch.report.contents import HeldOutFit, PredictionError
from tire_pipeline.mismatch.report.headline.sentences import on_each
from tire_pipeline.mismatch.several import predict_held_out
from tire_pipeline.recordings import join_recordings
from tire_pipeline.unit_definitions import DEGREE, POUND_FORCE

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


def test_each_recording_has_its_errors_and_one_that_gets_worse_is_named(tire, record, together, tmp_path):
    report, _ = together
    assert [fit.recording for fit in report.each] == ["a", "c"]
    for fit in report.each:
        assert fit.errors["fy"].rms_after < fit.errors["fy"].rms_before
    data = without_visible(report).to_dict()
    assert [each["recording"] for each in data["each"]] == ["a", "c"]
    assert "Error in each recording" in without_visible(report).to_html(tmp_path / "page.html").read_text()
    worse = PredictionError(50.0, 90.0, 1.5, 2.0)
    said = on_each([*report.each, HeldOutFit("d", 100, {"fy": worse})], {"fy": 40.0})
    slightly = PredictionError(60.1, 60.8, 1.005, 1.018)
    assert on_each([HeldOutFit("d", 100, {"fy": slightly})], {"fy": 40.0}) == ""
    assert said.startswith("With what was found, the RMS error of Fy in d (from 50 N to 90 N) rises")
    assert on_each(report.each, {"fy": 40.0}) == ""


def test_a_copy_is_refused(tire, record):
    one = record(1).iloc[:1500]
    later = one.iloc[300:].assign(time=one["time"].iloc[300:] + 100.0)
    for copy in (one.copy(), later, one.iloc[:8]):
        with pytest.raises(RecordingError, match=r"b: .* samples are in a, too"):
            explain_recordings(tire, {"a": one, "b": copy}, held_out="b")


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"fy": 1.0 / POUND_FORCE}, r"b: fy is wrong by 0.22481 \(lbf taken for N\), and a is otherwise"),
        ({"fy": 1e-3}, "b: fy is wrong by 0.001"),
        ({"slip_angle": 1.0 / DEGREE}, "b: slip_angle is wrong by 57"),
        ({"fy": -1.0}, "b: .* has the other sign"),
        ({"normal_load": -1.0}, "b: normal_load has the other sign"),
    ],
)
@pytest.mark.parametrize("held_out", [None, "b"])
def test_other_units_and_signs_of_one_recording_are_no_physics(tire, record, changed, said, held_out):
    """Joined, a force in lbf passed as it was: a tenth of the friction beside the others."""
    a, b = (record(seed).iloc[:1500] for seed in (1, 2))
    other = b.assign(**{name: b[name] * factor for name, factor in changed.items()})
    with pytest.raises(RecordingError, match=said):
        explain_recordings(tire, {"a": a, "b": other}, held_out=held_out)


def test_the_same_wrong_sign_in_all_is_left_to_the_explanation(tire, record):
    runs = {
        name: record(seed).iloc[:1500].assign(fy=lambda r: -r["fy"]) for name, seed in (("a", 1), ("b", 2))
    }
    check_conventions(tire, runs)


def test_what_the_reader_noted_of_explained_and_held_out_is_said(tire, record):
    a, b = (record(seed).iloc[:1500] for seed in (1, 2))
    a.attrs, b.attrs = (
        {"notes": ["Lampe is not used"]},
        {"notes": ["3 rows were dropped"], "assumed": ["ISO"]},
    )
    notes = explain_recordings(tire, {"a": a, "b": b}, held_out="b", explainer=FEW).notes
    assert "a: Lampe is not used" in notes
    assert "b, held out: 3 rows were dropped" in notes
    assert "b, held out: ISO" in notes


def test_a_held_out_recording_that_cannot_be_predicted_leaves_the_rest(tire, record):
    a, b = (record(seed, friction=0.7).iloc[:1500] for seed in (1, 2))
    report = explain_recordings(
        tire, {"a": a, "b": b.drop(columns="fy").assign(fx=1.0)}, held_out="b", explainer=FEW
    )
    assert report.held_out is None
    assert report.effects
    assert any(text.startswith("b, which was held out, tests nothing: ") for text in report.head.remarks)


@pytest.mark.parametrize(
    ("changed", "kind", "value", "said"),
    [
        (lambda r: r.assign(fy=1.1 * r["fy"]), "gain", 0.1, "as if its Fy were 10.* larger"),
        (lambda r: r.assign(slip_angle=r["slip_angle"] - 0.01), "slip", 0.01, r"recorded 0.57 deg too small"),
        (lambda r: r.assign(fy=r["fy"] + 300.0), "offset", 300.0, "had an offset of [+](29|30)"),
    ],
)
def test_what_one_recording_has_alone_is_asked_and_no_cause_of_all(tire, record, changed, kind, value, said):
    """A gain of one load cell was *another surface*, explained; 0.4 deg in one of three *agrees*."""
    runs = {name: record(seed).iloc[:2500] for name, seed in (("a", 1), ("b", 2), ("c", 3))}
    plain = CorrectedModel(tire, (), ("fy",))
    assert apart(plain, join_recordings(runs)) == []
    joined = join_recordings({**runs, "b": changed(runs["b"])})
    (odd,) = apart(plain, joined)
    assert (odd.recording, odd.kind) == ("b", kind)
    assert odd.value == pytest.approx(value, rel=0.1)
    assert re.search(said, in_words(odd))
    begins = joined["time"].iloc[joined.attrs["joined"][2]["first"]]
    new = ("surface_change", {"friction": 0.1, "moment": begins - 0.5, "duration": 0.1})
    gone = join_recordings({**runs, "c": runs["c"].assign(fy=1.1 * runs["c"]["fy"])})
    (odd,) = apart(CorrectedModel(tire, (new,), ("fy",)), gone)
    assert odd.recording == "c"


def test_no_corrected_file_is_written_while_recordings_differ(tire, record, tmp_path):
    runs = {name: record(seed).iloc[:2500] for name, seed in (("a", 1), ("b", 2), ("c", 3))}
    runs["c"] = runs["c"].assign(fy=1.1 * runs["c"]["fy"])
    report = explain_recordings(tire, runs, explainer=FEW)
    assert report.stated_verdict in ("unexplained", f"{report.verdict}, recordings differ")
    assert "he recording c differs from the others, as if its Fy were" in report.summary
    with pytest.raises(RecordingError, match="nothing corrected is written: the recording c differs"):
        report.corrected.to_tir(tmp_path / "corrected.tir")


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
