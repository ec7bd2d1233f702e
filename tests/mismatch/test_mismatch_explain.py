import json
import re

import numpy as np
import pandas as pd
import pytest
from mismatch_shared import shared
from weighed import without_visible

from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula.fitting import fit_magic_formula
from tire_pipeline.mismatch import Explainer, explain_mismatch
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


def test_a_name_is_put_in_or_withheld_and_what_is_expected_is_named_or_said(tire, record):
    """The pressure of the rig varies, and its file has no coefficient of it; shares: ``rates``."""
    report = explain_mismatch(tire, record(0))
    said = {name for e in report.effects for name in (e.name, *e.alternatives)}
    assert {name for name, _ in report.corrected.changes} | set(report.withheld) == set(names(report))
    expected = [remark for remark in report.head.remarks if "acts on every tire" in remark]
    assert len(expected) == ("inflation_pressure" not in said)
    assert all(remark.startswith("Inflation pressure") for remark in expected)


def test_another_simulator_stands_in_for_the_tire(tire, record):
    recording = record(10, pressure_effect=-0.35).iloc[:1500]
    at = {n: recording[n].to_numpy() for n in ("slip_angle", "normal_load")}
    beside = recording.assign(simulated_fy=tire.forces(**at).fy)
    report = explain_mismatch(None, beside)
    came = report.corrected.as_it_came.predict(beside)["fy"]
    np.testing.assert_allclose(came, beside["simulated_fy"], rtol=1e-9, atol=1e-6)
    assert report.fit["fy"].rms_before == pytest.approx(np.sqrt(np.mean((beside["fy"] - came) ** 2)))
    with pytest.raises(RecordingError, match="simulated_fy is needed"):
        report.corrected.predict(recording)


def test_the_report_is_plain_json_and_one_page(pressed, tmp_path):
    report = without_visible(pressed)
    table = report.to_dict()
    assert json.loads(json.dumps(table, allow_nan=False)) == table
    page = report.to_html(tmp_path / "report.html").read_text(encoding="utf-8")
    assert pressed.summary.split(".")[0] in page
    assert not re.search(r"(src|href)\s*=\s*[\"']https?:", page)
    assert all(name in page for name in names(report))
    assert ("Fy over time. The bars at the top" in page) == bool(report.effects)


def test_points_without_time_are_steady(tire, record):
    report = explain_mismatch(tire, record(11).iloc[::30].drop(columns="time"))
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
