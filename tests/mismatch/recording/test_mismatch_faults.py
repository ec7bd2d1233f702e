"""Faults as users have them: a clear message or the artefact's name, never a physics name."""

import numpy as np
import pandas as pd
import pytest
from small_rig import at_its_limit

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


def test_single_missing_samples_are_bridged(tire, record):
    """A third of the loads are missing: what was left had an uneven time base and looked like relaxation."""
    recording = record(21)
    recording.loc[::3, "normal_load"] = np.nan
    prepared = prepare(tire, recording)
    assert any("straight lines" in note for note in prepared.notes)
    np.testing.assert_allclose(np.diff(prepared.data.time), 0.04)


def test_long_steps_ask_for_the_unit_of_time(tire, record):
    recording = record()
    notes = prepare(tire, recording.assign(time=1000.0 * recording["time"])).notes
    assert any("unit of time" in note for note in notes)


@pytest.mark.parametrize("seed", range(3))
def test_a_plateau_at_the_end_of_the_range_is_clipped_and_not_stuck(tire, record, seed):
    """Slow sweeps stay at the limit for long: each plateau is over a twentieth of the recording."""
    findings = prepare(tire, at_its_limit(tire, record(seed), seed)).findings
    assert [each.name for each in findings] == ["clipping"]


def _on_a_faster_clock(recording, rate):
    """Return a recording with its channels brought to ``rate`` samples per second by straight lines."""
    time = np.arange(recording["time"].iloc[0], recording["time"].iloc[-1], 1.0 / rate)
    return pd.DataFrame({n: np.interp(time, recording["time"], x) for n, x in recording.items()})


def test_a_slow_channel_in_few_digits_on_a_faster_clock_is_not_stuck(tire, record):
    """Three equal samples of 25 in a second are 240 of 1000: a logger drew straight lines between them."""
    slow = record()
    coarse = slow.assign(normal_load=(slow["normal_load"] / 5.0).round() * 5.0)
    coarse.loc[1000:1005, "normal_load"] = coarse.loc[1000, "normal_load"]
    assert prepare(tire, _on_a_faster_clock(coarse, 1000.0)).findings == []


def test_a_simulated_load_that_rests_on_a_straight_is_not_stuck(tire):
    """It was stuck with 0.98: between two corners it is exactly the same. The corners begin from rest."""
    t = 0.02 * np.arange(3000)
    slip = 0.06 * np.exp(-(((t - 15.0) / 2.0) ** 2)) - 0.05 * np.exp(-(((t - 45.0) / 1.5) ** 2))
    load = 4000.0 * (1.0 + 2.5 * slip)
    fy = tire.forces(slip_angle=slip, normal_load=load).fy
    fy = fy + 25.0 * np.random.default_rng(0).standard_normal(t.size)
    recording = pd.DataFrame({"time": t, "slip_angle": slip, "normal_load": load, "fy": fy})
    assert (load == load[1500]).sum() > 100
    assert prepare(tire, recording).findings == []


def test_a_channel_is_stuck_on_a_faster_clock_too(tire, record):
    slow = record()
    slow.loc[1000:1100, "normal_load"] = slow.loc[1000, "normal_load"]
    found = prepare(tire, _on_a_faster_clock(slow, 1000.0)).findings
    assert [(each.name, each.channel) for each in found] == [("stuck_channel", "normal_load")]
