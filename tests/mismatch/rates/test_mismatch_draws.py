"""What is named in several draws of the small rig's noise: shares with their intervals, no single draw."""

from __future__ import annotations

import numpy as np
import pytest
from belt_lift import BeltLift, lifted_sweeps
from draw_rates import check_most
from small_rig import EXACT_FAULTS, at_its_limit, out_of_round, with_pauses
from weighed import named, named_sets

from tire_pipeline.mismatch import Explainer, explain_mismatch
from tire_pipeline.mismatch.discrepancy.unnamed import play
from tire_pipeline.mismatch.effects import catalogue, register
from tire_pipeline.mismatch.model.forces import simulate
from tire_pipeline.mismatch.proof.trial import put_in
from tire_pipeline.mismatch.recording.prepare import prepare


def _with(tire, recording, name, **parameters):
    """The recording with an effect of the catalogue put in."""
    data = prepare(tire, recording).data
    added = (
        simulate(data, [(name, {**catalogue()[name].zeros(data), **parameters})])["fy"]
        - data.simulation.base["fy"]
    )
    return recording.assign(fy=recording["fy"] + added)


def nothing(tire, record, seed):
    return named_sets(tire, record(seed)) == []


def less_friction(tire, record, seed):
    return named_sets(tire, record(seed, friction=0.9)) == [{"friction_scale"}]


def pressure(tire, record, seed):
    return named_sets(tire, record(seed, pressure_effect=-0.35)) == [{"inflation_pressure"}]


def an_offset(tire, record, seed):
    return named_sets(tire, record(seed, offset=150.0)) == [{"force_offset"}]


def heat_that_nobody_measured(tire, record, seed):
    """It changes friction alone: no stiffness and no optimum are paid for, and every set holds it."""
    change = (-0.1, -0.06, 0.06)[seed % 3]
    recording = record(
        seed, friction=1.0 + change * (prepare(tire, record(seed)).data.states.heat(60.0) - 0.5)
    )
    answer = Explainer().weigh(tire, recording).answer
    alone = next(each for each in answer.case.sets if each.names == ("temperature",))
    return (
        bool(answer.sets)
        and all("temperature" in names for names, _ in answer.sets)
        and alone.free == (("friction", "reference", "lag"),)
    )


def a_thrust_that_fades(tire, record, seed):
    """An offset of the angle looks alike where nothing but slip varies: it may stand beside it."""
    sets = named_sets(tire, _with(tire, record(seed), "plysteer_conicity", thrust=0.03))
    return len(sets) == 1 and "plysteer_conicity" in sets[0]


def a_leak_of_the_load(tire, record, seed):
    """Into one force it is not told from conicity."""
    recording = record(seed)
    leaking = recording.assign(fy=recording["fy"] + 0.02 * recording["normal_load"])
    sets = named_sets(tire, leaking)
    return len(sets) == 1 and sets[0] >= {"crosstalk", "plysteer_conicity"}


def a_soft_rig(tire, record, seed):
    """Compliance costs more stiffness at large load; the flexible form must not make up for that."""
    recording = record(seed)
    steer = 2.5e-6 * prepare(tire, recording).data.nominal.load
    answer = Explainer().weigh(tire, _with(tire, recording, "compliance", steer=steer)).answer
    found = dict(answer.named.changes).get("compliance", {"steer": 0.0})["steer"]
    return answer.names == ("compliance",) and abs(found / steer - 1.0) < 0.15


def _unexplained(tire, recording):
    report = explain_mismatch(tire, recording)
    return report.effects == [] and report.verdict == "unexplained"


def a_drum_with_a_seam(tire, record, seed):
    """Its pulses of 0.4 m have a mean, which alone would be conicity; the catalogue has no seam."""
    recording = record(seed, rate=50.0)
    data = prepare(tire, recording).data
    pulse = np.exp(-0.5 * (((data.states.distance / 6.7) % 1.0 - 0.5) / 0.06) ** 2)
    seam = 250.0 * pulse * data.get("normal_load") / 4000.0
    return _unexplained(tire, recording.assign(fy=recording["fy"] + seam))


