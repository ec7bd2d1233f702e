import re

import numpy as np
import pandas as pd
import pytest
from brake_rig import brake_sweeps, weighted
from small_rig import EXACT_FAULTS, schedule
from weighed import all_but

from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch import Explainer, explain_mismatch, explain_recordings
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.mismatch.report.words import interval, place
from tire_pipeline.recordings import join_recordings


def bad(recording, what):
    r = recording.copy()
    if what == "no force":
        return r.drop(columns="fy")
    if what == "no load":
        return r.drop(columns="normal_load")
    if what == "no slip":
        return r.drop(columns="slip_angle")
    if what == "ten samples":
        return r.iloc[:10]
    if what == "backwards":
        r.loc[500, "time"] = 1.0
    if what == "repeated":
        r.loc[500, "time"] = r.loc[499, "time"]
    if what == "no overlap":
        r["normal_load"] = 40.0 + 0 * r["normal_load"]
        r["fy"] = 1.0 + 0 * r["fy"]
    if what == "all missing":
        r["fy"] = np.nan
    if what == "beyond any measurement":
        r["fy"] *= 1e300
    if what == "never together":
        r.loc[::2, "fy"], r.loc[1::2, "normal_load"] = np.nan, np.nan
    if what == "true or false":
        r["camber"] = r["slip_angle"] > 0.0
    if what == "two units":
        r.loc[len(r) // 2 :, "slip_angle"] = np.degrees(r["slip_angle"])
    if what == "complex":
        r["fy"] = r["fy"].astype(complex)
    return r


@pytest.mark.parametrize(
    ("what", "word"),
    [
        ("no force", "force"),
        ("no load", "normal_load"),
        ("no slip", "slip"),
        ("ten samples", "10 samples"),
        ("backwards", "backwards"),
        ("repeated", "repeated"),
        ("no overlap", "overlap"),
        ("all missing", "force"),
        ("beyond any measurement", "force"),
        ("never together", "normal_load, fy"),
        ("true or false", "camber is true or false"),
        ("complex", "fy is complex"),
        ("two units", "no one unit fits all values"),
    ],
)
def test_what_cannot_be_used_is_said(tire, record, what, word):
    with pytest.raises(RecordingError, match=word) as caught:
        explain_mismatch(tire, bad(record(), what))
    assert caught.value.todo


def test_neither_model_nor_simulation(record):
    with pytest.raises(RecordingError, match="simulated_fy"):
        explain_mismatch(None, record())


def test_equations_that_cannot_be_solved_are_said_with_the_step(tire, record, monkeypatch):
    def broken(*_):
        raise np.linalg.LinAlgError("Singular matrix")

    monkeypatch.setattr("tire_pipeline.mismatch.explain.enumerate_sets", broken)
    with pytest.raises(RecordingError, match=r"step sets: .*Singular matrix"):
        explain_mismatch(tire, record())


def test_not_a_frame(tire):
    with pytest.raises(RecordingError, match="DataFrame"):
        explain_mismatch(tire, [1, 2, 3])


def test_a_pressure_that_may_be_in_two_units_is_left_out(tire, record):
    """75 could be kPa, of a racing tire, or psi, of a van's; no name says which."""
    recording = record().assign(pressure=75.0)
    recording.attrs["channels"] = {"pressure": "P"}
    prepared = prepare(tire, recording)
    assert "pressure" not in prepared.data.present
    assert prepared.findings == []
    (note,) = (note for note in prepared.notes if note.startswith("pressure is left out"))
    assert "75 to 75 Pa is no tire's" in note
    assert "--unit P=kPa, in Python units={'P': 'kPa'}" in note
    stated = prepare(tire.replace(NOMPRES=80e3), record().assign(pressure=75.0))
    assert [f.channel for f in stated.findings] == ["pressure"]
    assert stated.factors["pressure"] == pytest.approx(1000.0)


RIG_NOISE = 25.0
"""Of the force in the small rig's recordings, N."""


@pytest.mark.parametrize(
    "factors", [{"slip_angle": 57.29578}, {"fy": -1.0}, {"normal_load": 1e-3}, {"fy": 1e-3}]
)
def test_the_corrected_model_says_what_the_same_rig_would_record(tire, record, factors):
    """Wrong signs and units are in what it is given and in what it gives."""
    right, other = record(0), record(1)
    wrong, again = (r.assign(**{n: r[n] * f for n, f in factors.items()}) for r in (right, other))
    report = explain_mismatch(tire, wrong, without=all_but("friction_scale", "force_offset", "force_gain"))
    predicted = report.corrected.predict(again.drop(columns="fy"))["fy"]
    left = (predicted - again["fy"]) / abs(factors.get("fy", 1.0))
    assert np.std(left) < 2.0 * RIG_NOISE


def test_what_reaches_its_limit_once_is_clipped_and_not_stuck(tire, record):
    r = record()
    wrong = r[r["time"] < 22.0].assign(fy=lambda r: np.minimum(r["fy"], 4800.0))
    at_limit = (wrong["fy"] == 4800.0).to_numpy()
    assert at_limit.sum() > 50
    assert np.count_nonzero(np.diff(at_limit.astype(int)) == 1) == 1
    assert [f.name for f in prepare(tire, wrong).findings] == ["clipping"]


def cambered(tire, seed):
    """A tire that leans to both sides, and its recording."""
    leaning = tire.replace(PHY3=-0.03, PVY3=-0.3, PDY3=-5.0)
    t, alpha, load, _ = schedule()
    rng = np.random.default_rng(seed)
    camber = np.where(t // 30.0 % 2.0 == 0.0, 0.05, -0.03)
    wave = np.sin(5.0 * np.arctan(alpha / 0.06)) * np.abs(alpha) / (np.abs(alpha) + 0.03)
    fy = leaning.forces(slip_angle=alpha, normal_load=load, camber=camber).fy + 0.006 * load * wave
    noise = rng.standard_normal((4, t.size)) * [[1e-4], [1e-4], [8.0], [25.0]]
    columns = zip(("slip_angle", "camber", "normal_load", "fy"), (alpha, camber, load, fy), strict=True)
    return leaning, pd.DataFrame({"time": t} | {n: x + e for (n, x), e in zip(columns, noise, strict=True)})


def test_a_slip_that_is_next_to_nothing_is_written_as_nothing():
    assert interval("slip_ratio", -3.76e-6, 0.153) == "slip ratio 0 to 0.153"
    assert interval("camber", -7.6e-7, -7.6e-7) == "camber 0 deg"
    assert interval("speed", 22.221, 22.224) == "speed 22.2 m/s"
    assert place("normal_load", 4001.0, 4003.0, {}) == "at load 4 kN"
    assert place("normal_load", 4000.0, 5000.0, {}) == "at load between 4 and 5 kN"
    assert interval("time", 757.0, 1057.4) == "time 757 to 1,057 s"
    assert interval("normal_load", 1200.0, 4300.0) == "load 1.2 to 4.3 kN"


def test_both_ends_of_a_range_have_the_same_decimals():
    assert interval("time", 52.9, 60.0) == "time 52.9 to 60.0 s"
    assert place("time", 22.5, 38.0, {}) == "between 22.5 and 38.0 s"
    assert interval("time", 0.0523, 96.2) == "time 0.1 to 96.2 s"
    assert interval("speed", -0.01, 12.3) == "speed 0 to 12.3 m/s"
    assert interval("normal_load", 2000.0, 4000.0) == "load 2 to 4 kN"
    assert interval("time", 0.0, 96.2) == "time 0 to 96.2 s"


def test_the_seam_of_two_recordings_is_no_gap_in_the_time_line(tire, record):
    one, two = record(0).iloc[:300], record(1).iloc[:300]
    notes = prepare(tire, join_recordings({"a": one, "b": two})).notes
    assert not [note for note in notes if "time line" in note]
    broken = two.assign(time=two["time"] + 9.0 * (np.arange(300) > 150))
    (note,) = (n for n in prepare(tire, join_recordings({"a": one, "b": broken})).notes if "time line" in n)
    assert note == "a gap in the time line of 9.04 s"


def test_numbers_that_came_as_text_and_dates_are_read(tire, record):
    plain = record(0).iloc[:300]
    stamps = pd.Timestamp("2024-05-01") + pd.to_timedelta(plain["time"], unit="s")
    text = plain.assign(time=stamps, fy=plain["fy"].astype(str))
    explainer = Explainer(without=all_but("friction_scale", "force_offset"))
    first, second = (explainer.weigh(tire, r) for r in (plain, text))
    np.testing.assert_array_equal(second.prepared.data.recorded["fy"], first.prepared.data.recorded["fy"])
    np.testing.assert_allclose(second.prepared.data.time, first.prepared.data.time, atol=1e-9)
    assert second.answer.names == first.answer.names


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (lambda r: pd.concat([r, r["fy"]], axis=1), "several columns of the name fy -> keep one"),
        (
            lambda r: r.assign(fy=[*r["fy"][:-1], "saturated"]),
            "fy: 1 of 300 values are no numbers, the first in row 299: 'saturated'",
        ),
    ],
)
def test_what_is_no_number_is_named_with_its_row(tire, record, spoil, message):
    with pytest.raises(RecordingError, match=re.escape(message)):
        explain_mismatch(tire, spoil(record(0).iloc[:300]))


