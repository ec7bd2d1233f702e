import dataclasses

import numpy as np
import pytest
from weighed import all_but

from tire_pipeline.mismatch import CorrectedModel, Explainer
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.amounts import amount_with_interval
from tire_pipeline.mismatch.effects.shared import harmonic_power, own_relaxation
from tire_pipeline.mismatch.model.candidates import derivatives
from tire_pipeline.mismatch.model.forces import simulate
from tire_pipeline.mismatch.model.nominal import Reference
from tire_pipeline.mismatch.recording.prepare import prepare

PHYSICS = (
    "friction_scale stiffness_scale load_sensitivity camber combined_slip inflation_pressure temperature "
    "speed_dependence relaxation_length wear plysteer_conicity turn_slip "
    "nonuniformity compliance surface_change rolling_resistance axle_load_transfer"
).split()
ARTEFACTS = (
    "force_offset force_gain load_gain load_offset pressure_offset slip_angle_offset slip_ratio_offset "
    "camber_offset time_delay low_pass crosstalk sensor_drift sign_convention unit_error clipping "
    "stuck_channel"
).split()


def test_the_catalogue_has_the_names_of_the_issue():
    kinds = {n: e.kind for n, e in catalogue().items()}
    assert kinds == {**dict.fromkeys(PHYSICS, "physics"), **dict.fromkeys(ARTEFACTS, "artefact")}


@pytest.mark.parametrize("name", sorted(PHYSICS + ARTEFACTS))
def test_every_effect_says_what_it_is(name):
    effect = catalogue()[name]
    assert effect.equation
    assert effect.source
    assert effect.title
    assert effect.experiment
    assert all(other in catalogue() for other in effect.looks_like)
    assert all(p.low < p.high and p.step > 0.0 for p in effect.parameters)


@pytest.mark.parametrize("name", sorted(PHYSICS + ARTEFACTS))
def test_every_effect_says_what_it_covers_and_what_not(name):
    said = " ".join(type(catalogue()[name]).__doc__.split())
    assert "Covers" in said
    assert "Not covered" in said


FITTED = [n for n in PHYSICS + ARTEFACTS if catalogue()[n].parameters and n != "pressure_offset"]
"""All but those that are found in a channel itself, and one that needs a file which answers to pressure."""


@pytest.fixture(scope="module")
def every_channel(tire, record):
    """A recording with every channel that an effect asks for, of a tire that answers to all of them."""
    model = tire.replace(
        PCX1=1.6, PDX1=1.1, PEX1=0.1, PKX1=22.0, PKX3=0.2, PHY3=0.03, PVY3=0.3,
        RBX1=12.0, RBX2=9.0, RCX1=1.0, RBY1=12.0, RBY2=9.0, RCY1=1.0,
    )  # fmt: skip
    recording = record(rate=50.0)
    t = recording["time"].to_numpy()
    inputs = {n: recording[n].to_numpy() for n in ("slip_angle", "normal_load")}
    inputs |= {"slip_ratio": 0.06 * np.sin(1.1 * t), "camber": 0.05 * np.sin(0.4 * t)}
    forces = model.forces(**inputs)
    slow = {"turn_slip": 0.01 * np.sin(0.7 * t), "speed": 16.7 + 3.0 * np.sin(t / 9.0)}
    slow["tread_temperature"] = 50.0 + 10.0 * np.sin(t / 20.0)
    slow["load_transfer"] = 600.0 * np.sin(0.7 * t) ** 2
    return prepare(model, recording.assign(**inputs, **slow, fx=forces.fx, fy=forces.fy)).data


@pytest.mark.parametrize("name", FITTED)
def test_an_effect_at_zero_changes_nothing(name, every_channel):
    effect = catalogue()[name]
    assert effect.absent(every_channel) is None
    changed = simulate(every_channel, [(name, effect.zeros(every_channel))])
    for output, base in every_channel.simulation.base.items():
        np.testing.assert_allclose(changed[output], base, rtol=0, atol=1e-6)