def backlash(tire, record, seed):
    """Nor has it backlash, which is no delay."""
    recording = record(seed)
    at = {n: recording[n].to_numpy() for n in ("slip_angle", "normal_load")}
    start = np.arange(len(recording)) == 0
    behind = play(prepare(tire, recording).data.get("slip_angle"), (0.003, 0.008)[seed % 2], start)
    force = tire.forces(slip_angle=behind, normal_load=at["normal_load"]).fy - tire.forces(**at).fy
    return _unexplained(tire, recording.assign(fy=recording["fy"] + force))


def a_surface_that_changed(tire, record, seed):
    """Wear and temperature together look like it: two effects are not named in its place."""
    late = record(seed)["time"].to_numpy() > 70.0
    return named(tire, record(seed, friction=np.where(late, 0.93, 1.0))) == ["surface_change"]


def a_wheel_that_is_not_round(tire, record, seed):
    return named(tire, out_of_round(tire, record(seed))) == ["nonuniformity"]


def a_wheel_that_turns_on_in_the_pauses(tire, record, seed):
    """Without its phase over the pauses, pieces that begin at another angle of the wheel cancel out."""
    return named(tire, with_pauses(out_of_round(tire, record(seed), force=150.0))) == ["nonuniformity"]


def a_load_that_varies_once_a_turn(tire, record, seed):
    """It changes a force of either sign the other way, so the force has hardly any power once a turn."""
    radius = 0.97 * prepare(tire, record(seed)).data.nominal.radius
    wobbling = put_in(tire, record(seed), "nonuniformity", {"load_sine": 0.06, "radius": radius})
    found = Explainer().weigh(tire, wobbling)
    if found.answer.names != ("nonuniformity",):
        return False
    fit = found.analysis.fit
    error = fit.errors[[name for _, name in fit.labels].index("load_sine")]
    return abs(fit.changes[0][1]["load_sine"] - 0.06) < 3.0 * error


def a_small_wheel_that_turns_under_its_force(tire, record, seed):
    """Compliance of a car at 1:10, whose wheels carry 4 N."""
    small = tire.replace(FNOMIN=4.0, UNLOADED_RADIUS=0.023)
    recording = record(seed)
    recording = recording.assign(**{n: recording[n] / 1000.0 for n in ("normal_load", "fy")})
    answer = Explainer().weigh(small, _with(small, recording, "compliance", steer=0.01)).answer
    found = dict(answer.named.changes).get("compliance", {"steer": 0.0})["steer"]
    return answer.names == ("compliance",) and abs(found / 0.01 - 1.0) < 0.2


def _braked(tire, recording, seed, **weighting):
    """A model of both forces, and a recording of it at both slips."""
    model = tire.replace(PCX1=1.6, PDX1=1.1, PEX1=0.1, PKX1=22.0, **weighting)
    slip = 0.05 * np.sin(recording["time"].to_numpy())
    at = {n: recording[n].to_numpy() for n in ("slip_angle", "normal_load")}
    forces = model.forces(slip_ratio=slip, **at)
    noise = np.random.default_rng(seed).normal(0.0, 25.0, (2, slip.size))
    return model, recording.assign(slip_ratio=slip, fx=forces.fx + noise[0], fy=forces.fy + noise[1])


WEIGHTING = {"RBX1": 12.0, "RCX1": 1.0, "RBY1": 12.0, "RCY1": 1.0}


def a_leak_of_the_load_into_both_forces(tire, record, seed):
    model, recording = _braked(tire, record(seed), seed, **WEIGHTING)
    load = recording["normal_load"]
    leaking = recording.assign(fx=recording["fx"] - 0.02 * load, fy=recording["fy"] + 0.015 * load)
    answer = Explainer().weigh(model, leaking).answer
    if answer.names != ("crosstalk",):
        return False
    found = dict(answer.named.changes)["crosstalk"]
    return (
        abs(found["load_into_fy"] - 0.015) < 0.002
        and abs(found["load_into_fx"] + 0.02) < 0.003
        and max(abs(found["into_fy"]), abs(found["into_fx"])) < 0.002
    )


