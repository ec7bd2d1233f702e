"""Cases: determinism, strengths, schedules that give nothing away, artefacts, sealing."""

import json
from collections import Counter
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.concealed import Answer, case_plan, make_case, make_cases, seal, unseal
from tire_pipeline.concealed.brush_rig.artefacts import ArtefactDetails, apply_artefact
from tire_pipeline.concealed.brush_rig.constants import draw_constants, without_cooling
from tire_pipeline.concealed.brush_rig.recorded_run import BrushRig, SensorNoise, add_noise
from tire_pipeline.concealed.brush_rig.schedule import OPTIONAL_BLOCKS, draw_plan, make_schedule
from tire_pipeline.concealed.brush_rig.unknown_effects import play
from tire_pipeline.concealed.cases import effect_size
from tire_pipeline.concealed.cases.clean_run import residual, rms
from tire_pipeline.concealed.cases.drawn_effects import KIND_SHARES, choose
from tire_pipeline.concealed.cases.windows_and_regimes import regimes, windows
from tire_pipeline.concealed.effect_names import (
    AMBIGUOUS_SETS,
    ARTEFACTS,
    HEAT_OR_WEAR,
    PHYSICS,
    UNKNOWN_EFFECTS,
)
from tire_pipeline.errors import DomainError


@pytest.fixture(scope="module")
def made():
    return [
        make_case(seed, kind)
        for seed, kind in enumerate(("nothing", "single", "ambiguous", "artefact", "unknown"), 11)
    ]


def test_the_same_seed_gives_the_same_case_and_seal():
    first, second, other = make_case(3, "single"), make_case(3, "single"), make_case(4, "single")
    pd.testing.assert_frame_equal(first[0].recording, second[0].recording)
    pd.testing.assert_frame_equal(first[0].held_out, second[0].held_out)
    assert first[0].tire.coefficients == second[0].tire.coefficients
    assert seal([first[1]]) == seal([second[1]])
    assert seal([first[1]])[1] != seal([other[1]])[1]


def test_a_case_looks_like_a_recording_and_tells_nothing(made):
    for case, answer in made:
        assert case.case_id == answer.case_id
        for frame in (case.recording, case.held_out):
            assert np.isfinite(frame.to_numpy()).all()
            assert np.allclose(np.diff(frame["time"]), 0.02)
            assert not set(frame.columns) - {
                "time", "slip_angle", "slip_ratio", "camber", "normal_load", "speed", "pressure",
                "turn_slip", "tread_temperature", "fx", "fy",
            }  # fmt: skip
        assert 1000 <= len(case.recording) <= 17000
        assert case.held_out["time"].iloc[0] > case.recording["time"].iloc[-1]
        assert ("turn_slip" in case.recording) == ("turn" in answer.blocks)
        shown = repr(case) + case.case_id
        for name in (*PHYSICS, *ARTEFACTS, *UNKNOWN_EFFECTS):
            assert name not in shown


def test_every_channel_but_time_is_noisy(made):
    frame = made[0][0].recording
    for channel in frame.columns.drop("time"):
        assert np.std(np.diff(frame[channel], n=2)) > 0.0, channel


def test_noise_has_the_size_and_colour_that_were_drawn():
    noise = SensorNoise({"fy": 20.0, "speed": 0.1}, {"fy": 0.8, "speed": 0.5}, 0.5)
    still = pd.DataFrame({"time": np.arange(40000) * 0.02, "fy": 0.0, "speed": 10.0})
    out = add_noise(still, noise, np.random.default_rng(0))
    assert out["time"].equals(still["time"])
    assert out["fy"].std() == pytest.approx(20.0, rel=0.03)
    neighbours = np.corrcoef(out["fy"][:-1], out["fy"][1:])[0, 1]
    assert neighbours == pytest.approx(0.5 * 0.8, abs=0.03)


def test_effects_are_between_half_and_six_times_the_misfit(made):
    for _, answer in made:
        assert 0.004 <= answer.misfit / answer.largest_force <= 0.010
        for effect in answer.effects:
            if effect.name not in ("sign_convention", "unit_error", "stuck_channel"):
                assert 0.5 <= effect.over_misfit <= 6.0


def test_a_third_of_the_drawn_strengths_is_below_twice_the_misfit():
    rng = np.random.default_rng(0)
    drawn = np.array([effect_size.draw_ratio(rng, 0.5, 6.0) for _ in range(4000)])
    assert drawn.min() >= 0.5
    assert drawn.max() <= 6.0
    assert np.mean(drawn < 2.0) > 0.40


