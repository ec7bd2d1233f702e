import numpy as np
import pytest
from small_rig import out_of_round, with_pauses

from tire_pipeline.mismatch.discrepancy.form_error import shape_columns
from tire_pipeline.mismatch.discrepancy.nuisance.columns import make_nuisance
from tire_pipeline.mismatch.discrepancy.repeating import strongest_length
from tire_pipeline.mismatch.discrepancy.unnamed import forms, play
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.shared import harmonic_power
from tire_pipeline.mismatch.inference.analysis import analyse
from tire_pipeline.mismatch.proof.trial import put_in
from tire_pipeline.mismatch.recording.prepare import prepare


def test_play_follows_only_when_pushed():
    x = np.array([0.0, 0.5, 1.5, 3.0, 2.5, 1.5, 0.0])
    start = np.array([True, False, False, False, False, False, False])
    np.testing.assert_allclose(play(x, 1.0, start), [0.0, 0.0, 0.5, 2.0, 2.0, 2.0, 1.0])
    start[4] = True
    np.testing.assert_allclose(play(x, 1.0, start), [0.0, 0.0, 0.5, 2.0, 2.5, 2.5, 1.0])


def test_harmonic_power_is_the_plain_sum():
    rng = np.random.default_rng(0)
    signal, way = rng.normal(size=300), np.cumsum(rng.uniform(0.1, 0.3, 300))
    plain = [abs(np.sum(signal * np.exp(-1j * way * k))) for k in 2.0 + 0.05 * np.arange(40)]
    np.testing.assert_allclose(harmonic_power(signal, way, 2.0, 0.05, 40), plain, rtol=1e-9)


def test_misfit_breaks_the_mirror_only_a_little(tire, record):
    """At mirrored points the flexible form of Fy is opposite, but for the small part that is allowed."""
    recording = record(1)
    mirrored = recording.assign(slip_angle=-recording["slip_angle"], fy=-recording["fy"])
    here = make_nuisance(prepare(tire, recording).data).flexible["fy"]
    there = make_nuisance(prepare(tire, mirrored).data).flexible["fy"]
    covariance = np.sum(here * there, axis=1)
    own = np.sum(here * here, axis=1)
    strong = own > np.median(own)
    assert np.median(covariance[strong] / own[strong]) < -0.8


def test_sums_over_sweeps_add_up(tire, record):
    analysis = analyse(prepare(tire, record(2)).data)
    data, system = analysis.data, analysis.system
    rest = {o: data.recorded[o] - data.base[o] for o in data.outputs}
    columns = {o: np.column_stack([data.base[o], data.get("normal_load")]) for o in data.outputs}
    whole = system.sums(rest, columns)
    parts = system.by_sweep(rest, columns)
    np.testing.assert_allclose(parts.ne["fy"].sum(axis=0), whole.ne["fy"].sum(axis=0), rtol=1e-9)
    np.testing.assert_allclose(parts.ee, whole.ee)


def test_forms_without_a_name_need_a_time_line(tire, record):
    recording = record(3)
    assert len(list(forms(prepare(tire, recording).data, []))) > 10
    assert list(forms(prepare(tire, recording.iloc[::30].drop(columns="time")).data, [])) == []


def test_a_slip_that_is_noise_only_makes_no_huge_columns(tire, record):
    """The even grid has no range of such a slip; coefficients that need one are not fitted there."""
    braked = tire.replace(
        PCX1=1.6, PDX1=1.1, PEX1=0.1, PKX1=22.0, PKX3=0.2, PVX1=1e-3, PHX1=3e-7, RBX1=12.0, RBX2=9.0, RCX1=1.0
    )
    recording = record(4)
    noise = np.random.default_rng(4).normal(0.0, 3e-4, (2, len(recording)))
    recording = recording.assign(slip_ratio=noise[0], fx=22.0 * 4000.0 * noise[1])
    data = prepare(braked, recording).data
    assert not data.varies("slip_ratio")
    columns = make_nuisance(data).flexible["fx"]
    largest = max(np.abs(data.base[o]).max() for o in data.outputs)
    assert np.sqrt(np.mean(columns**2, axis=0)).max() < 10.0 * largest


def _seam(data, length):
    """Narrow pulses, one every so many metres."""
    return np.exp(-0.5 * (((data.distance / length) % 1.0 - 0.5) / 0.06) ** 2)


