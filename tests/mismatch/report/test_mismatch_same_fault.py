"""What is the same to the data as a fault of the recording says so, wherever it is named."""

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
    assert effect.same_faults == (FAULT,)
    assert FAULT in stiffer.summary
    assert "which the model leaves out" not in stiffer.summary


def test_the_page_says_it_where_the_effect_is_described(stiffer):
    assert f"Cannot be excluded: {FAULT}" in render(stiffer)


@pytest.mark.parametrize("knows", [True, False])
def test_camber_may_be_a_wrong_channel_only_if_the_file_answers_to_camber(tire, record, knows):
    file = tire.replace(PHY3=0.05 if knows else 0.0, PVY3=0.5 if knows else 0.0)
    recording = record().assign(camber=0.03)
    said = catalogue()["camber"].same_fault(prepare(file, recording).data)
    assert bool(said) == knows


@pytest.mark.parametrize("loads", [1, 3])
def test_a_gain_of_the_load_may_be_an_offset_of_it_only_at_one_load(tire, record, loads):
    recording = record()
    if loads == 1:
        recording = recording.assign(normal_load=float(recording["normal_load"].median()))
    said = catalogue()["load_gain"].same_fault(prepare(tire, recording).data)
    assert bool(said) == (loads == 1)