def test_find_strength_meets_what_was_wanted_and_respects_limits():
    found, got = effect_size.find_strength(lambda x: 3.0 * x**1.5, 2.0, 0.1, (0.0, 10.0))
    assert got == pytest.approx(2.0, rel=0.15)
    assert 3.0 * found**1.5 == pytest.approx(got)
    found, _ = effect_size.find_strength(lambda x: x, 5.0, 0.1, (0.01, 1.0))
    assert found == 1.0


@pytest.mark.slow
@pytest.mark.parametrize("seeds", [range(3), pytest.param(range(3, 20), marks=pytest.mark.long)])
def test_where_nothing_is_missing_the_recording_misfits_by_half_a_percent(seeds):
    for seed in seeds:
        case, answer = make_case(seed, "nothing")
        total = rms(residual(case.tire, case.recording))
        misfit = np.sqrt(total**2 - answer.noise**2)
        assert 0.0035 <= misfit / answer.largest_force <= 0.0105
        assert answer.effects == ()
        for errors in answer.oracle.values():
            assert errors["rms_oracle"] == pytest.approx(errors["rms_before"], rel=1e-9)


def check_sizes(answer):
    """Sizes are those asked for, and who knows what is missing predicts better."""
    for effect in answer.effects:
        if effect.name not in ("sign_convention", "unit_error", "stuck_channel"):
            assert 0.5 <= effect.over_misfit <= 6.0
    before = sum(o["rms_before"] ** 2 for o in answer.oracle.values())
    best = sum(o["rms_oracle"] ** 2 for o in answer.oracle.values())
    names = {e.name for e in answer.effects}
    # In the held-out run a new tire is not worn and the channel is free again: nothing is gained there.
    gone = names & {"wear", "stuck_channel"}
    if names and not gone and min(e.over_misfit for e in answer.effects) > 3.0:
        assert best < before, names


def test_the_oracle_gains_by_a_large_effect(made):
    large = [answer for _, answer in made if min((e.over_misfit for e in answer.effects), default=0.0) > 3.0]
    assert len(large) >= 3
    for answer in large:
        if "clipping" not in {e.name for e in answer.effects}:  # no limit is reached in the other run
            check_sizes(answer)


@pytest.mark.long
def test_every_effect_can_be_made_and_the_oracle_gains_by_it():
    seen: Counter[str] = Counter()
    weak = total = 0
    for case, answer in make_cases(45, 99):
        assert len(case.recording) > 0
        seen.update(e.name for e in answer.effects)
        for effect in answer.effects:
            if effect.name not in ("sign_convention", "unit_error", "stuck_channel"):
                total += 1
                weak += effect.over_misfit < 2.0
        check_sizes(answer)
    assert len(seen) > 12
    assert weak / total > 1.0 / 3.0


def block_counts(kinds: dict[str, float], n: int, seed: int) -> np.ndarray:
    rng = np.random.default_rng(seed)
    names, shares = list(kinds), np.array(list(kinds.values()))
    counts = np.zeros(len(OPTIONAL_BLOCKS) + 1)
    for _ in range(n):
        choice = choose(rng, str(rng.choice(names, p=shares / shares.sum())))
        plan = draw_plan(
            rng,
            choice.focus,
            ambiguous=choice.ambiguous,
            nominal_load=4000.0,
            speed=16.0,
            pressure=2.2e5,
        )
        counts[:-1] += [b in plan.blocks for b in OPTIONAL_BLOCKS]
        counts[-1] += choice.hide_temperature
    return counts / n


def test_the_schedule_does_not_give_away_whether_something_is_missing():
    n = 4000
    with_effect = block_counts({k: KIND_SHARES[k] for k in ("single", "pair", "ambiguous")}, n, 1)
    without = block_counts({"nothing": 1.0}, n, 2)
    middle = 0.5 * (with_effect + without)
    error = np.sqrt(2.0 * middle * (1.0 - middle) / n)
    assert np.all(np.abs(with_effect - without) < 4.0 * error)


def test_half_of_the_temperature_cases_lack_the_channel():
    rng = np.random.default_rng(3)
    hidden = [
        c.hide_temperature
        for c in (choose(rng, "single") for _ in range(8000))
        if c.effects == ("temperature",)
    ]
    assert len(hidden) > 300
    assert np.mean(hidden) == pytest.approx(0.5, abs=0.08)


