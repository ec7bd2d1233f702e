"""What goes with time, after the recording that was explained: one clock, and states that stay at its end."""

import numpy as np
import pytest
from weighed import all_but

from tire_pipeline.mismatch import CorrectedModel, Explainer, explain_mismatch
from tire_pipeline.mismatch.corrected.going_on import going_on
from tire_pipeline.mismatch.corrected.later_sweeps import confirmed_later
from tire_pipeline.mismatch.corrected.wheel_phase import way_at_each
from tire_pipeline.mismatch.inference.linearised_set import linearised
from tire_pipeline.mismatch.model.nominal import Reference
from tire_pipeline.mismatch.recording.prepare import prepare

WEAR = ("wear", {"friction": -0.2, "stiffness": 0.0})
HEAT = ("temperature", {"friction": -0.2, "reference": 0.0, "lag": 200.0})
DRIFT = ("sensor_drift", {"fy": 300.0})
RATE = 25


def explained_until(seconds, tire, run, changes, part=1.0):
    """The model with effects that were found in the first part of a run."""
    first = run[run["time"] < seconds]
    data = prepare(tire, first).data
    time, load = (first[name].to_numpy() for name in ("time", "normal_load"))
    rolled = way_at_each(time, load, data.time_line, data.wheel.way)
    known = Reference(data.states.scales, measured=frozenset(data.present))
    goes = going_on(data, changes, rolled, lambda own: part)
    return CorrectedModel(tire, changes, ("fy",), known, rolled=rolled, going_on=goes)


def test_no_tire_is_worn_further_than_it_was_seen(tire, record):
    """Wear went on to 0.6 of the friction, where 0.8 was the least that anyone had recorded."""
    run = record(0)
    rest = run[run["time"] > 75.0]
    least = (("friction_scale", {"friction": -0.2}),)
    forces = explained_until(75.0, tire, run, (WEAR,)).predict(rest)["fy"]
    np.testing.assert_allclose(forces, CorrectedModel(tire, least, ("fy",)).predict(rest)["fy"], atol=2.0)


def test_no_tire_is_warmed_further_than_it_was_seen(tire, record):
    run = record(0)
    forces = explained_until(75.0, tire, run, (HEAT,)).predict(run)["fy"]
    grip = (forces / explained_until(75.0, tire, run, ()).predict(run)["fy"])[run["slip_angle"] > 0.12]
    assert grip[run["time"] > 75.0].min() > grip[run["time"] < 75.0].min() - 0.01


@pytest.mark.parametrize("change", [WEAR, HEAT, DRIFT], ids=lambda change: change[0])
@pytest.mark.parametrize(("begin", "end"), [(75.0, 150.0), (40.0, 75.0)], ids=["after", "of it"])
def test_a_recording_by_itself_has_the_state_of_its_time(tire, record, change, begin, end):
    """The tire was new in it, while a drift was at its end: 474 N instead of 57 N on what followed."""
    run = record(0)
    model = explained_until(75.0, tire, run, (change,))
    shown = (run["time"] > begin) & (run["time"] < end)
    alone, within = model.predict(run[shown])["fy"], model.predict(run)["fy"][shown]
    np.testing.assert_allclose(alone, within, atol=2.0)


def test_after_a_pause_the_tire_counts_as_new(tire, record):
    """Nobody knows whether it was changed; a new tire is what changes less."""
    run = record(0)
    rest = run[run["time"] > 75.0]
    model = explained_until(75.0, tire, run, (WEAR,))
    later = rest.assign(time=rest["time"] + 60.0)
    new = CorrectedModel(tire, (WEAR,), ("fy",), model.reference)
    np.testing.assert_allclose(model.predict(later)["fy"], new.predict(rest)["fy"], atol=2.0)
    assert "begin anew" in model.predict(later).attrs["notes"][0]
    assert "begin anew" not in model.predict(rest).attrs["notes"][0]


def test_by_another_clock_nobody_knows_how_far_a_drift_is(tire, record):
    """Both clocks began at zero, and the drift of the one was put into the other: 220 N became 269 N."""
    run = record(0)
    other = run[run["time"] > 75.0].assign(time=lambda rest: rest["time"] - rest["time"].iloc[0])
    plain = explained_until(75.0, tire, run, ()).predict(other)["fy"]
    drifting = explained_until(75.0, tire, run, (DRIFT,)).predict(other)
    np.testing.assert_allclose(drifting["fy"], plain)
    assert "has a clock of its own" in drifting.attrs["notes"][0]
    worn, both = (explained_until(75.0, tire, run, c).predict(other)["fy"] for c in ((WEAR,), (WEAR, DRIFT)))
    np.testing.assert_allclose(both, worn)
    assert np.abs(worn - plain).max() > 300.0


