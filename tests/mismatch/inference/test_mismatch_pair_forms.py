"""Pairs of effects in the forms that are likeliest beside each other."""

from pathlib import Path

import pytest
from weighed import all_but

from tire_pipeline.mismatch import Explainer
from tire_pipeline.recordings import read_recording
from tire_pipeline.tir import read_tir

EXAMPLES = Path(__file__).parents[3] / "examples"
RIVALS = all_but("inflation_pressure", "force_gain", "load_gain", "wear", "friction_scale", "temperature")


def explained(gain):
    recording = read_recording(EXAMPLES / "rig_run.csv", axes="ISO")
    recording["fy"] *= 1.0 + gain
    return Explainer(without=RIVALS).weigh(read_tir(EXAMPLES / "tire.tir"), recording)


def test_a_gain_does_not_change_the_pressure_at_which_a_file_is_right():
    """The example's file is right at 250 kPa. Alone, a pressure took up the gain best from 300 kPa."""
    pressures = [dict(explained(gain).answer.named.changes)["inflation_pressure"] for gain in (0.0, 0.07)]
    assert pressures[1]["reference"] == pressures[0]["reference"]
    assert pressures[1]["friction"] == pytest.approx(pressures[0]["friction"], abs=0.02)


def test_a_gain_beside_a_pressure_has_its_size():
    answer = explained(0.07).answer
    assert any("force_gain" in names for names, _ in answer.sets)
    assert answer.names == ("inflation_pressure", "force_gain")
    assert dict(answer.named.changes)["force_gain"]["fy"] == pytest.approx(0.07, abs=0.01)