def test_the_plan_keeps_the_proportions_and_says_nothing_by_order():
    plan = case_plan(400, 5)
    counts = Counter(kind for _, kind in plan)
    assert counts == {
        "nothing": 80, "single": 140, "pair": 60, "ambiguous": 40, "artefact": 40, "unknown": 40,
    }  # fmt: skip
    assert len({seed for seed, _ in plan}) == 400
    assert plan == case_plan(400, 5)
    assert plan != case_plan(400, 6)
    kinds = [kind for _, kind in plan]
    assert kinds != sorted(kinds)


def test_an_unknown_kind_is_refused():
    with pytest.raises(DomainError, match="kind 'triple'"):
        make_case(1, "triple")


def test_the_held_out_run_has_a_load_that_the_recording_lacks():
    rng = np.random.default_rng(0)
    for _ in range(20):
        plan = draw_plan(rng, ("camber",), ambiguous=None, nominal_load=4000.0, speed=16.0, pressure=2.2e5)
        recorded, _ = make_schedule(plan, rng, rate=50.0)
        held_out, starts = make_schedule(plan, rng, rate=50.0, held_out=True)
        assert held_out["camber"].abs().max() < recorded["camber"].abs().max()
        assert "camber" in {name for name, _ in starts}
        distance = min(abs(plan.held_out_load - load) for load in plan.loads)
        assert distance > 0.02 * plan.nominal_load


def test_ambiguous_schedules_cannot_separate_what_they_must_not():
    rng = np.random.default_rng(1)
    for which in range(len(AMBIGUOUS_SETS)):
        plan = draw_plan(
            rng,
            AMBIGUOUS_SETS[which][:1],
            ambiguous=which,
            nominal_load=4000.0,
            speed=16.0,
            pressure=2.2e5,
        )
        frame, _ = make_schedule(plan, rng, rate=50.0)
        assert np.ptp(frame["speed"]) < 1e-9
        if which >= 2:
            assert np.ptp(frame["normal_load"]) < 1e-9
            assert np.ptp(frame["camber"]) < 1e-9


@pytest.mark.parametrize("seed", range(5))
def test_a_tire_that_keeps_its_heat_warms_as_it_wears(seed):
    """Only then does temperature without its channel look like wear."""
    rng = np.random.default_rng(seed)
    constants = draw_constants(rng)
    plan = draw_plan(
        rng,
        ("wear",),
        ambiguous=HEAT_OR_WEAR,
        nominal_load=constants.nominal_load,
        speed=16.0,
        pressure=2.2e5,
    )
    schedule, _ = make_schedule(plan, rng, rate=50.0)
    cooling = BrushRig(constants, rng.random(4), 1.0, {}, {"fx": 0.0, "fy": 0.0}, 24)
    keeping = replace(cooling, constants=without_cooling(constants, 1e5))
    alike = []
    for rig in (cooling, keeping):
        frame = rig.run(schedule, {})
        alike.append(np.corrcoef(frame["tread_temperature"], frame["wear"])[0, 1])
    assert alike[1] > max(0.98, alike[0])
    assert frame["tread_temperature"].is_monotonic_increasing
    assert frame["tread_temperature"].iloc[0] == pytest.approx(constants.reference_temperature, abs=0.5)


def frame_of(n: int = 500) -> pd.DataFrame:
    time = np.arange(n) * 0.02
    return pd.DataFrame(
        {
            "time": time,
            "slip_angle": 0.1 * np.sin(time),
            "normal_load": 4000.0,
            "camber": 0.0,
            "fx": 100.0 * np.cos(time),
            "fy": 3000.0 * np.sin(time),
        }
    )


@pytest.mark.parametrize(
    ("name", "strength", "channel", "changed"),
    [
        ("force_offset", 50.0, "fy", lambda f: f["fy"] + 50.0),
        ("force_gain", 0.1, "fy", lambda f: f["fy"] * 1.1),
        ("slip_angle_offset", 0.01, "slip_angle", lambda f: f["slip_angle"] + 0.01),
        ("sign_convention", 1.0, "fy", lambda f: -f["fy"]),
        ("crosstalk", 0.05, "fx", lambda f: f["fx"] + 0.05 * f["fy"]),
        ("clipping", 0.2, "fy", lambda f: f["fy"].clip(-2400.0, 2400.0)),
        ("unit_error", 1.0, "slip_angle", lambda f: np.rad2deg(f["slip_angle"])),
        ("sensor_drift", 80.0, "fy", lambda f: f["fy"] + 80.0 * f["time"] / 10.0),
    ],
)
def test_artefacts_do_what_they_say_to_their_channel_only(name, strength, channel, changed):
    frame = frame_of()
    details = ArtefactDetails(channel, 1.0, 180.0 / np.pi, (2.0, 4.0), 10.0)
    out = apply_artefact(frame, name, strength, details, {"fx": 100.0, "fy": 3000.0})
    np.testing.assert_allclose(out[channel], changed(frame))
    others = [c for c in frame if c != channel]
    pd.testing.assert_frame_equal(out[others], frame[others])


