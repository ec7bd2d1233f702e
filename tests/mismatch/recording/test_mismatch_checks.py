import re

import numpy as np
import pandas as pd
import pytest
from small_rig import schedule

from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch import Explainer, explain_mismatch, explain_recordings
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.mismatch.report.words import interval, place


def physics(report):
    return [e.name for e in report.effects if catalogue()[e.name].kind == "physics"]


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
    ],
)
def test_what_cannot_be_used_is_said(tire, record, what, word):
    with pytest.raises(RecordingError, match=word) as caught:
        explain_mismatch(tire, bad(record(), what))
    assert caught.value.todo


def test_neither_model_nor_simulation(record):
    with pytest.raises(RecordingError, match="simulated_fy"):
        explain_mismatch(None, record())


def test_noise_of_a_slip_has_no_unit(braked, record):
    """Less of it would always fit better, a hundredth best of all."""
    recording = record(2)
    noise = np.random.default_rng(2).normal(0.0, [[4e-3], [5.0]], (2, len(recording)))
    assert explain_mismatch(braked, recording.assign(slip_ratio=noise[0], fx=noise[1])).effects == []


def test_equations_that_cannot_be_solved_are_said_with_the_step(tire, record, monkeypatch):
    def broken(*_):
        raise np.linalg.LinAlgError("Singular matrix")

    monkeypatch.setattr("tire_pipeline.mismatch.explain.enumerate_sets", broken)
    with pytest.raises(RecordingError, match=r"step sets: .*Singular matrix"):
        explain_mismatch(tire, record())


def test_not_a_frame(tire):
    with pytest.raises(RecordingError, match="DataFrame"):
        explain_mismatch(tire, [1, 2, 3])


@pytest.mark.parametrize(
    ("change", "name"),
    [
        (lambda r: r.assign(slip_angle=np.degrees(r["slip_angle"])), "unit_error"),
        (lambda r: r.assign(normal_load=r["normal_load"] / 4.4482216), "unit_error"),
        (lambda r: r.assign(fy=r["fy"] / 1000.0), "unit_error"),
        (lambda r: r.assign(pressure=r["pressure"] / 6894.757), "unit_error"),
        (lambda r: r.assign(fy=-r["fy"]), "sign_convention"),
        (lambda r: r.assign(slip_angle=-r["slip_angle"]), "sign_convention"),
        (
            lambda r: r.assign(fy=r["fy"].where(~r["time"].between(60, 90), r["fy"].iloc[1500])),
            "stuck_channel",
        ),
    ],
)
def test_exact_artefacts_get_their_name_and_nothing_else(tire, record, change, name):
    report = explain_mismatch(tire, change(record()))
    assert [e.name for e in report.effects] == [name]
    assert physics(report) == []


RIG_NOISE = 25.0
"""Of the force in the small rig's recordings, N."""


@pytest.mark.parametrize(
    "factors", [{"slip_angle": 57.29578}, {"fy": -1.0}, {"normal_load": 1e-3}, {"fy": 1e-3}]
)
def test_the_corrected_model_says_what_the_same_rig_would_record(tire, record, factors):
    """Wrong signs and units are in what it is given and in what it gives."""
    right, other = record(0), record(1)
    wrong, again = (r.assign(**{n: r[n] * f for n, f in factors.items()}) for r in (right, other))
    predicted = explain_mismatch(tire, wrong).corrected.predict(again.drop(columns="fy"))["fy"]
    left = (predicted - again["fy"]) / abs(factors.get("fy", 1.0))
    assert np.std(left) < 2.0 * RIG_NOISE


def test_what_reaches_its_limit_once_is_clipped_and_not_stuck(tire, record):
    r = record()
    wrong = r[r["time"] < 22.0].assign(fy=lambda r: np.minimum(r["fy"], 4800.0))
    at_limit = (wrong["fy"] == 4800.0).to_numpy()
    assert at_limit.sum() > 50
    assert np.count_nonzero(np.diff(at_limit.astype(int)) == 1) == 1
    assert [f.name for f in prepare(tire, wrong).findings] == ["clipping"]


def test_a_clipped_force_is_named_and_predicted_clipped(tire, record):
    wrong = record().assign(fy=lambda r: np.clip(r["fy"], -3500.0, 3400.0))
    report = explain_mismatch(tire, wrong)
    assert [e.name for e in report.effects] == ["clipping"]
    predicted = report.corrected.predict(wrong.drop(columns="fy"))["fy"]
    assert (predicted.min(), predicted.max()) == (-3500.0, 3400.0)


@pytest.fixture(scope="module")
def cambered(tire):
    """A tire that leans to both sides, and its recording."""
    leaning = tire.replace(PHY3=-0.03, PVY3=-0.3, PDY3=-5.0)
    t, alpha, load, _ = schedule()
    rng = np.random.default_rng(4)
    camber = np.where(t // 30.0 % 2.0 == 0.0, 0.05, -0.03)
    wave = np.sin(5.0 * np.arctan(alpha / 0.06)) * np.abs(alpha) / (np.abs(alpha) + 0.03)
    fy = leaning.forces(slip_angle=alpha, normal_load=load, camber=camber).fy + 0.006 * load * wave
    noise = rng.standard_normal((4, t.size)) * [[1e-4], [1e-4], [8.0], [25.0]]
    columns = zip(("slip_angle", "camber", "normal_load", "fy"), (alpha, camber, load, fy), strict=True)
    return leaning, pd.DataFrame({"time": t} | {n: x + e for (n, x), e in zip(columns, noise, strict=True)})


@pytest.mark.parametrize(
    ("turned", "channel"),
    [(["fy"], "fy"), (["slip_angle", "camber"], "fy"), (["camber", "fy"], "slip_angle")],
)
def test_signs_that_were_turned_one_after_the_other_are_said_once(cambered, turned, channel):
    """The fewest channels are named; that slip angle and camber would look the same as Fy is said beside."""
    leaning, recording = cambered
    found = explain_mismatch(leaning, recording.assign(**{n: -recording[n] for n in turned})).effects
    assert [(e.name, e.output) for e in found] == [("sign_convention", channel)]


def test_a_slip_that_is_next_to_nothing_is_written_as_nothing():
    assert interval("slip_ratio", -3.76e-6, 0.153) == "slip ratio 0 to 0.153"
    assert interval("camber", -7.6e-7, -7.6e-7) == "camber 0 deg"
    assert interval("speed", 22.221, 22.224) == "speed 22.2 m/s"
    assert place("normal_load", 4001.0, 4003.0, {}) == "at load 4 kN"
    assert place("normal_load", 4000.0, 5000.0, {}) == "at load between 4 and 5 kN"
    assert interval("normal_load", 1200.0, 4300.0) == "load 1.2 to 4.3 kN"


def test_gaps_and_missing_blocks_are_no_physics(tire, record):
    r = record()
    r = r[~r["time"].between(40.0, 52.0)].reset_index(drop=True)
    r.loc[r["time"].between(72.0, 80.0), "fy"] = np.nan
    report = explain_mismatch(tire, r)
    assert report.effects == []
    assert any("gap" in n for n in report.notes)
    assert any("no number" in n for n in report.notes)


def test_numbers_that_came_as_text_and_dates_are_read(tire, record):
    plain = record(0).iloc[:300]
    stamps = pd.Timestamp("2024-05-01") + pd.to_timedelta(plain["time"], unit="s")
    text = plain.assign(time=stamps, fy=plain["fy"].astype(str))
    first, second = (Explainer().weigh(tire, r) for r in (plain, text))
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