def test_something_else_than_a_tire_is_refused(record):
    with pytest.raises(RecordingError, match="of type str, which is no tire model -> read it with read_tir"):
        explain_mismatch("tire.tir", record(0))


def test_an_error_names_the_recording(tire, record):
    with pytest.raises(RecordingError, match=r"run\.csv, time: time goes backwards"):
        explain_recordings(tire, {"run.csv": record(0).iloc[::-1]})


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("fault", "name"), EXACT_FAULTS)
def test_exact_faults_get_their_name_and_no_other(tire, record, fault, name, seed):
    """Before any fit, which then finds nothing beside them: ``rates``."""
    assert [finding.name for finding in prepare(tire, fault(record(seed))).findings] == [name]


@pytest.mark.parametrize(
    ("turned", "channel"),
    [(["fy"], "fy"), (["slip_angle", "camber"], "fy"), (["camber", "fy"], "slip_angle")],
)
def test_signs_that_were_turned_one_after_the_other_are_said_once(tire, turned, channel, draws):
    """The fewest channels are named; that slip angle and camber would look the same as Fy is said beside."""
    for seed in draws:
        leaning, recording = cambered(tire, seed)
        found = prepare(leaning, recording.assign(**{n: -recording[n] for n in turned})).findings
        assert [(each.name, each.channel) for each in found] == [("sign_convention", channel)]


