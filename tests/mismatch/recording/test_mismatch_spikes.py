"""Before any explanation: single samples that a disturbance put far off change nothing."""

from functools import cache

import numpy as np
import pandas as pd
import pytest
from weighed import all_but

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


FEW = frozenset(all_but("friction_scale", "stiffness_scale", "force_offset", "speed_dependence"))
"""What the misread samples were taken for, and what is there."""


@pytest.fixture(scope="module")
def report_of(tire, record):
    """What is said of the run of a friction; of each one once."""
    return cache(lambda friction, without: explain_mismatch(tire, record(friction=friction), without=without))


@pytest.mark.parametrize(
    ("friction", "verdict", "without"),
    [
        pytest.param(1.0, "agrees", FEW, id="agrees, rivals"),
        pytest.param(1.0, "agrees", frozenset(), id="agrees, catalogue", marks=pytest.mark.ci),
        pytest.param(0.85, "explained", frozenset(), id="explained, catalogue", marks=pytest.mark.ci),
    ],
)
def test_what_is_said_of_a_recording_is_said_of_it_with_spikes(
    tire, record, report_of, friction, verdict, without
):
    """One sample in a thousand made a recording unusable, or unexplained."""
    plain = report_of(friction, without)
    found = explain_mismatch(tire, spiked(record(friction=friction), **FAR_OFF), without=without)
    assert plain.verdict in (verdict, "ambiguous")
    assert [names for names, _ in found.sets] == [names for names, _ in plain.sets]
    assert found.verdict == plain.verdict
    assert found.fit["fy"].rms_before == pytest.approx(plain.fit["fy"].rms_before, rel=0.02)
    assert found.fit["fy"].rms_after == pytest.approx(plain.fit["fy"].rms_after, rel=0.05)


def test_the_report_says_which_values_were_left_out_and_the_users_table_stays(tire, record):
    run = spiked(record(), **FAR_OFF)
    before = run.copy()
    assumed = prepare(tire, run).assumed
    assert "fy: 100,000 in row 300 stands out from its neighbours (left out)" in assumed
    assert [text.split(":")[0] for text in assumed if "stand" in text] == ["slip_angle", "normal_load", "fy"]
    assert run.equals(before)
    assert run.attrs == before.attrs


def test_several_recordings_name_the_file_of_a_spike_and_a_held_out_one_is_judged_without(tire, record):
    first, second, third = (record(seed, friction=0.85) for seed in range(3))
    runs = {"a": spiked(first, fy={300: 1e5}), "b": second, "c": spiked(third, fy={200: -1e6})}
    report = explain_recordings(tire, runs, held_out="c")
    assert "a: fy: 100,000 in row 300 stands out from its neighbours (left out)" in report.notes
    clean = explain_recordings(tire, {"a": first, "b": second, "c": third}, held_out="c")
    assert report.held_out.errors["fy"].rms_after == pytest.approx(
        clean.held_out.errors["fy"].rms_after, rel=0.05
    )


def test_rows_without_time_are_dropped_where_a_value_stands_out(tire, record):
    run = record().drop(columns="time")
    kept = prepare(tire, spiked(run, fy={300: 1e5})).rows
    assert sorted(set(range(len(run))) - set(kept)) == [300]
    assert np.all(np.diff(kept) > 0)


def points(tire, seed=0, **change):
    """Steady points with the noise of a table: 25 slip angles at three loads."""
    slip, load = (x.ravel() for x in np.meshgrid(np.radians(np.arange(-12.0, 13.0)), [2e3, 4e3, 6e3]))
    force = tire.replace(**change).forces(slip_angle=slip, normal_load=load).fy
    noise = 30.0 * np.random.default_rng(seed).standard_normal(slip.size)
    table = pd.DataFrame({"slip_angle": slip, "normal_load": load, "fy": force + noise})
    return table.sample(frac=1.0, random_state=seed).reset_index(drop=True)


@pytest.fixture(scope="module", params=[1.0, 0.85])
def table_and_report(tire, request):
    """Steady points with some friction, and what is said of them."""
    table = points(tire, LMUY=request.param)
    return table, explain_mismatch(tire, table)


@pytest.mark.parametrize("wrong", [lambda f: -f, lambda f: 0.0, lambda f: 10.0 * f])
def test_one_wrong_point_of_a_table_changes_nothing_that_is_said(tire, table_and_report, wrong):
    """A turned sign of one point of TYDEX gave three causes with 1.0 each."""
    table, plain = table_and_report
    row = int(table["fy"].idxmax())
    report = explain_mismatch(tire, spiked(table, fy={row: wrong(table["fy"][row])}))
    assert report.verdict == plain.verdict
    assert [names for names, _ in report.sets] == [names for names, _ in plain.sets]
    assert report.fit["fy"].rms_before == pytest.approx(plain.fit["fy"].rms_before, rel=0.05)
    (said,) = [text for text in report.assumed if "unlike the points around it" in text]
    assert said.startswith("fy: ")
    assert f"in row {row} " in said


@pytest.mark.parametrize("change", [{}, {"LMUY": 0.7}, {"LKY": 0.7}, {"PVY1": 0.05}, {"PDY2": -0.3}])
@pytest.mark.parametrize("seed", range(3))
def test_no_point_is_left_out_for_what_a_tire_does(tire, change, seed):
    assert not prepare(tire, points(tire, seed, **change)).left_out


def test_a_wheel_that_stands_says_nothing(tire, record, report_of):
    """After a run the rig stands at some slip, without a force: that was a dependence on speed with 1.0."""
    run = record()
    at_rest = run.iloc[:200].assign(speed=0.01, slip_angle=0.08, fy=0.0)
    noise = np.random.default_rng(3)
    at_rest["speed"] += 0.02 * noise.standard_normal(200)
    at_rest["fy"] += 10.0 * noise.standard_normal(200)
    at_rest["slip_angle"] += 1e-4 * noise.standard_normal(200)
    step = float(np.median(np.diff(run["time"])))
    at_rest["time"] = run["time"].iloc[-1] + step * np.arange(1, 201)
    report = explain_mismatch(tire, pd.concat([run, at_rest], ignore_index=True), without=FEW)
    plain = report_of(1.0, FEW)
    assert (report.verdict, report.sets) == (plain.verdict, plain.sets)
    assert report.fit["fy"].rms_before == pytest.approx(plain.fit["fy"].rms_before)
    assert any("200 samples left out: the wheel stands" in note for note in report.notes)
