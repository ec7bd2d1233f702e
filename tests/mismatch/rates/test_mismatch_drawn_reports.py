"""What reports of several draws of the small rig's noise say and put right: shares with their intervals."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
from draw_rates import check_most
from located_mismatch import located
from real_at_rates import RATES, check_unseen, simulated
from small_rig import out_of_round

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch import Explainer, explain_mismatch, explain_recordings
from tire_pipeline.mismatch.inference.sets.answer import LEVEL
from tire_pipeline.mismatch.model.residual import residual
from tire_pipeline.mismatch.proof.left_out import each_left_out
from tire_pipeline.mismatch.proof.nested import FOLDS, RepeatedChoice
from tire_pipeline.mismatch.proof.never_worse import guarded

OTHER = 100
"""Seeds of another recording of the same rig are so much larger."""


def rms(x) -> float:
    return float(np.sqrt(np.mean(np.square(np.asarray(x, float)))))


def names(report):
    return [effect.name for effect in report.effects]


def pressure_is_located_and_put_in(tire, record, seed):
    report = explain_mismatch(tire, record(seed, pressure_effect=-0.35))
    if names(report) != ["inflation_pressure"] or not report.located:
        return False
    (effect,) = report.effects
    value, error, _ = effect.parameters["friction"]
    before = report.fit["fy"].rms_before
    other = record(seed + OTHER, pressure_effect=-0.35)
    left = other["fy"] - report.corrected.predict(other.drop(columns="fy"))["fy"]
    return (
        abs(value + 0.35) < 0.05
        and 0.0 < error < 0.1  # beside a background of usual effects
        and min(start for start, _ in effect.when) > 49.0
        and report.fit["fy"].rms_after < 0.5 * before
        and rms(left) < 0.5 * before
    )


def less_friction_stands_in_the_file_which_then_agrees(tire, record, seed):
    report = explain_mismatch(tire, record(seed, friction=0.88))
    file, _ = report.corrected.tire_model()
    again = explain_mismatch(file, record(seed + OTHER, friction=0.88))
    return (
        names(report) == ["friction_scale"]
        and abs(file.coefficients["LMUY"] - 0.88) < 0.02
        and again.verdict == "agrees"
    )


def a_wave_of_no_cause_gets_no_name(tire, record, seed):
    recording = record(seed)
    t = recording["time"].to_numpy()
    wave = np.sin(2.0 * np.pi * (1.3 * t + 0.4 * np.sin(0.7 * t)))
    at_large_slip = np.abs(recording["slip_angle"]) > 0.08
    report = explain_mismatch(tire, recording.assign(fy=recording["fy"] + 400.0 * wave * at_large_slip))
    return (report.verdict, report.effects) == ("unexplained", []) and report.remainder.size["fy"] > 100.0


def another_simulator_lacks_the_pressure(tire, record, seed):
    recording = record(seed, pressure_effect=-0.35)
    at = {n: recording[n].to_numpy() for n in ("slip_angle", "normal_load")}
    beside = recording.assign(simulated_fy=tire.forces(**at).fy)
    report = explain_mismatch(None, beside)
    left = recording["fy"] - report.corrected.predict(beside)["fy"]
    return names(report) == ["inflation_pressure"] and rms(left) < 0.6 * report.fit["fy"].rms_before


def friction_that_wanders_is_no_agreement(tire, record, seed):
    """With something that was not recorded: more is left than fitted formulas usually leave."""
    recording = record(seed).drop(columns=["pressure"])
    gust = 1.0 + 0.12 * np.sin(0.31 * recording["time"]) * np.cos(0.83 * recording["time"])
    report = explain_mismatch(tire, recording.assign(fy=recording["fy"] * gust))
    _, high = report.remainder.usual
    return (
        not report.effects
        and report.remainder.unusual.get("fy", 0.0) > high
        and "I can't tell" in report.summary
        and "agree" not in report.summary
    )


def what_two_recordings_share_predicts_the_third_that_shares_it(tire, record, seed):
    """And of a third that does not, the report says that it does not hold there."""
    runs = {n: record(3 * seed + k, friction=0.88).iloc[:2500] for k, n in enumerate("abc")}
    report = explain_recordings(tire, runs, held_out="b")
    error = report.held_out.errors["fy"]
    other = {**runs, "b": record(seed + OTHER, friction=1.3).iloc[:2500]}
    differs = explain_recordings(tire, other, held_out="b")
    return (
        names(report) == ["friction_scale"]
        and error.rms_after < 0.3 * error.rms_before
        and error.ratio_high < 0.5
        and differs.held_out.errors["fy"].ratio_low > 1.0
        and "does not hold there" in differs.summary
    )


MOMENTS = {"QBZ1": 8.0, "QCZ1": 1.1, "QDZ1": 0.12, "QBZ9": 10.0, "QSX1": 0.01, "QSX3": 0.03}


def moments_are_corrected_with_the_forces(tire, record, seed):
    """Friction is down by 15%. Similarity is not how LMUY acts on the moments, but near to it."""
    model = TireModel.from_coefficients({**tire.coefficients, **MOMENTS}, version="5.2")
    recording = record(seed, friction=0.85)
    at = {n: recording[n].to_numpy() for n in ("slip_angle", "normal_load")}
    less = model.replace(LMUY=0.85).forces(**at)
    noise = np.random.default_rng(seed).normal(0.0, 1.0, (2, len(recording)))
    report = explain_mismatch(model, recording.assign(mz=less.mz + noise[0], mx=less.mx + noise[1]))
    moments = [report.fit[n] for n in ("mz", "mx")]
    return names(report) == ["friction_scale"] and all(
        abs(fit.noise_floor - 1.0) < 0.1 and fit.recovered > 0.8 for fit in moments
    )


def what_shakes_is_no_longer_noise_once_it_is_modelled(tire, record, seed):
    """The recording's noise is 25 N; a wheel that is not round looks like more until it is in."""
    recording = out_of_round(tire, record(seed))
    report = explain_mismatch(tire, recording)
    left = recording["fy"] - report.corrected.predict(recording)["fy"]
    return (
        names(report) == ["nonuniformity"]
        and abs(report.fit["fy"].noise_floor / 25.0 - 1.0) < 0.2
        and np.std(left) < 30.0
    )


