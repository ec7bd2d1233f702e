import json
import re
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from mismatch_shared import shared
from weighed import without_visible

from tire_pipeline.magic_formula.fitting import fit_magic_formula
from tire_pipeline.mismatch import Explainer, explain_mismatch
from tire_pipeline.mismatch.proof.locate import Located
from tire_pipeline.mismatch.report.sentences import head
from tire_pipeline.recordings import read_recording
from tire_pipeline.tir import read_tir

_LONG = pytest.mark.long
IN_CI = (1, 2)
"""A relaxation, and a temperature without its channel; tests of its own have what else is in the examples."""


def names(report):
    return [e.name for e in report.effects]


@pytest.fixture(scope="module")
def pressed(tire, record):
    """Report of a recording in which the pressure matters."""
    return explain_mismatch(tire, record(3, pressure_effect=-0.35))


def test_nothing_missing_agrees(tire, record):
    report = explain_mismatch(tire, record(0))
    assert report.verdict == "agrees"
    assert report.effects == []
    assert report.corrected.changes == ()
    expected = [remark for remark in report.head.remarks if "acts on every tire" in remark]
    assert expected[0].startswith("Inflation pressure")  # it varies; the file has no coefficient


def test_pressure_is_found_located_and_put_in(pressed, record, tmp_path):
    report = pressed
    assert names(report) == ["inflation_pressure"]
    assert not any("acts on every tire" in remark for remark in report.head.remarks)
    effect = report.effects[0]
    value, error, unit = effect.parameters["friction"]
    assert value == pytest.approx(-0.35, abs=0.05)
    assert 0.0 < error < 0.1  # beside a background of usual effects
    assert unit == "1"
    assert min(a for a, _ in effect.when) > 49.0
    assert report.fit["fy"].rms_after < 0.5 * report.fit["fy"].rms_before
    assert report.located
    other = record(4, pressure_effect=-0.35)
    predicted = report.corrected.predict(other.drop(columns="fy"))["fy"]
    assert np.sqrt(np.mean((other["fy"] - predicted) ** 2)) < 0.5 * report.fit["fy"].rms_before
    path = report.corrected.to_tir(tmp_path / "corrected.tir")
    again = read_tir(path)
    assert again.metadata["sidecar"]["inflation_pressure"]["parameters"]["friction"] == pytest.approx(value)


def test_friction_goes_into_the_tir(tire, record, tmp_path):
    report = explain_mismatch(tire, record(5, friction=0.88))
    assert names(report) == ["friction_scale"]
    again = read_tir(report.corrected.to_tir(tmp_path / "c.tir"))
    assert again.coefficients["LMUY"] == pytest.approx(0.88, abs=0.02)
    assert explain_mismatch(again, record(6, friction=0.88)).verdict == "agrees"


def test_delay_and_offset_are_artefacts(tire, record):
    assert names(explain_mismatch(tire, record(7, delay=0.08)))[0] in {"time_delay", "low_pass"}
    found = explain_mismatch(tire, record(8, offset=150.0))
    assert names(found) == ["force_offset"]
    assert found.effects[0].parameters["fy"][0] == pytest.approx(150.0, abs=10.0)


def test_what_is_not_in_the_catalogue_gets_no_name(tire, record):
    recording = record(9)
    rng = np.random.default_rng(1)
    t = recording["time"].to_numpy()
    wave = np.sin(2 * np.pi * (1.3 * t + 0.4 * np.sin(0.7 * t)))
    recording["fy"] += 400.0 * wave * (np.abs(recording["slip_angle"]) > 0.08) + rng.normal(size=t.size)
    report = explain_mismatch(tire, recording)
    assert report.verdict == "unexplained"
    assert report.effects == []
    assert report.remainder.size["fy"] > 100.0
    assert report.next_experiment


def test_another_simulator_stands_in_for_the_tire(tire, record):
    recording = record(10, pressure_effect=-0.35)
    recording["simulated_fy"] = tire.forces(
        slip_angle=recording["slip_angle"].to_numpy(), normal_load=recording["normal_load"].to_numpy()
    ).fy
    report = explain_mismatch(None, recording)
    assert names(report) == ["inflation_pressure"]
    left = recording["fy"] - report.corrected.predict(recording)["fy"]
    assert np.sqrt(np.mean(left**2)) < 0.6 * report.fit["fy"].rms_before


