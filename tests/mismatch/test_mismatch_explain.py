import json
import re

import numpy as np
import pandas as pd
import pytest
from mismatch_shared import shared
from weighed import all_but, named, without_visible

from tire_pipeline.concealed.scoring.rows import share_row
from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula.fitting import fit_magic_formula
from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.recordings import read_recording
from tire_pipeline.tir import read_tir

FEW = ("inflation_pressure", "friction_scale", "force_offset")
"""Effects that are weighed where it does not matter which ones."""


def names(report):
    return [e.name for e in report.effects]


@pytest.fixture(scope="module")
def pressed(tire, record):
    """Report of a recording in which the pressure matters much."""
    return explain_mismatch(tire, record(3, pressure_effect=-0.6), without=all_but(*FEW))


def test_what_acts_on_every_tire_is_named_or_said(tire, record, pressed):
    """The pressure of the rig varies, and its file has no coefficient of it; shares: ``rates``."""
    for report in (pressed, explain_mismatch(tire, record(3), without=all_but(*FEW))):
        said = {name for e in report.effects for name in (e.name, *e.alternatives)}
        assert {name for name, _ in report.corrected.changes} | set(report.withheld) == set(names(report))
        expected = [remark for remark in report.head.remarks if "acts on every tire" in remark]
        assert len(expected) == ("inflation_pressure" not in said)
        assert all(remark.startswith("Inflation pressure") for remark in expected)


def test_another_simulator_stands_in_for_the_tire(tire, record):
    recording = record(10, pressure_effect=-0.35).iloc[:1500]
    at = {n: recording[n].to_numpy() for n in ("slip_angle", "normal_load")}
    beside = recording.assign(simulated_fy=tire.forces(**at).fy)
    report = explain_mismatch(None, beside, without=all_but(*FEW))
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


@pytest.fixture(scope="module")
def cambered_points():
    """The TYDEX points, and a fit to those without camber."""
    points = read_recording(shared("recordings/tydex/DT_195_65R15_demo.tdx"))
    flat = points[points["camber"].abs() < 0.002]
    return fit_magic_formula(flat[["slip_angle", "camber", "normal_load", "fy"]]).model, points


def test_camber_that_the_fit_has_not_seen_is_named_in_real_points(cambered_points):
    """What it does to points that are held out: ``test_mismatch_real_recordings.py``."""
    assert named(*cambered_points) == ["camber"]


@pytest.mark.long
def test_most_of_the_ten_examples_are_read_right(examples):
    folder, labels = examples
    right = []
    for name, label in sorted(labels.items()):
        recording = pd.read_csv(folder / name / "recording.csv")
        right.append(set(named(read_tir(folder / name / "model.tir"), recording)) == set(label["left_out"]))
    row = share_row("the ten examples", right)
    print(f"{row['value']:.2f} ({row['low']:.2f} to {row['high']:.2f}) of {row['n']}: {right}")
    assert row["high"] >= 0.9