def a_leak_between_the_forces(tire, record, seed):
    """It has no leak of the load beside it."""
    model, recording = _braked(tire, record(seed), seed, **WEIGHTING)
    leaking = recording.assign(fx=recording["fx"] + 0.05 * recording["fy"])
    answer = Explainer().weigh(model, leaking).answer
    return (
        answer.names == ("crosstalk",)
        and set(answer.named.free[0]) == {"into_fx", "into_fy"}
        and abs(dict(answer.named.changes)["crosstalk"]["into_fx"] - 0.05) < 0.005
    )


def a_leak_of_the_load_into_one_of_both_forces(tire, record, seed):
    """Crosstalk paid for the leaks between the forces that are not there: conicity alone was named."""
    model, recording = _braked(tire, record(seed), seed, **WEIGHTING)
    sets = named_sets(model, recording.assign(fy=recording["fy"] + 0.02 * recording["normal_load"]))
    return bool(sets) and sets[0] >= {"crosstalk", "plysteer_conicity"}


def combined_slip_on_top_of_a_file_that_knows_little_of_it(tire, record, seed):
    """A weighting with a small C takes little of the force, whatever its B."""
    braked = tire.replace(PCX1=1.6, PDX1=1.1, PEX1=0.1, PKX1=22.0)
    little = braked.replace(RBX1=10.0, RBX2=10.0, RCX1=0.3, RBY1=12.0, RBY2=60.0, RCY1=0.6)
    much = braked.replace(RBX1=14.0, RBX2=8.0, RCX1=1.0, RBY1=16.0, RBY2=8.0, RCY1=1.0)
    recording = record(seed)
    slip = 0.1 * np.sin(recording["time"].to_numpy())
    at = {n: recording[n].to_numpy() for n in ("slip_angle", "normal_load")}
    forces = much.forces(slip_ratio=slip, **at)
    noise = np.random.default_rng(seed).normal(0.0, 25.0, (2, slip.size))
    recording = recording.assign(slip_ratio=slip, fx=forces.fx + noise[0], fy=forces.fy + noise[1])
    answer = Explainer().weigh(little, recording).answer
    return answer.names == ("combined_slip",) and set(answer.named.free[0]) <= {"more_x", "more_y"}


def a_file_fitted_at_one_load(tire, record, seed):
    """The cornering stiffness saturates with load; in the file it is in proportion to it."""
    peak = float(np.sin(2.0 * np.arctan(1.0 / tire.coefficients["PKY2"])))
    stiffness = tire.coefficients["PKY1"] * peak / np.sin(2.0 * np.arctan(0.01))
    straight = tire.replace(PKY2=100.0, PKY1=stiffness, PDY2=0.0)
    answer = Explainer().weigh(straight, record(seed)).answer
    if answer.names != ("load_sensitivity",):
        return False
    found = dict(answer.named.changes)["load_sensitivity"]
    return abs(found["rate"] + 0.1) < 0.03 and found["stiffness"] < -0.2


def a_delay(tire, record, seed):
    names = named(tire, record(seed, delay=0.08))
    return bool(names) and names[0] in {"time_delay", "low_pass"}


def an_exact_fault(tire, record, seed):
    """Another one in each draw."""
    fault, name = EXACT_FAULTS[seed % len(EXACT_FAULTS)]
    return named(tire, fault(record(seed))) == [name]


def a_force_that_stays_at_its_limit(tire, record, seed):
    return named(tire, at_its_limit(tire, record(seed), seed)) == ["clipping"]


def gaps_and_missing_blocks(tire, record, seed):
    recording = record(seed)
    recording = recording[~recording["time"].between(40.0, 52.0)].reset_index(drop=True)
    recording.loc[recording["time"].between(72.0, 80.0), "fy"] = np.nan
    return named(tire, recording) == []


