"""Forms of what has no name: play, and where forms need a time line."""

import numpy as np

from tire_pipeline.mismatch.discrepancy.unnamed import forms, play
from tire_pipeline.mismatch.recording.prepare import prepare


def test_play_follows_only_when_pushed():
    x = np.array([0.0, 0.5, 1.5, 3.0, 2.5, 1.5, 0.0])
    start = np.array([True, False, False, False, False, False, False])
    np.testing.assert_allclose(play(x, 1.0, start), [0.0, 0.0, 0.5, 2.0, 2.0, 2.0, 1.0])
    start[4] = True
    np.testing.assert_allclose(play(x, 1.0, start), [0.0, 0.0, 0.5, 2.0, 2.5, 2.5, 1.0])


def test_forms_without_a_name_need_a_time_line(tire, record):
    recording = record(3)
    assert len(list(forms(prepare(tire, recording).data, []))) > 10
    assert list(forms(prepare(tire, recording.iloc[::30].drop(columns="time")).data, [])) == []


def test_heat_is_without_a_name_only_beside_a_recorded_temperature(tire, record):
    recording = record(3)
    without = len(list(forms(prepare(tire, recording).data, [])))
    warm = recording.assign(tread_temperature=np.linspace(30.0, 60.0, len(recording)))
    assert len(list(forms(prepare(tire, warm).data, []))) == without + 2
