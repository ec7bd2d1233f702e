"""A channel that was recorded and left out is never called *not recorded*; the report gives the reason."""

from __future__ import annotations

from pathlib import Path

from weighed import all_but

from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.report.remarks import reasons, with_reasons
from tire_pipeline.recordings import read_recording
from tire_pipeline.tir import read_tir

EXAMPLES = Path(__file__).parents[3] / "examples"


def test_reasons_are_those_of_the_notes():
    notes = [
        "slip_ratio is -1 throughout and left out: without it the model explains 97% of the variance of Fy",
        "pressure is left out: cold.csv has none. It varies in warm.csv: nothing is told there",
        "speed is not recorded, so the relaxation lengths that the file states are left out",
    ]
    assert reasons(notes) == {
        "slip_ratio": "without it the model explains 97% of the variance of Fy",
        "pressure": "cold.csv has none",
    }
    told = with_reasons("slip_ratio is not recorded and taken as zero", reasons(notes))
    assert told.startswith("slip_ratio is left out (without it")
    assert with_reasons("camber is not recorded", reasons(notes)) == "camber is not recorded"


def test_a_pressure_in_an_unknown_unit_is_left_out_and_not_called_unrecorded(tmp_path):
    run = read_recording(EXAMPLES / "rig_run.csv", axes="ISO")
    run["pressure"] = run["pressure"] * 3e-4  # 75: kPa or psi
    few = all_but("inflation_pressure", "friction_scale", "camber")
    report = explain_mismatch(read_tir(EXAMPLES / "tire.tir"), run, without=few)
    report.to_html(tmp_path / "report.html")
    page = (tmp_path / "report.html").read_text()
    rows = [row.text for row in report.visible if row.name == "inflation_pressure"]
    for text in (page, *rows, " ".join(c["why"] for c in report.candidates)):
        assert "pressure is not recorded" not in text
        assert "pressure is left out (" in text
        assert "its unit cannot be told" in text
    assert "camber is not recorded" in page
    assert "Next, state the unit of pressure" in report.summary