def single_missing_samples(tire, record, seed):
    """A third of the loads are missing: what was left had an uneven time base and looked like relaxation."""
    recording = record(seed)
    recording.loc[::3, "normal_load"] = np.nan
    return named(tire, recording) == []


def a_slip_ratio_that_is_noise(tire, record, seed):
    """It has no unit: less of it would always fit better, a hundredth best of all."""
    braked = tire.replace(PCX1=1.6, PDX1=1.1, PEX1=0.1, PKX1=22.0, PKX3=0.2)
    recording = record(seed)
    noise = np.random.default_rng(seed).normal(0.0, [[4e-3], [5.0]], (2, len(recording)))
    return named(braked, recording.assign(slip_ratio=noise[0], fx=noise[1])) == []


def time_in_milliseconds(tire, record, seed):
    """No physics; the report asks for the unit of time."""
    recording = record(seed)
    names = named(tire, recording.assign(time=1000.0 * recording["time"]))
    return [name for name in names if catalogue()[name].kind == "physics"] == []


def a_relaxation_of_the_file_without_speed(tire, record, seed):
    four = record(seed)[["time", "slip_angle", "normal_load", "fy"]]
    return named(tire.replace(PTY1=2.0, PTY2=2.0), four) == []


def steady_points(tire, record, seed):
    return named(tire, record(seed).iloc[::30].drop(columns="time")) == []


def an_effect_from_outside(tire, record, seed):
    register(BeltLift())
    try:
        found = Explainer().weigh(tire, lifted_sweeps(tire, seed))
    finally:
        catalogue().pop("belt_lift")
    fit = found.analysis.fit
    if found.answer.names != ("belt_lift",):
        return False
    return abs(fit.changes[0][1]["lift"] - 0.12) < 3.0 * fit.errors[0]


def two_effects_that_look_like_another_tire(tire, record, seed):
    """A rig that gives way and friction that falls faster with load put several figures off at once."""
    recording = record(seed)
    fy, load = recording["fy"], recording["normal_load"]
    factor = 1.0 - 0.3 * (load / tire.coefficients["FNOMIN"] - 1.0)
    slip = np.arctan(np.tan(recording["slip_angle"]) * factor) + 0.02 * fy / fy.abs().max()
    found = Explainer().weigh(tire, recording.assign(slip_angle=slip, fy=fy * factor))
    return found.prepared.question is None and set(found.answer.names) == {"load_sensitivity", "compliance"}


RIGHT = (
    nothing,
    less_friction,
    pressure,
    an_offset,
    heat_that_nobody_measured,
    a_thrust_that_fades,
    a_leak_of_the_load,
    a_soft_rig,
    a_drum_with_a_seam,
    backlash,
    a_surface_that_changed,
    a_wheel_that_is_not_round,
    a_wheel_that_turns_on_in_the_pauses,
    a_load_that_varies_once_a_turn,
    a_small_wheel_that_turns_under_its_force,
    a_leak_of_the_load_into_both_forces,
    a_leak_between_the_forces,
    a_leak_of_the_load_into_one_of_both_forces,
    combined_slip_on_top_of_a_file_that_knows_little_of_it,
    a_file_fitted_at_one_load,
    a_delay,
    an_exact_fault,
    a_force_that_stays_at_its_limit,
    gaps_and_missing_blocks,
    single_missing_samples,
    a_slip_ratio_that_is_noise,
    time_in_milliseconds,
    a_relaxation_of_the_file_without_speed,
    steady_points,
    an_effect_from_outside,
    two_effects_that_look_like_another_tire,
)


@pytest.mark.long
@pytest.mark.parametrize("right", RIGHT, ids=lambda right: right.__name__)
def test_most_draws_are_told_rightly(tire, record, right):
    check_most(lambda seed: right(tire, record, seed), right.__name__)