def test_gaps_and_missing_blocks_are_said(tire, record):
    recording = record()
    recording = recording[~recording["time"].between(40.0, 52.0)].reset_index(drop=True)
    recording.loc[recording["time"].between(72.0, 80.0), "fy"] = np.nan
    notes = prepare(tire, recording).notes
    assert any("gap" in note for note in notes)
    assert any("without a number" in note for note in notes)


def test_a_load_of_both_signs_is_no_recording_to_explain(tire, record):
    """It was unexplained, with an equation "in camber" that took 950 N to 354 N."""
    recording = record(2)
    half = np.where(np.arange(len(recording)) < len(recording) // 2, 1.0, -1.0)
    report = explain_mismatch(tire, recording.assign(normal_load=half * recording["normal_load"]))
    assert report.verdict == "unusable"
    assert "normal_load is negative in" in report.summary


def test_a_slip_ratio_by_the_loaded_radius_is_told(tire):
    frame = brake_sweeps(weighted(tire), [0.0]).assign(effective_radius=0.31, loaded_radius=0.3)
    frame["wheel_speed"] = (1.0 + frame["slip_ratio"]) * frame["speed"] / 0.31
    told = "slip_ratio, which is wheel_speed x loaded_radius / speed - 1"
    assert not any(told in note for note in prepare(tire, frame).notes)
    loaded = frame.assign(slip_ratio=0.3 * frame["wheel_speed"] / frame["speed"] - 1.0)
    assert any(told in note for note in prepare(tire, loaded).notes)
