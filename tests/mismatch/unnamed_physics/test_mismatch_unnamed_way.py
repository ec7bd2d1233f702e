"""An equation in the way rolled, or in what was: in the recording, and in what follows it at once."""

from dataclasses import replace

import numpy as np
import pytest
from unnamed_problem import NOMINAL, by_speed, physics, problem, table

from tire_pipeline.mismatch import CorrectedModel
from tire_pipeline.mismatch.corrected.wheel_phase import way_at_each
from tire_pipeline.mismatch.model.wheel import way_rolled
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.mismatch.unnamed_physics.found import UnnamedPhysics, from_sidecar
from tire_pipeline.mismatch.unnamed_physics.language.grammar import EquationError
from tire_pipeline.mismatch.unnamed_physics.library import LAGS, WAYS, memory_factors
from tire_pipeline.mismatch.unnamed_physics.products import FOLDS, Columns
from tire_pipeline.mismatch.unnamed_physics.prove import judged
from tire_pipeline.mismatch.unnamed_physics.where_it_holds import part_that_later_sweeps_confirm

SIZE, RADIUS = 200.0, 0.85


def explained_until(seconds, tire, run, later=1.0):
    """The model with a wave of the drum that was found in the first part of a run."""
    first = run[run["time"] < seconds]
    data = prepare(tire, first).data
    rolled = way_at_each(
        *(first[n].to_numpy() for n in ("time", "normal_load")), data.time_line, data.wheel.way
    )
    span = (float(first["time"].min()), float(first["time"].max()))
    wave = UnnamedPhysics({"fy": f"{SIZE}*sin(way/{RADIUS})"}, ("path",), "force", {"t": span}, NOMINAL)
    return CorrectedModel(tire, (), ("fy",), unnamed=wave, unnamed_later=later, rolled=rolled)


def added(model, recording):
    return (model.predict(recording)["fy"] - model.as_it_came.predict(recording)["fy"]).to_numpy()


def true_wave(run):
    return SIZE * np.sin(way_rolled(run["speed"].to_numpy(), run["time"].to_numpy()) / RADIUS)


def test_a_part_of_the_recording_has_the_angle_that_it_had(tire, record):
    """The way began anew with it: 278 N of error became 367 N where 59 N were reported."""
    run = record(0)
    model = explained_until(75.0, tire, run)
    shown = (run["time"] > 40.0) & (run["time"] < 75.0)
    np.testing.assert_allclose(added(model, run[shown]), true_wave(run)[shown], atol=1e-6)


@pytest.mark.parametrize("later", [1.0, 0.4])
def test_what_follows_at_once_has_the_part_that_later_sweeps_confirm(tire, record, later):
    run = record(0)
    model = explained_until(75.0, tire, run, later)
    rest = run[run["time"] >= 75.0]
    wave = true_wave(run)[run["time"] >= 75.0]
    np.testing.assert_allclose(added(model, rest), later * wave, atol=0.02 * SIZE)
    assert f"{later:.0%} of it is added there" in model.predict(rest).attrs["notes"][0]


@pytest.mark.parametrize("change", ["a pause", "later"])
def test_nothing_is_added_where_nobody_knows_the_angle(tire, record, change):
    run = record(0)
    model = explained_until(75.0, tire, run)
    rest = run[run["time"] >= 75.0]
    paused = rest["time"] + np.where(rest["time"] > 100.0, 10.0, 0.0)
    other = rest.assign(time=paused) if change == "a pause" else rest.assign(time=rest["time"] + 10.0)
    unknown = (other["time"] > 100.0) if change == "a pause" else np.ones(len(rest), bool)
    wave = added(model, other)
    assert not wave[unknown].any()
    assert wave[~np.asarray(unknown)].any() == (change == "a pause")
    assert "left out at" in model.predict(other).attrs["notes"][0]


def test_a_way_that_is_a_little_wrong_is_confirmed_by_no_later_sweep():
    """Its angle slips away: in phase where it was fitted, and out of phase a minute later."""
    rng = np.random.default_rng(0)
    time = np.arange(6000) * 0.01
    block = (time // 2.0).astype(int)
    true = 100.0 * np.sin(20.0 * time)
    rest = {"fy": true + rng.normal(0.0, 10.0, time.size)}
    parts = [
        part_that_later_sweeps_confirm([{"fy": np.sin(rate * time)}], rest, {"fy": 4000.0}, block)
        for rate in (20.0, 20.05)
    ]
    assert parts[0] > 0.95
    assert parts[1] < 0.1


def test_a_force_that_shares_all_coefficients_is_tested_once():
    """A run brakes in a few sweeps only: their gain is one chance in a hundred, not in a thousand."""
    seen = problem(by_speed, noise=5.0)
    sweeps = int(seen.block.max()) + 1
    braked = np.isin(seen.block, np.linspace(0, sweeps - 1, 7).astype(int))
    wave = np.where(braked, 100.0, 0.0)
    seen = replace(seen, rest={**seen.rest, "fx": seen.rest["fx"] + wave})
    predicted = {"fx": wave, "fy": by_speed(seen.table)}
    assert judged(Columns(seen), predicted, FOLDS).outputs == ("fy",)
    assert judged(Columns(seen), predicted, FOLDS, of_all=True).outputs == ("fx", "fy")


def test_an_earlier_format_is_read_unless_it_has_the_way_that_was_summed_up_otherwise():
    for text, readable in (("0.1*fy*v", True), ("0.1*fy*sin(way/0.85)", False)):
        entry = {**physics(text).to_sidecar(), "format": "unnamed physics 3"}
        if readable:
            assert from_sidecar(entry).equations == {"fy": text}
        else:
            with pytest.raises(EquationError, match="its way rolled is that of an earlier format"):
                from_sidecar(entry)


def test_the_way_goes_on_in_a_pause():
    columns, channels, time = table()
    np.testing.assert_allclose(columns.columns["way"], way_rolled(channels["speed"], time))
    assert np.diff(columns.columns["way"]).max() > 50.0


def test_no_lag_is_longer_than_those_that_are_looked_for():
    """84 s in a recording of 40 s was the clock under another name: 157 N became 305 N in what followed."""
    lags = [f for f in memory_factors(frozenset({"slip_angle", "time", "way"})) if "lag" in f.text]
    for factor in lags:
        most = (WAYS if "lagway" in factor.text else LAGS)[-1]
        assert factor.at(3.0 * most).value == most
        assert factor.at(0.5 * most).value == 0.5 * most