def test_the_report_is_plain_json_and_one_page(pressed, tmp_path):
    report = without_visible(pressed)
    table = report.to_dict()
    assert json.loads(json.dumps(table, allow_nan=False)) == table
    page = report.to_html(tmp_path / "report.html").read_text(encoding="utf-8")
    assert pressed.summary.split(".")[0] in page
    assert not re.search(r"(src|href)\s*=\s*[\"']https?:", page)
    assert "inflation_pressure" in page
    assert "Fy over time. The bars at the top" in page


@pytest.mark.parametrize(
    ("when", "said"),
    [
        ([(10.0, 20.0)], " (seen between 10 and 20 s),"),
        ([(10.0, 20.0), (30.0, 41.5)], " (seen between 10 and 20 s, 30 and 41.5 s),"),
        ([(0.0, 80.0)], ","),
        ([], ","),
    ],
)
def test_the_summary_says_when_an_effect_is_seen(pressed, when, said):
    (effect,) = pressed.effects
    left, ranges = pressed.remainder, {"time": (0.0, 100.0)}
    text = head("explained", [replace(effect, when=when)], pressed.fit, [], left, "", ranges).text
    assert text.startswith(
        f"Explained: the difference comes from {effect.title}{said} which the model leaves out. "
    )
    assert text.endswith("Next, test the corrected model on another recording before you use it.")


@pytest.mark.parametrize(
    ("when", "mean"), [([(10.0, 20.0)], 0.1), ([(10.0, 20.0)], 0.3), ([(0.0, 80.0)], 0.1)]
)
def test_what_differs_to_both_sides_is_not_said_by_a_small_mean(pressed, when, mean):
    effect = replace(pressed.effects[0], when=when, share=0.9)
    at = Located("fy", "slip_angle", 0.05, 0.1, mean * pressed.fit["fy"].rms_before, 0.01, 0.04, True)
    text = head("explained", [effect], pressed.fit, [at], pressed.remainder, "", {"time": (0.0, 100.0)}).text
    said = "Fy differs most between 10 and 20 s, to both sides" in text
    assert said == (when == [(10.0, 20.0)] and mean < 0.2)
    assert ("is on average" in text) != said


def test_points_without_time_are_steady(tire, record):
    r = record(11)
    points = r.iloc[::30].drop(columns="time")
    report = explain_mismatch(tire, points)
    assert report.verdict == "agrees"
    why = {c["name"]: c["why"] for c in report.candidates}
    assert "no time" in why["time_delay"]


@pytest.mark.slow
def test_tydex_camber_is_found_and_halves_the_error():
    t = read_recording(shared("recordings/tydex/DT_195_65R15_demo.tdx"))
    flat = t["camber"].abs() < 0.002
    model = fit_magic_formula(t[flat][["slip_angle", "camber", "normal_load", "fy"]]).model
    held = ~flat & (np.random.default_rng(0).random(len(t)) < 0.4)
    report = explain_mismatch(model, t[~held])
    assert names(report) == ["camber"]
    rest = t[held]
    before = model.forces(
        slip_angle=rest["slip_angle"].to_numpy(),
        camber=rest["camber"].to_numpy(),
        normal_load=rest["normal_load"].to_numpy(),
    ).fy
    after = report.corrected.predict(rest)["fy"]
    assert np.std(rest["fy"] - after) < 0.5 * np.std(rest["fy"] - before)


@pytest.mark.slow
@pytest.mark.parametrize("number", [pytest.param(n, marks=() if n in IN_CI else _LONG) for n in range(10)])
def test_the_ten_examples_are_read_right(examples, number):
    folder, labels = examples
    name = f"example{number:02d}"
    recording = pd.read_csv(folder / name / "recording.csv")
    explained = Explainer().weigh(read_tir(folder / name / "model.tir"), recording)
    found = {finding.name for finding in explained.prepared.findings}
    assert found | set(explained.answer.names) == set(labels[name]["left_out"])
