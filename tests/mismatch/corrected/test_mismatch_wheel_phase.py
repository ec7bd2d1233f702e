"""What comes back once a turn is added where the angle of the wheel is known, and nowhere else."""

import numpy as np
import pytest
from weighed import all_but

from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch import CorrectedModel, explain_mismatch
from tire_pipeline.mismatch.corrected.going_on import going_on
from tire_pipeline.mismatch.corrected.wheel_phase import WheelWay, way_at_each
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.model.wheel import way_rolled
from tire_pipeline.mismatch.recording.prepare import prepare


def test_a_wave_is_added_in_the_recording_that_was_explained_and_left_out_of_another(tire, record):
    """There it would be added at any angle."""
    recording = record(0)
    data = prepare(tire, recording).data
    wave = {
        **catalogue()["nonuniformity"].zeros(data),
        "cosine_y": 200.0,
        "radius": 0.97 * data.nominal.radius,
    }
    rolled = WheelWay(data.time, recording["normal_load"].to_numpy(), data.wheel.way)
    corrected = CorrectedModel(tire, (("nonuniformity", wave),), ("fy",), rolled=rolled)
    other = recording.assign(time=recording["time"] + 1000.0)
    found, elsewhere = corrected.predict(recording), corrected.predict(other)
    added = found["fy"] - corrected.as_it_came.predict(recording)["fy"]
    np.testing.assert_allclose(added, 200.0 * np.cos(data.wheel.way / wave["radius"]), atol=1e-6)
    assert "notes" not in found.attrs
    np.testing.assert_allclose(elsewhere["fy"], corrected.as_it_came.predict(other)["fy"])
    assert "angle of the wheel" in elsewhere.attrs["notes"][0]
    with pytest.raises(RecordingError, match="nonuniformity needs the channel speed"):
        corrected.predict(recording.drop(columns="speed"))


@pytest.mark.parametrize("part", [1.0, 0.4])
def test_a_wave_goes_on_in_what_follows_at_once(tire, record, part):
    """The wheel rolls on; so much is added as earlier sweeps predicted of later ones."""
    run = record(0)
    first, rest = run[run["time"] < 75.0], run[run["time"] >= 75.0]
    data = prepare(tire, first).data
    radius = 0.97 * data.nominal.radius
    wave = {**catalogue()["nonuniformity"].zeros(data), "cosine_y": 200.0, "radius": radius}
    changes = (("nonuniformity", wave),)
    rolled = WheelWay(data.time, first["normal_load"].to_numpy(), data.wheel.way)
    goes = going_on(data, changes, rolled, lambda own: part)
    corrected = CorrectedModel(tire, changes, ("fy",), rolled=rolled, going_on=goes)
    predicted = corrected.predict(rest)
    added = (predicted["fy"] - corrected.as_it_came.predict(rest)["fy"]).to_numpy()
    way = way_rolled(run["speed"].to_numpy(), run["time"].to_numpy())[run["time"] >= 75.0]
    np.testing.assert_allclose(added, part * 200.0 * np.cos(way / radius), atol=10.0)
    assert f"{part:.0%} of the change is added" in predicted.attrs["notes"][0]
    assert "nothing goes further" not in predicted.attrs["notes"][0]


@pytest.mark.parametrize("rate", [25.0, 200.0])
def test_a_wave_is_added_at_each_sample_of_a_fast_recording(tire, record, rate):
    """Neighbours are averaged before they are weighed, and none of the recorded samples was its own."""
    recording = record(0, rate=rate)
    way = np.cumsum(recording["speed"].to_numpy()) / rate
    radius = 0.97 * tire.coefficients["UNLOADED_RADIUS"]
    recording["fy"] += 200.0 * np.cos(way / radius)
    report = explain_mismatch(tire, recording, without=all_but("nonuniformity", "friction_scale"))
    assert report.sets[0][0] == ("nonuniformity",)
    fit, predicted = report.fit["fy"], report.corrected.predict(recording)
    assert fit.rms_after < 0.5 * fit.rms_before
    assert np.std(recording["fy"] - predicted["fy"]) < 0.5 * fit.rms_before
    assert "notes" not in predicted.attrs


def test_samples_without_a_load_are_of_no_recording():
    stamps = np.arange(0.01, 1.0, 0.02)
    time, load = np.arange(0.0, 1.0, 0.01), np.full(100, 4000.0)
    load[3] = np.nan
    rolled = way_at_each(time, load, stamps, 20.0 * stamps)
    at = rolled.at(time, load)
    assert np.flatnonzero(np.isnan(at)).tolist() == [3]
    np.testing.assert_allclose(np.delete(at, 3), np.delete(20.0 * time, 3))


def test_a_recording_with_a_clock_of_its_own_follows_nothing():
    """It starts at zero, too, and is longer: what it has beyond the end of the other one follows nothing."""
    time, load, speed = np.arange(0.0, 20.0, 0.01), np.full(2000, 4000.0), np.full(2000, 20.0)
    rolled = WheelWay(time[:1000], load[:1000], 20.0 * time[:1000])
    np.testing.assert_allclose(rolled.at(time, load, speed), 20.0 * time)
    assert np.isnan(rolled.at(time, load + 1.0, speed)).all()
    beyond = np.isfinite(rolled.at(time[900:], load[900:], speed[900:]))
    assert beyond.all()


def test_no_part_is_said_to_be_added_where_the_wheel_is_left_out(tire, record):
    """After a gap the notes said both that the wave is left out and that a part of it is added."""
    run = record(0)
    first, rest = run[run["time"] < 75.0], run[run["time"] >= 75.0]
    data = prepare(tire, first).data
    wave = {**catalogue()["nonuniformity"].zeros(data), "cosine_y": 200.0, "radius": data.nominal.radius}
    changes = (("nonuniformity", wave),)
    rolled = WheelWay(data.time, first["normal_load"].to_numpy(), data.wheel.way)
    goes = going_on(data, changes, rolled, lambda own: 0.4)
    corrected = CorrectedModel(tire, changes, ("fy",), rolled=rolled, going_on=goes)
    (note,) = corrected.predict(rest.assign(time=rest["time"] + 10.0)).attrs["notes"]
    assert "left out at 100.0% of the samples" in note
