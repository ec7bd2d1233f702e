"""One meaning of "mismatch" at every rate; no repair and no cleaning makes unseen sweeps worse."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from real_at_rates import (
    RATES,
    at_rate,
    car_tire,
    check_unseen,
    drives,
    flat_belt,
    forces,
    free_drive,
    points,
    rms,
    second_session,
)

from tire_pipeline.mismatch.corrected.model import CorrectedModel
from tire_pipeline.mismatch.corrected.wheel_phase import way_at_each
from tire_pipeline.mismatch.recording.prepare import prepare

HIDDEN = ("nothing", "pressure", "camber", "camber pressure")
NOTHING_PUT_IN = (("force_gain", {"fy": 0.0, "fx": 0.0}),)


def sources(rate):
    """Real recordings that are explained, and sweeps that are not."""
    yield from (flat_belt(rate, hidden) for hidden in HIDDEN)
    yield from (second_session(rate, fitted) for fitted in (0, 1))
    yield free_drive(rate)


@cache
def prepared(rate):
    """All of these recordings as they are, prepared once: each with its tire and what was found in it."""
    return [(tire, given, prepare(tire, given)) for tire, given, _ in sources(rate)]


# No search: what is repaired and cleaned before


def _tier(rate, in_ci):
    """20 Hz in `make test`, some in CI, the others in `long`."""
    if rate == 20:
        return ()
    return pytest.mark.ci if rate in in_ci else pytest.mark.long


def _rates(*in_ci):
    return [pytest.param(rate, marks=_tier(rate, in_ci)) for rate in RATES]


FEW_RATES = _rates(2, 100, 500)
"""The lowest, the recordings' own and the highest in CI."""


@pytest.mark.parametrize("rate", FEW_RATES)
def test_real_channels_are_neither_stuck_nor_clipped_nor_turned(rate):
    """A drive's axes were the other ones."""
    for _, _, as_it_is in prepared(rate):
        assert [(f.name, f.channel) for f in as_it_is.findings] == []


@pytest.mark.parametrize("rate", _rates(500))
def test_real_channels_in_few_digits_are_neither_stuck_nor_clipped_nor_turned(rate):
    """At 500 Hz a speed in few digits was stuck for 645 samples."""
    for tire, given, _ in sources(rate):
        rounded = given.assign(**{n: _three_digits(given[n]) for n in given if n != "time"})
        assert [(f.name, f.channel) for f in prepare(tire, rounded).findings] == []


def _three_digits(x):
    scale = 10.0 ** (2 - np.floor(np.log10(np.maximum(np.abs(x), 1e-12))))
    return np.round(x * scale) / scale


@pytest.mark.parametrize("channel", ["fy", "slip_angle", "normal_load", "speed"])
@pytest.mark.parametrize("rate", [20, 100, pytest.param(500, marks=pytest.mark.ci)])
def test_a_real_channel_that_stuck_is_still_found(rate, channel):
    tire, given, _ = flat_belt(rate)
    rows = slice(int(0.4 * len(given)), int(0.5 * len(given)))
    held = given[channel].to_numpy().copy()
    held[rows] = held[rows.start]
    (found,) = prepare(tire, given.assign(**{channel: held})).findings
    assert (found.name, found.channel) == ("stuck_channel", channel)
    assert found.bad[rows].all()


WRONG = [
    ("fy", -1.0),
    ("fy", 1e-3),
    ("fy", 1.0 / 4.4482216),
    ("slip_angle", -1.0),
    ("slip_angle", 180.0 / np.pi),
    ("normal_load", -1.0),
]


