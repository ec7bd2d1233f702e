"""A real flat-belt recording: what is hidden from the model is named, nothing hidden gives no name."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
from mismatch_shared import shared
from weighed import all_but, named

from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.recording.prepare import prepare

sys.path.insert(0, str(Path(__file__).parents[3] / "benchmarks"))


@pytest.fixture(scope="module")
def bench():
    shared("recordings/calspan/cornering_part.mat")
    import flat_belt_hidden

    return flat_belt_hidden


TRUTH = {
    "nothing": set(),
    "pressure": {"inflation_pressure"},
    "camber": {"camber"},
    "camber and pressure": {"camber", "inflation_pressure"},
}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("hidden", "rate", "temperature"),
    [("camber and pressure", 50, False), pytest.param("camber", 20, True, marks=pytest.mark.long)],
)
def test_what_is_hidden_is_named_and_other_loads_come_out_better(bench, hidden, rate, temperature):
    row = bench.judge(hidden, rate, temperature)
    assert set(row.names) == TRUTH[hidden]
    assert row.after < row.before


@pytest.mark.slow
@pytest.mark.parametrize("rate", [*(pytest.param(rate, marks=pytest.mark.long) for rate in (100, 20)), 10])
def test_nothing_hidden_gives_no_name(bench, rate):
    row = bench.judge("nothing", rate, True)
    assert (row.verdict, row.names) == ("agrees", ())
    assert row.after == row.before


PUT_IN = {
    "nothing": (lambda run: run, set()),
    "offset": (lambda run: run.assign(fy=run["fy"] + 400.0), {"force_offset"}),
    "gain": (lambda run: run.assign(fy=1.2 * run["fy"]), {"force_gain"}),
}


@pytest.mark.slow
@pytest.mark.parametrize("rate", [*(pytest.param(rate, marks=pytest.mark.long) for rate in (100, 50)), 20])
@pytest.mark.parametrize("what", PUT_IN)
def test_rows_of_a_run_count_as_a_run_if_time_was_not_kept(bench, rate, what):
    table = bench.sweeps(rate)
    channels = [name for name in bench.CHANNELS if name != "time"]
    run = table[~table["low"] & ~table["leaning"]][channels].reset_index(drop=True)
    put_in, truth = PUT_IN[what]
    assert set(named(bench.model(rate), put_in(run))) == truth


@pytest.mark.long
def test_at_all_rates_names_are_true_ones_and_no_load_comes_out_worse(bench):
    rows = list(bench.rows([100, 50, 20, 10]))
    assert all(set(row.names) <= TRUTH[row.hidden] for row in rows)
    assert all(row.after <= row.before for row in rows)
    assert all(row.after < row.before for row in rows if "pressure" in row.hidden)
    hidden = [row for row in rows if row.hidden != "nothing"]
    assert np.mean([set(row.names) == TRUTH[row.hidden] for row in hidden]) >= 0.75


def test_without_effects_the_error_is_that_of_the_model_on_the_recorded_rows(bench):
    table = bench.sweeps(50)
    given = table[~table["low"] & ~table["leaning"]][bench.CHANNELS].reset_index(drop=True)
    tire = bench.model(50)
    report = explain_mismatch(tire, given, without=all_but("force_offset", "friction_scale"))
    assert report.effects == []
    plain = tire.forces(
        slip_angle=given["slip_angle"].to_numpy(),
        camber=given["camber"].to_numpy(),
        normal_load=given["normal_load"].to_numpy(),
        speed=given["speed"].to_numpy(),
        limits="ignore",
        outputs=("fy",),
    ).fy
    np.testing.assert_allclose(report.corrected.predict(given)["fy"], plain, rtol=1e-12)
    assert report.fit["fy"].rms_before == pytest.approx(bench.rms(given["fy"] - plain), rel=1e-12)
    assert report.fit["fy"].rms_after == report.fit["fy"].rms_before


def test_a_load_that_really_fluctuates_stays_as_it_is(bench):
    table = bench.sweeps(100)
    given = table[~table["low"] & ~table["leaning"]][bench.CHANNELS].reset_index(drop=True)
    (note,) = (note for note in prepare(bench.model(100), given).notes if note.startswith("normal_load"))
    assert "used as recorded" in note