def test_delay_low_pass_and_stuck_channel():
    frame = frame_of()
    details = ArtefactDetails("normal_load", 1.0, 1.0, (2.0, 4.0), 10.0)
    late = apply_artefact(frame, "time_delay", 0.1, details, {})
    np.testing.assert_allclose(late["fy"].iloc[5:], frame["fy"].iloc[:-5], atol=1e-9)
    slow = apply_artefact(frame, "low_pass", 0.1, details, {})
    gap = slow["fy"].to_numpy() - 3000.0 * np.sin(frame["time"].to_numpy() - 0.1)
    assert np.abs(gap[100:]).max() < 60.0
    moving = frame.assign(normal_load=4000.0 + 100.0 * frame["time"])
    stuck = apply_artefact(moving, "stuck_channel", 1.0, details, {})["normal_load"]
    assert np.ptp(stuck[(frame["time"] > 2.0) & (frame["time"] < 3.99)]) == 0.0
    assert stuck.iloc[-1] == moving["normal_load"].iloc[-1]


def test_play_holds_the_angle_at_reversals():
    angle = np.sin(np.linspace(0.0, 4.0 * np.pi, 400))
    behind = play(angle, 0.1)
    assert np.abs(behind - angle).max() == pytest.approx(0.1)
    assert behind[200:].max() == pytest.approx(0.9, abs=1e-3)


def test_windows_and_regimes_find_a_burst():
    time = np.arange(2000) * 0.02
    burst = np.where((time > 10.0) & (time < 20.0), 5.0, 0.0)
    ((start, end),) = windows(burst, time, 2.0)
    assert start == pytest.approx(10.0, abs=0.6)
    assert end == pytest.approx(20.0, abs=0.6)
    assert windows(burst, time, 9.0) == ()
    low, high = regimes(burst, pd.DataFrame({"speed": time}))["speed"]
    assert (low, high) == (pytest.approx(10.5, abs=0.1), pytest.approx(19.5, abs=0.1))


def test_answers_survive_sealing_and_a_changed_one_is_noticed(made):
    answers = [answer for _, answer in made]
    data, sha256 = seal(answers)
    assert seal(reversed(answers)) == (data, sha256), "the order of the answers does not matter"
    back = unseal(data, sha256)
    assert {a.case_id: a.to_dict() for a in back} == {a.case_id: a.to_dict() for a in answers}
    assert isinstance(back[0], Answer)
    json.loads(data)
    with pytest.raises(DomainError, match="SHA-256"):
        unseal(data.replace(b"nothing", b"single!"), sha256)


def test_the_rig_never_jumps_the_slip_angle():
    rng = np.random.default_rng(2)
    for seed in range(10):
        plan = draw_plan(
            np.random.default_rng(seed),
            ("combined_slip", "relaxation_length"),
            ambiguous=None,
            nominal_load=4000.0,
            speed=16.0,
            pressure=2.2e5,
        )
        for held_out in (False, True):
            frame, _ = make_schedule(plan, rng, rate=50.0, held_out=held_out)
            assert np.abs(np.diff(frame["slip_angle"])).max() / 0.02 < 0.8


def _side_force_of_braking(tire):
    """Largest side force at straight braking and driving, as a part of the largest one at all."""
    load, slip = np.full(2, tire.value("FNOMIN")), np.array([-0.1, 0.1])
    fy = tire.forces(slip_angle=np.zeros(2), slip_ratio=slip, normal_load=load, limits="ignore").fy
    return np.abs(fy).max() / (tire.value("PDY1") * load[0])


def test_the_file_of_a_case_makes_no_side_force_from_braking_alone(made):
    """The clean run has combined slip at four angles only: at none between them may the fit run free."""
    assert max(_side_force_of_braking(case.tire) for case, _ in made) < 0.012


@pytest.mark.long
def test_no_file_of_a_spent_proof_makes_side_force_from_braking_alone():
    """It was 4% in two of them once."""
    parts = [_side_force_of_braking(case.tire) for case, _ in make_cases(400, 20261122)]
    assert np.mean(np.array(parts) < 0.012) == 1.0
