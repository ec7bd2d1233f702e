"""Faults as users have them: a clear message or the artefact's name, never a physics name."""

import numpy as np
import pytest

from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.recording.prepare import prepare


@pytest.mark.parametrize("value", [0.0, 100.0])
def test_a_dead_force_channel_is_said(tire, record, value):
    with pytest.raises(RecordingError, match="no force was measured"):
        explain_mismatch(tire, record().assign(fy=value))


def test_a_dead_second_force_is_left_out(tire, record):
    prepared = prepare(tire, record().assign(fx=0.0))
    assert prepared.data.outputs == ("fy",)
    assert any("fx is 0 N throughout" in n for n in prepared.notes)


def test_an_empty_recording_is_said_to_be_empty(tire, record):
    with pytest.raises(RecordingError, match="no rows"):
        explain_mismatch(tire, record().iloc[:0])


def test_single_missing_samples_are_bridged_and_no_dynamics(tire, record):
    """A third of the loads are missing: what was left had an uneven time base and looked like relaxation."""
    r = record(21)
    r.loc[::3, "normal_load"] = np.nan
    report = explain_mismatch(tire, r)
    assert report.effects == []
    assert any("straight lines" in n for n in report.notes)


def test_long_steps_ask_for_the_unit_of_time(tire, record):
    r = record()
    report = explain_mismatch(tire, r.assign(time=1000.0 * r["time"]))
    assert any("unit of time" in n for n in report.notes)
    assert [e for e in report.effects if e.kind == "physics"] == []


def test_a_plateau_at_the_end_of_the_range_is_clipped_and_not_stuck(tire, record):
    r = record()
    # Slow sweeps stay at the limit for long: each plateau is over a twentieth of the recording.
    slow = r[r["time"] < 80.0].assign(slip_angle=lambda r: 0.15 * np.sin(2.0 * np.pi * r["time"] / 40.0))
    fy = tire.forces(slip_angle=slow["slip_angle"].to_numpy(), normal_load=slow["normal_load"].to_numpy()).fy
    fy = fy + np.random.default_rng(0).normal(0.0, 25.0, fy.size)
    report = explain_mismatch(tire, slow.assign(fy=np.clip(fy, -1200.0, 1200.0)))
    assert [e.name for e in report.effects] == ["clipping"]