def test_sweeps_that_were_held_out_of_a_recording_have_its_clock(tire, record):
    run = record(0)
    out = (run["time"] > 30.0) & (run["time"] < 45.0)
    model = explained_until(75.0, tire, run[~out], (DRIFT,))
    plain = model.as_it_came.predict(run[out])["fy"]
    assert (model.predict(run[out])["fy"] - plain).mean() == pytest.approx(150.0, abs=10.0)


def test_in_the_recording_that_was_explained_nothing_changes(tire, record):
    run = record(0)
    first = run[run["time"] < 75.0]
    model = explained_until(75.0, tire, run, (WEAR, DRIFT), part=0.4)
    before = explained_until(75.0, tire, run, ()).predict(first)
    assert "notes" not in model.predict(first).attrs
    whole = CorrectedModel(tire, (WEAR, DRIFT), ("fy",), model.reference).predict(first)
    np.testing.assert_allclose(model.predict(first)["fy"], whole["fy"], atol=1e-6)
    assert np.abs(whole["fy"] - before["fy"]).max() > 300.0


def test_after_it_as_much_is_added_as_later_sweeps_confirm(tire, record):
    run = record(0)
    gain = ("force_gain", {"fy": 0.1})
    rest = run[run["time"] > 75.0]
    of_time, lasting, whole = (
        explained_until(75.0, tire, run, changes, part).predict(rest)["fy"]
        for changes, part in [((gain, DRIFT), 0.4), ((gain,), 1.0), ((gain, DRIFT), 1.0)]
    )
    np.testing.assert_allclose(of_time - lasting, 0.4 * (whole - lasting), atol=1e-6)
    note = explained_until(75.0, tire, run, (gain, DRIFT), 0.4).predict(run).attrs["notes"]
    assert note == [
        "a drifting force or load channel: 50.0% of the samples are after the recording that was explained; "
        "nothing goes further there than it was at the end, and 40% of the change is added, as far as "
        "earlier sweeps predicted later ones"
    ]


def test_a_temperature_that_was_recorded_goes_with_no_time(tire, record):
    run = record(0).assign(tread_temperature=50.0)
    assert explained_until(75.0, tire, run, (HEAT,)).going_on is None


@pytest.fixture(scope="module")
def worn(tire, record):
    """A tire that loses friction with the work done, explained by this and by a drift."""
    work = prepare(tire, record(3)).data.states.work
    few = all_but("wear", "sensor_drift", "surface_change")
    return Explainer(without=few).weigh(tire, record(3, friction=1.0 - 0.2 * work))


def part_of(explained, changes, free):
    analysis, fit = explained.analysis, explained.analysis.fit
    put = linearised(analysis.system, changes, free, fit.covariance, fit.weight, fit.prior)
    return confirmed_later(analysis, put, range(len(changes)))


def test_later_sweeps_confirm_what_goes_on(worn):
    assert part_of(worn, worn.analysis.fit.changes, worn.analysis.fit.free) > 0.8


def test_later_sweeps_confirm_no_drift_that_is_not_there(worn):
    drift = ("sensor_drift", {"fy": 300.0, "fx": 0.0, "normal_load": 0.0, "lag": 0.0})
    assert part_of(worn, [drift], [("fy",)]) < 0.2


def test_a_step_in_the_last_fifth_is_confirmed_by_nothing_that_follows(worn):
    """It may be another surface: nothing says that it stays, or comes again."""
    step = ("surface_change", {"friction": -0.2, "moment": 142.0, "duration": 0.2})
    assert part_of(worn, [step], [("friction", "moment")]) < 0.1


def test_friction_that_falls_for_a_while_is_not_carried_on(tire, record):
    """Near the end of a recording, a cause that has no name is taken for a changed surface."""
    run = record(4)
    grip = np.where((run["time"] > 100.0) & (run["time"] < 120.0), 0.75, 1.0)
    shown = record(4, friction=grip)
    few = all_but("wear", "sensor_drift", "surface_change")
    report = explain_mismatch(tire, shown[shown["time"] < 116.0], without=few)
    rest = shown[shown["time"] > 120.0]
    assert {"surface_change", "wear"} & {name for effect in report.effects for name in effect.names}
    model, plain = report.corrected, report.corrected.as_it_came
    left, before = (np.std(rest["fy"] - each.predict(rest)["fy"]) for each in (model, plain))
    assert left < 1.05 * before