@pytest.mark.parametrize(
    ("rate", "channel", "factor"),
    [pytest.param(rate, *wrong, marks=_tier(rate, (2,))) for rate in RATES for wrong in WRONG],
)
def test_a_repair_brings_sweeps_that_it_was_not_made_for_nearer(rate, channel, factor):
    """Or nothing is repaired: where friction changed by a half, pound-force and kilogram-force are alike."""
    for tire, given, unseen in sources(rate):
        wrong = unseen.assign(**{channel: factor * unseen[channel]})
        factors = prepare(tire, given.assign(**{channel: factor * given[channel]})).factors
        repaired = wrong.assign(**{n: wrong[n] * f for n, f in factors.items()})
        left = rms(wrong["fy"] - forces(tire, repaired) / factors.get("fy", 1.0))
        assert left <= rms(wrong["fy"] - forces(tire, wrong))


@pytest.mark.parametrize(("channel", "factor"), [w for w in WRONG if w[1] != -1.0])
@pytest.mark.parametrize("hidden", HIDDEN)
def test_the_unit_of_a_real_channel_is_found_whatever_is_hidden(hidden, channel, factor):
    tire, given, _ = flat_belt(20, hidden)
    factors = prepare(tire, given.assign(**{channel: factor * given[channel]})).factors
    assert factors == {channel: pytest.approx(1.0 / factor, rel=1e-6)}


def own(recording):
    """Which samples are of this recording, for a model that was corrected by it."""
    time, load = (recording[n].to_numpy(dtype=float) for n in ("time", "normal_load"))
    return way_at_each(time, load, time, np.arange(time.size, dtype=float))


@pytest.mark.parametrize("rate", [2, 5, 20, 100, pytest.param(500, marks=pytest.mark.ci)])
def test_noise_of_one_drive_is_not_taken_off_where_the_slip_really_moves(rate):
    """Cleaned like the second session, the free drive's slip was smoothed away: 0.2 N became 2 N at 5 Hz."""
    tire = car_tire(rate)
    session, free = (at_rate(drives(s)[0].frame, rate) for s in ("second", "free"))
    cleaned = {c.channel: c.removed for c in prepare(tire, session).cleaned if c.smoothed}
    assert "slip_angle" in cleaned
    model = CorrectedModel(tire, NOTHING_PUT_IN, ("fy",), cleaned=cleaned, rolled=own(session))
    assert rms(free["fy"] - model.predict(free)["fy"]) < 1.02 * rms(free["fy"] - forces(tire, free))
    if rate < 500:  # between the samples of a drive at 100 Hz there is no noise to take off
        assert np.any(model.predict(session)["fy"] != replace(model, cleaned={}).predict(session)["fy"])


@pytest.mark.parametrize("rate", FEW_RATES)
def test_cleaning_stays_only_where_it_leaves_less_of_the_recorded_force(rate):
    for tire, given, as_it_is in prepared(rate):
        cleaned = {c.channel: c.removed for c in as_it_is.cleaned if c.smoothed}
        model = CorrectedModel(tire, NOTHING_PUT_IN, ("fy",), cleaned=cleaned, rolled=own(given))
        kept = model.cleaned_where_it_helps(given)
        assert set(kept.cleaned) == (set(cleaned) if kept.cleaned else set())  # all or nothing
        left = rms(given["fy"] - kept.predict(given)["fy"])
        assert left <= rms(given["fy"] - replace(kept, cleaned={}).predict(given)["fy"])


# With the search: a fixed slice, all of it in `long`


@pytest.mark.parametrize("rate", [2, 5])
def test_a_real_recording_that_agrees_in_short(rate):
    assert check_unseen(*flat_belt(rate)).effects == []


@pytest.mark.long
@pytest.mark.parametrize("hidden", HIDDEN)
@pytest.mark.parametrize("rate", RATES)
def test_the_flat_belt_at_any_rate(rate, hidden):
    check_unseen(*flat_belt(rate, hidden))


@pytest.mark.long
@pytest.mark.parametrize("take", [lambda r: second_session(r, 0), lambda r: second_session(r, 1), free_drive])
@pytest.mark.parametrize("rate", RATES)
def test_drives_at_any_rate(rate, take):
    check_unseen(*take(rate))


@pytest.mark.long
def test_points_without_time():
    check_unseen(*points())