LAGS = {"lag", "delay", "length", "moment", "radius"}
"""Where samples lie far apart, these move the force by steps."""


def check_derivatives(data, name):
    """Hold the derivatives of an effect's first start, by all that floats but lags, against small steps."""
    effect = catalogue()[name]
    start = effect.starts(data)[0]
    free = [p for p in effect.parameters if p.name in effect.free(data, start) and p.name not in LAGS]
    assert free
    for p in free:
        middle, width = effect.usual(data, p.name)
        if np.isnan(middle):  # every value is as likely: it stays where the fit starts
            continue
        start[p.name] = float(np.clip(middle + 0.5 * min(width, 0.1 * (p.high - p.low)), p.low, p.high))
    for named, columns in derivatives(data, [(name, start)], 0, [p.name for p in free]):
        h = 1e-3 * effect.parameter(named).step
        up, down = (simulate(data, [(name, {**start, named: start[named] + d})]) for d in (h, -h))
        for o, column in columns.items():
            exact = (up[o] - down[o]) / (2.0 * h)
            assert np.std(column - exact) <= 0.05 * np.std(exact) + 1e-9, named


ONLY_LAGS = {"time_delay", "low_pass"}


@pytest.mark.parametrize("name", [name for name in FITTED if name not in ONLY_LAGS])
def test_a_derivative_is_that_of_a_small_step(name, every_channel):
    check_derivatives(every_channel, name)


@pytest.mark.parametrize("name", ["temperature", "crosstalk", "load_sensitivity", "friction_scale"])
def test_a_derivative_is_that_of_a_small_step_without_the_other_channels(name, tire, record):
    """That by the reference of a temperature without a channel was 11% off: fits ended off their optimum."""
    check_derivatives(prepare(tire, record(rate=50.0)).data, name)


def test_friction_keeps_the_slope_and_moves_the_peak(tire, record):
    data = prepare(tire, record()).data
    fy = simulate(data, [("friction_scale", {"friction": 0.2})])["fy"]
    ratio = fy / np.where(np.abs(data.simulation.base["fy"]) < 1.0, np.nan, data.simulation.base["fy"])
    small, large = np.abs(data.get("slip_angle")) < 0.004, np.abs(data.get("slip_angle")) > 0.15
    assert np.nanmedian(ratio[small]) == pytest.approx(1.0, abs=0.02)
    assert np.nanmedian(ratio[large]) == pytest.approx(1.2, abs=0.03)


def test_friction_leaves_the_thrust_of_a_leaning_wheel(tire, record):
    """Tread elements that stick bear it. With a scaled thrust, friction was "compliance" and "force_gain"."""
    leaning = tire.replace(PHY1=0.004, PHY3=0.15, PVY3=-0.2)
    recording = record().assign(camber=0.05)
    recording["slip_angle"] = np.linspace(-0.2, 0.2, len(recording))
    data = prepare(leaning, recording).data
    zero = catalogue()["friction_scale"].zeros(data)
    base, slippery = (
        simulate(data, [("friction_scale", {**zero, "friction": x})] if x else [])["fy"] for x in (0.0, -0.3)
    )
    straight = int(np.argmin(np.abs(recording["slip_angle"].to_numpy())))
    assert abs(base[straight]) > 300.0
    assert slippery[straight] == pytest.approx(base[straight], rel=0.05)
    assert slippery[[0, -1]] == pytest.approx(0.7 * base[[0, -1]], rel=0.05)
    zero = catalogue()["stiffness_scale"].zeros(data)
    stiff = simulate(data, [("stiffness_scale", {**zero, "stiffness": 0.2})])["fy"]
    assert stiff[straight] == pytest.approx(1.2 * base[straight], rel=0.05)
    assert np.argmin(np.abs(stiff)) == pytest.approx(np.argmin(np.abs(base)), abs=2)


