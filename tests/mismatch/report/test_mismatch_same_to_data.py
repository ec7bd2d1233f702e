"""An effect says what else would look the same in the data, wherever it is named."""

import numpy as np
import pytest
from weighed import all_but

from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.mismatch.report.report_page import render

FAULT = "a wrong gain of the slip channel"


@pytest.fixture(scope="module")
def stiffer(tire, record):
    return explain_mismatch(
        tire, record(3, stiffness=1.2), without=all_but("stiffness_scale", "force_offset")
    )


def test_a_slip_stiffness_may_be_a_gain_of_the_slip_channel(stiffer):
    (effect,) = stiffer.effects
    assert effect.name == "stiffness_scale"
    assert effect.same_to_data == ((FAULT, "artefact"),)
    assert FAULT in stiffer.summary
    assert "which the model leaves out" not in stiffer.summary


def test_the_page_says_it_where_the_effect_is_described(stiffer):
    assert f"Cannot be excluded: {FAULT}" in render(stiffer)


@pytest.mark.parametrize("knows", [True, False])
def test_camber_may_be_a_wrong_channel_only_if_the_file_answers_to_camber(tire, record, knows):
    file = tire.replace(PHY3=0.05 if knows else 0.0, PVY3=0.5 if knows else 0.0)
    recording = record().assign(camber=0.03)
    said = catalogue()["camber"].same_to_data(prepare(file, recording).data, {})
    assert bool(said) == knows


@pytest.mark.parametrize("loads", [1, 3])
def test_a_gain_of_the_load_may_be_an_offset_of_it_only_at_one_load(tire, record, loads):
    recording = record()
    if loads == 1:
        recording = recording.assign(normal_load=float(recording["normal_load"].median()))
    said = catalogue()["load_gain"].same_to_data(prepare(tire, recording).data, {})
    assert bool(said) == (loads == 1)


def test_a_gain_of_the_force_may_be_a_tire_that_is_off_alike(tire, record):
    """Another tire with friction and stiffness off by one factor was "a fault of the recording" at 0.99."""
    recording = record(4)
    louder = recording.assign(fy=1.12 * recording["fy"])
    report = explain_mismatch(tire, louder, without=all_but("force_gain", "force_offset"))
    assert [e.name for e in report.effects] == ["force_gain"]
    assert report.verdict == "ambiguous"
    assert "or a tire with friction and slip stiffness off by the same factor" in report.summary
    assert "a fault of the recording or something that the model leaves out" in report.summary
    assert "Next, hang a known weight on the load cell" in report.summary


@pytest.mark.parametrize("reference", [40.0, 90.0])
def test_a_temperature_outside_of_the_recording_may_be_a_tire_that_is_off_throughout(tire, record, reference):
    """Another friction and stiffness at once were "tread temperature" at 0.88, its reference far outside."""
    recording = record()
    warm = recording.assign(tread_temperature=45.0 + 15.0 * np.sin(recording["time"] / 20.0))
    said = catalogue()["temperature"].same_to_data(prepare(tire, warm).data, {"reference": reference})
    assert bool(said) == (reference == 90.0)