def a_right_correction_is_put_in_and_a_wrong_one_is_not_beside_it(tire, record, seed):
    softer = Explainer().weigh(tire, record(seed, friction=0.9))
    allowed = guarded(softer.analysis, softer.sets, LEVEL)
    return allowed.part > 0.8 and allowed.fit.names == softer.analysis.fit.names == ["friction_scale"]


def a_clear_cause_is_chosen_without_any_fold_and_leaves_as_little(tire, record, seed):
    softer = Explainer().weigh(tire, record(seed, friction=0.9))
    found = RepeatedChoice(softer.sets, softer.analysis.block, LEVEL).unseen()
    left = rms(each_left_out(softer.analysis, softer.analysis.fit)["fy"])
    return found.chosen == (("friction_scale",),) * FOLDS and abs(rms(found.left["fy"]) / left - 1.0) < 0.05


def a_choice_that_rests_on_one_fold_removes_nothing_there(tire, record, seed):
    """An offset of the force in every fifth sweep alone: the others never show it."""
    plain = Explainer().weigh(tire, record(seed))
    data, block = plain.analysis.data, plain.analysis.block
    there = block % FOLDS == 2
    data.recorded["fy"][there] += 400.0
    found = RepeatedChoice(plain.sets, block, LEVEL).unseen()
    before = residual(data, [])["fy"]
    return np.mean(found.left["fy"][there] ** 2) >= 0.99 * np.mean(before[there] ** 2)


def a_correction_from_one_side_says_that_nothing_proves_it_on_the_other(tire, record, seed):
    both = record(seed, friction=0.9)
    one_side = both[both["slip_angle"] > -0.01]
    said = ["to one side" in " ".join(explain_mismatch(tire, each).notes) for each in (one_side, both)]
    return said == [True, False]


def combined_slip_is_located_in_slip_ratio_and_not_in_what_came_along(tire, record, seed):
    """The tread warmed while the rig braked: the tread temperature was the place."""
    model = tire.replace(PCX1=1.6, PDX1=1.1, PEX1=0.1, PKX1=22.0, PKX3=0.2)
    full = model.replace(RBY1=9.0, RBY2=7.0, RCY1=1.05)
    t = np.arange(0.0, 120.0, 0.05)
    braking = (t // 10.0) % 2 == 1
    slip = {
        "slip_angle": np.where(braking, 0.07 * np.sign(np.sin(t / 20.0)), 0.15 * np.sin(0.84 * t)),
        "slip_ratio": np.where(braking, -0.06 * (1.0 - np.cos(2.0 * np.pi * t / 5.0)), 0.0),
        "normal_load": np.array([3000.0, 4500.0])[(t // 40.0).astype(int) % 2],
    }
    warm = np.convolve(np.where(braking, 60.0, 30.0), np.full(100, 0.01), "same")
    forces = full.forces(**slip)
    recording = pd.DataFrame({"time": t, **slip, "tread_temperature": warm, "speed": 16.7})
    noise = np.random.default_rng(seed).normal(0.0, 20.0, (2, t.size))
    found, even, said = located(model, recording.assign(fx=forces.fx + noise[0], fy=forces.fy + noise[1]))
    lateral = [f for f in found if f.output == "fy" and f.along_force]
    return (
        bool(lateral)
        and lateral[0].axis == "slip_ratio"
        and even == {}
        and said.lower().startswith("at slip ratio")
        and "temperature" not in said
    )


RIGHT = (
    pressure_is_located_and_put_in,
    less_friction_stands_in_the_file_which_then_agrees,
    a_wave_of_no_cause_gets_no_name,
    another_simulator_lacks_the_pressure,
    friction_that_wanders_is_no_agreement,
    what_two_recordings_share_predicts_the_third_that_shares_it,
    moments_are_corrected_with_the_forces,
    what_shakes_is_no_longer_noise_once_it_is_modelled,
    a_right_correction_is_put_in_and_a_wrong_one_is_not_beside_it,
    a_clear_cause_is_chosen_without_any_fold_and_leaves_as_little,
    a_choice_that_rests_on_one_fold_removes_nothing_there,
    a_correction_from_one_side_says_that_nothing_proves_it_on_the_other,
    combined_slip_is_located_in_slip_ratio_and_not_in_what_came_along,
)


@pytest.mark.long
@pytest.mark.parametrize("right", RIGHT, ids=lambda right: right.__name__)
def test_most_draws_are_told_rightly_in_full(tire, record, right):
    check_most(lambda seed: right(tire, record, seed), right.__name__)


@pytest.mark.long
@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize(("friction", "named"), [(1.0, []), (0.85, [("friction_scale",)])])
def test_a_rig_at_any_rate_has_the_friction_named_that_it_lacks_and_no_other(tire, rate, friction, named):
    """And in no draw are sweeps worse that no fit has seen."""

    def right(seed):
        report = check_unseen(*simulated(tire, rate, friction, seed))
        return [names for names, _ in report.sets] == named

    check_most(right, f"friction {friction} at {rate} Hz")