def test_a_file_that_is_right_at_another_load_needs_no_other_friction_level(tire, record):
    """A second name, friction, came up beside the load wherever a file was not right at its nominal load."""
    few = all_but("load_sensitivity", "friction_scale", "stiffness_scale", "load_gain", "load_offset")
    recording = record()
    data = prepare(tire, recording).data
    truth = {"rate": -0.3, "stiffness": 0.0, "lateral_stiffness": 0.0, "right_at": 1.6, "power": 0.0}
    forces, base = simulate(data, [("load_sensitivity", truth)]), data.simulation.base
    recording = recording.assign(fy=recording["fy"] + forces["fy"] - base["fy"])
    answer = Explainer(without=few).weigh(tire, recording).answer
    assert answer.names == ("load_sensitivity",)
    found = dict(answer.named.changes)["load_sensitivity"]
    assert found["rate"] == pytest.approx(truth["rate"], abs=0.05)
    assert found["right_at"] == pytest.approx(truth["right_at"], abs=0.2)


@pytest.mark.parametrize("power", [0.0, 1.0])
def test_a_model_is_as_it_came_at_the_load_at_which_it_is_right(power, tire, record):
    data = prepare(tire, record()).data
    load = data.get("normal_load")
    right_at = load[load.size // 2] / data.nominal.load
    there = np.isclose(load, right_at * data.nominal.load, rtol=1e-3)
    changed = simulate(
        data,
        [
            (
                "load_sensitivity",
                {
                    "rate": -0.3,
                    "right_at": right_at,
                    "power": power,
                    "stiffness": 0.1,
                    "lateral_stiffness": 0.0,
                },
            )
        ],
    )["fy"]
    off = np.abs(changed - data.simulation.base["fy"]) / np.abs(changed).max()
    assert there.any()
    assert off[there].max() < 1e-3
    assert off[~there].max() > 1e-2


def test_a_delay_moves_the_force_by_its_time(tire, record):
    data = prepare(tire, record()).data
    late = simulate(data, [("time_delay", {"delay": 0.2})])["fy"]
    np.testing.assert_allclose(late[20:200], data.simulation.base["fy"][15:195], atol=1e-6)


def test_compliance_is_solved_where_the_force_turns_the_wheel_as_much_as_it_was_set(tire, record):
    data = prepare(tire, record()).data
    about_one_over_the_stiffness = 1.2e-5
    for steer, offset in ((2e-6, 0.0), (about_one_over_the_stiffness, 0.0), (8e-6, 0.03), (-4e-6, 0.03)):
        angle = data.get("slip_angle") + offset
        turned = data.simulation.turned_by_force(angle, steer)
        force = tire.forces(slip_angle=turned, normal_load=data.get("normal_load")).fy
        np.testing.assert_allclose(turned, angle - steer * force, atol=2e-4)


def test_a_brake_force_turns_a_compliant_wheel(tire, record):
    braked = tire.replace(PCX1=1.6, PDX1=1.1, PEX1=0.1, PKX1=22.0, RBX1=12.0, RCX1=1.0, RBY1=12.0, RCY1=1.0)
    recording = record()
    slip = 0.05 * np.sin(recording["time"].to_numpy())
    at = {n: recording[n].to_numpy() for n in ("slip_angle", "normal_load")}
    forces = braked.forces(slip_ratio=slip, **at)
    data = prepare(braked, recording.assign(slip_ratio=slip, fx=forces.fx, fy=forces.fy)).data
    pull = (
        simulate(data, [("compliance", {"steer": 0.0, "steer_by_fx": 1e-6 * data.nominal.load})])["fy"]
        - data.simulation.base["fy"]
    )
    slope = braked.forces(
        slip_angle=data.get("slip_angle") - 1e-6 * data.simulation.both_forces["fx"],
        slip_ratio=data.get("slip_ratio"),
        normal_load=data.get("normal_load"),
    ).fy
    np.testing.assert_allclose(pull, slope - data.simulation.base["fy"], atol=0.02 * np.abs(pull).max())
    assert np.abs(pull).max() > 100.0


def _conicity(data, **parameters):
    """What conicity adds to the side force, N."""
    values = {**catalogue()["plysteer_conicity"].zeros(data), **parameters}
    return simulate(data, [("plysteer_conicity", values)])["fy"] - data.simulation.base["fy"]


def test_a_thrust_is_a_side_force_that_fades_where_the_tire_slides(tire, record):
    data = prepare(tire, record()).data
    angle, load = np.abs(data.get("slip_angle")), data.get("normal_load")
    added = _conicity(data, thrust=0.01)
    straight, sliding = angle < np.quantile(angle, 0.03), angle > np.quantile(angle, 0.97)
    np.testing.assert_allclose(added[straight], 0.01 * load[straight], rtol=0.1)
    assert np.abs(added[sliding]).max() < 0.3 * np.abs(added[straight]).min()


@pytest.mark.parametrize("radii", [0.05, 7.0])
def test_no_tire_has_a_relaxation_length_beyond_what_its_size_allows(tire, record, radii):
    data = prepare(tire, record()).data
    effect = catalogue()["relaxation_length"]
    assert effect.outside(data, {**effect.zeros(data), "length": radii * data.nominal.radius})
    assert not effect.outside(data, {**effect.zeros(data), "length": 1.2 * data.nominal.radius})


SCALED = {"LSGAL": 1.3, "LSGKP": 0.8, "LFZO": 0.9}


def test_the_file_with_a_relaxation_put_in_gives_its_length_by_the_engines_formula(tire):
    """Scale factors of relaxation were left out: the file's lengths were not those that were found."""
    scaled = tire.replace(**SCALED, PTX2=0.4, PTX3=0.2)
    found = {"length": 0.45, "load": 0.0, "along": 0.6, "fades": 0.0}
    written = scaled.replace(**catalogue()["relaxation_length"].coefficients(scaled, found))
    at_nominal = written.forces(normal_load=tire.coefficients["FNOMIN"], limits="ignore")
    assert float(at_nominal.relaxation_lateral) == pytest.approx(0.45, rel=1e-12)
    assert float(at_nominal.relaxation_longitudinal) == pytest.approx(0.27, rel=1e-12)


def test_a_file_that_scales_its_relaxation_to_nothing_keeps_a_found_one_in_the_sidecar(tire):
    found = {"length": 0.45, "load": 0.0, "along": 0.6, "fades": 0.0}
    assert catalogue()["relaxation_length"].coefficients(tire.replace(LSGAL=0.0), found) == {}


def test_the_relaxation_that_a_file_states_is_the_engines(tire):
    stated = tire.replace(**SCALED, PTY1=1.5, PTY2=1.7, PTX1=1.2)
    at_nominal = stated.forces(normal_load=tire.coefficients["FNOMIN"], limits="ignore")
    assert own_relaxation(stated) == {
        "slip_angle": float(at_nominal.relaxation_lateral),
        "slip_ratio": float(at_nominal.relaxation_longitudinal),
    }
    assert own_relaxation(tire.replace(PTY1=0.0, PTX1=0.0)) is None


def test_a_drift_that_settles_is_all_there_at_the_end(tire, record):
    data = prepare(tire, record()).data
    added = simulate(data, [("sensor_drift", {"fy": 100.0, "lag": 20.0})])["fy"] - data.simulation.base["fy"]
    at = np.searchsorted(data.time, [20.0, 40.0])
    whole = 1.0 - np.exp(-(data.time[-1] - data.time[0]) / 20.0)
    np.testing.assert_allclose(added[at], 100.0 * (1.0 - np.exp([-1.0, -2.0])) / whole, atol=0.3)
    assert added[-1] == pytest.approx(100.0)


def test_a_drift_goes_nowhere_outside_of_the_time_that_was_recorded(tire, record):
    recording = record()
    plain = CorrectedModel(tire, (), ("fy",), Reference(prepare(tire, recording).data.states.scales))
    changes = (("sensor_drift", {"fy": 100.0, "fx": 0.0, "lag": 20.0}),)
    drifting = dataclasses.replace(plain, changes=changes)
    for later, there in ((1e4, 100.0), (-1e4, 0.0)):
        other = recording.assign(time=recording["time"] + later)
        added = drifting.predict(other)["fy"] - plain.predict(other)["fy"]
        np.testing.assert_allclose(added, there, atol=1e-6)


def test_pressure_changes_the_stiffness_more_at_large_load(tire, record):
    """MF 6.1's PPY2: a softer tire saturates at a smaller load."""
    data = prepare(tire, record()).data
    now = simulate(data, [("inflation_pressure", {"stiffness_load": 0.5, "reference": 2.2e5})])["fy"]
    d = (data.smooth("pressure") - 2.2e5) / 2.2e5
    small = (np.abs(data.get("slip_angle")) < 0.01) & (np.abs(data.get("slip_angle")) > 0.004) & (d < -0.1)
    ratio = now[small] / data.simulation.base["fy"][small]
    expected = 1.0 + 0.5 * d[small] * data.nominal.load_excess(data.get("normal_load"))[small]
    np.testing.assert_allclose(ratio, expected, atol=0.01)


def test_friction_by_sliding_speed_shows_at_large_slip_only(tire, record):
    recording = record()
    data = prepare(tire, recording.assign(speed=16.7 * (1.0 + 0.3 * np.sin(recording["time"] / 9.0)))).data
    values = {**catalogue()["speed_dependence"].zeros(data), "sliding": 1.0}
    ratio = simulate(data, [("speed_dependence", values)])["fy"] / data.simulation.base["fy"]
    small, large = (np.abs(data.get("slip_angle")) < a for a in (0.03, 0.15))
    assert np.abs(ratio[small & (np.abs(data.get("slip_angle")) > 0.005)] - 1.0).max() < 0.01
    assert np.abs(ratio[~large] - 1.0).max() > 0.03


def test_a_parameter_has_two_digits_of_its_standard_error():
    assert amount_with_interval(-0.844, 0.191, (-1.218, -0.47), "1") == ("-84%", "-122% to -47%")
    assert amount_with_interval(0.0123, 0.0004, (0.0115, 0.0131), "s") == ("12.30 ms", "11.50 to 13.10 ms")
    assert amount_with_interval(1234.5, np.inf, (0.0, np.inf), "N") == ("1,230 N", "unknown")


def test_harmonic_power_is_the_plain_sum():
    rng = np.random.default_rng(0)
    signal, way = rng.normal(size=300), np.cumsum(rng.uniform(0.1, 0.3, 300))
    plain = [abs(np.sum(signal * np.exp(-1j * way * k))) for k in 2.0 + 0.05 * np.arange(40)]
    np.testing.assert_allclose(harmonic_power(signal, way, 2.0, 0.05, 40), plain, rtol=1e-9)


def test_combined_slip_does_not_start_where_it_does_nothing(tire, record):
    """At a coefficient near zero the weighting does not answer to it, and a fit would stay there."""
    hardly = tire.replace(RBX1=20.0, RBX2=11.0, RBY1=10.0, RBY2=3e-4, RCY1=1.0)
    data = prepare(hardly, record(9)).data
    own, on_top = catalogue()["combined_slip"].starts(data)
    assert own == {"RBX1": 20.0, "RBX2": 11.0, "RBY1": 10.0, "RBY2": 10.0, "more_x": 0.0, "more_y": 0.0}
    assert min(on_top["more_x"], on_top["more_y"]) > 0.0


def test_a_quarter_turn_is_the_derivative_by_the_wheels_angle():
    effect = catalogue()["nonuniformity"]
    wave = {p.name: 0.0 for p in effect.parameters} | {"cosine_y": 3.0, "sine_y": 4.0, "radius": 0.3}
    later = effect.quarter_turn(wave)
    phi = np.linspace(0.0, 6.0, 50)
    there = 3.0 * np.cos(phi + np.pi / 2.0) + 4.0 * np.sin(phi + np.pi / 2.0)
    np.testing.assert_allclose(later["cosine_y"] * np.cos(phi) + later["sine_y"] * np.sin(phi), there)
    assert later["radius"] == 0.3
