"""Before any explanation: single samples that a disturbance put far off change nothing."""

import numpy as np
import pytest

from tire_pipeline.mismatch import explain_mismatch, explain_recordings
from tire_pipeline.mismatch.recording.prepare import prepare


def spiked(run, **rows):
    """The same with values far off: channel = {row: value}."""
    out = run.copy()
    for channel, values in rows.items():
        out.loc[list(values), channel] = list(values.values())
    return out


FAR_OFF = {
    "fy": {300: 1e5},
    "normal_load": {400: -4e4, 401: -4e4},
    "slip_angle": {700: 3.1},
}


@pytest.mark.parametrize(("friction", "verdict"), [(1.0, "agrees"), (0.85, "explained")])
def test_what_is_said_of_a_recording_is_said_of_it_with_spikes(tire, record, friction, verdict):
    """One sample in a thousand made a recording unusable, or unexplained."""
    run = record(friction=friction)
    plain, found = explain_mismatch(tire, run), explain_mismatch(tire, spiked(run, **FAR_OFF))
    assert plain.verdict in (verdict, "ambiguous")
    assert [names for names, _ in found.sets] == [names for names, _ in plain.sets]
    assert found.verdict == plain.verdict
    assert found.fit["fy"].rms_before == pytest.approx(plain.fit["fy"].rms_before, rel=0.02)
    assert found.fit["fy"].rms_after == pytest.approx(plain.fit["fy"].rms_after, rel=0.05)


def test_the_report_says_which_values_were_left_out_and_the_users_table_stays(tire, record):
    run = spiked(record(), **FAR_OFF)
    before = run.copy()
    assumed = prepare(tire, run).assumed
    assert "fy: the value 1e+05 in row 300 stands out from its neighbours; left out" in assumed
    assert [text.split(":")[0] for text in assumed if "stand" in text] == ["slip_angle", "normal_load", "fy"]
    assert run.equals(before)
    assert run.attrs == before.attrs


def test_several_recordings_name_the_file_of_a_spike_and_a_held_out_one_is_judged_without(tire, record):
    first, second, third = (record(seed, friction=0.85) for seed in range(3))
    runs = {"a": spiked(first, fy={300: 1e5}), "b": second, "c": spiked(third, fy={200: -1e6})}
    report = explain_recordings(tire, runs, held_out="c")
    assert "a: fy: the value 1e+05 in row 300 stands out from its neighbours; left out" in report.notes
    clean = explain_recordings(tire, {"a": first, "b": second, "c": third}, held_out="c")
    assert report.held_out.errors["fy"].rms_after == pytest.approx(
        clean.held_out.errors["fy"].rms_after, rel=0.05
    )


def test_rows_without_time_are_dropped_where_a_value_stands_out(tire, record):
    run = record().drop(columns="time")
    kept = prepare(tire, spiked(run, fy={300: 1e5})).rows
    assert sorted(set(range(len(run))) - set(kept)) == [300]
    assert np.all(np.diff(kept) > 0)