@pytest.mark.parametrize("length", [4.3, 6.7, 9.1])
def test_what_repeats_every_so_many_metres_is_found_with_its_length(tire, record, length):
    data = prepare(tire, record(5, rate=50.0)).data
    noise = np.random.default_rng(5).normal(0.0, 1.0, data.size)
    assert strongest_length(data, _seam(data, length) + 0.5 * noise) == pytest.approx(length, rel=1e-3)


def test_what_the_wheel_does_once_a_turn_does_not_repeat_at_twice_its_length(tire, record):
    data = prepare(tire, record(5, rate=50.0)).data
    noise = np.random.default_rng(5).normal(0.0, 1.0, data.size)
    turn = 2.0 * np.pi * 0.97 * data.radius
    found = strongest_length(data, 20.0 * np.cos(2.0 * np.pi * data.distance / turn) + noise)
    assert abs(found / (2.0 * turn) - 1.0) > 5e-3


def test_a_short_way_says_nothing_about_what_repeats(tire, record):
    data = prepare(tire, record(5, rate=50.0).iloc[:600]).data
    assert strongest_length(data, _seam(data, 6.7)) is None


def test_combined_slip_does_not_start_where_it_does_nothing(tire, record):
    """At a coefficient near zero the weighting does not answer to it, and a fit would stay there."""
    hardly = tire.replace(RBX1=20.0, RBX2=11.0, RBY1=10.0, RBY2=3e-4, RCY1=1.0)
    data = prepare(hardly, record(9)).data
    own, on_top = catalogue()["combined_slip"].starts(data)
    assert own == {"RBX1": 20.0, "RBX2": 11.0, "RBY1": 10.0, "RBY2": 10.0, "more_x": 0.0, "more_y": 0.0}
    assert min(on_top["more_x"], on_top["more_y"]) > 0.0


def test_a_state_without_its_channel_may_lag_otherwise(tire, record):
    """What another lag would do is within the form's error; with a channel there is no lag to get wrong."""
    recording = record(5)
    values = {"friction": -0.1, "curvature": 0.0, "stiffness": 0.0, "reference": 0.0, "lag": 20.0}
    data = prepare(tire, recording).data
    blind = shape_columns(data, [("temperature", values)], 0)["fy"]
    seen = prepare(tire, recording.assign(tread_temperature=50.0 + 20.0 * data.heat(20.0))).data
    known = shape_columns(seen, [("temperature", {**values, "reference": 50.0})], 0)["fy"]
    assert blind.shape[1] == known.shape[1] + 2
    assert np.ptp(blind[:, -1]) > 0.1 * np.ptp(blind[:, 4])


def test_a_quarter_turn_is_the_derivative_by_the_wheels_angle():
    effect = catalogue()["nonuniformity"]
    wave = {p.name: 0.0 for p in effect.parameters} | {"cosine_y": 3.0, "sine_y": 4.0, "radius": 0.3}
    later = effect.quarter_turn(wave)
    phi = np.linspace(0.0, 6.0, 50)
    there = 3.0 * np.cos(phi + np.pi / 2.0) + 4.0 * np.sin(phi + np.pi / 2.0)
    np.testing.assert_allclose(later["cosine_y"] * np.cos(phi) + later["sine_y"] * np.sin(phi), there)
    assert later["radius"] == 0.3


DRAWS = range(4)
"""What is named in such draws: ``rates``."""


@pytest.mark.parametrize("seed", DRAWS)
def test_a_wheel_turns_on_in_the_pauses_of_a_recording(tire, record, seed):
    """Phase holds over pauses: without that, pieces that begin at another angle of the wheel cancel out."""
    data = prepare(tire, with_pauses(out_of_round(tire, record(seed), force=150.0))).data
    assert data.rolling_radius() == pytest.approx(0.97 * data.radius, rel=1e-3)


@pytest.mark.parametrize("seed", DRAWS)
def test_a_load_that_varies_once_a_turn_shows_its_radius_in_sweeps_to_both_sides(tire, record, seed):
    """It changes a force of either sign the other way, so the force has hardly any power once a turn."""
    recording = record(seed)
    radius = 0.97 * prepare(tire, recording).data.radius
    wobbling = put_in(tire, recording, "nonuniformity", {"load_sine": 0.06, "radius": radius})
    found = prepare(tire, wobbling).data.rolling_radius(("slip_angle", "normal_load"))
    assert found == pytest.approx(radius, rel=1e-3)


@pytest.mark.parametrize("seed", DRAWS)
def test_what_shakes_is_noise_until_it_is_modelled(tire, record, seed):
    """The recording's noise is 25 N."""
    assert analyse(prepare(tire, out_of_round(tire, record(seed))).data).noise["fy"].floor > 50.0
