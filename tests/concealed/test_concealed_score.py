"""The scorer on reports made by hand."""

import json

import numpy as np
import pytest

from tire_pipeline.concealed import Answer, EffectTruth, score
from tire_pipeline.concealed.effect_names import AMBIGUOUS_SETS
from tire_pipeline.concealed.scoring.calibration import calibration_error, calibration_rows
from tire_pipeline.concealed.scoring.overlap import interval_iou
from tire_pipeline.concealed.scoring.score import covers, exact_set, false_physics, recovered
from tire_pipeline.concealed.scoring.words import in_words, outcome
from tire_pipeline.errors import DomainError


def truth(name: str, kind: str = "physics", over_noise: float = 2.0, **more: object) -> EffectTruth:
    values = {
        "strength": 1.0,
        "rms": 50.0,
        "over_misfit": 2.0,
        "output": "fy",
        "when": ((10.0, 20.0),),
        "where": {"normal_load": (2000.0, 4000.0)},
        "details": {},
    } | more
    return EffectTruth(name=name, kind=kind, over_noise=over_noise, **values)


def answer(case_id: str, kind: str, *effects: EffectTruth, acceptable: tuple = ()) -> Answer:
    return Answer(
        case_id=case_id,
        kind=kind,
        effects=effects,
        acceptable=acceptable,
        missing_channels=(),
        blocks=(),
        focus=(),
        largest_force=5000.0,
        misfit=30.0,
        noise=25.0,
        oracle={"fy": {"rms_before": 100.0, "rms_oracle": 40.0}},
    )


def entry(name: str, *alternatives: str, confidence: float = 1.0, **more: object) -> dict:
    return {"name": name, "alternatives": list(alternatives), "confidence": confidence, **more}


def report(*effects: dict, verdict: str = "explained") -> dict:
    return {"verdict": verdict, "effects": list(effects)}


def value(result: dict, name: str) -> dict:
    return next(row for row in result["scores"] if row["name"] == name)


def test_perfect_reports_score_perfectly_and_miss_nothing():
    answers = [
        answer("a", "nothing"),
        answer("b", "single", truth("wear")),
        answer("c", "pair", truth("camber"), truth("force_offset", "artefact")),
        answer("d", "ambiguous", truth("temperature"), acceptable=("temperature", "wear")),
        answer("e", "artefact", truth("time_delay", "artefact")),
        answer("f", "unknown", truth("backlash", "unknown")),
    ]
    good = {"when": [[10.0, 20.0]], "where": {"normal_load": [2000.0, 4000.0]}}
    reports = {
        "a": report(verdict="agrees"),
        "b": report(entry("wear", **good)),
        "c": report(entry("force_offset", **good), entry("camber", **good)),
        "d": report(entry("wear", "temperature"), verdict="ambiguous"),
        "e": report(entry("time_delay", **good)),
        "f": report(verdict="unexplained"),
    }
    held_out = {k: {"fy": {"rms_before": 100.0, "rms_after": 40.0}} for k in "bcde"}
    result = score(reports, answers, held_out=held_out)
    assert result["misses"] == []
    for row in result["scores"]:
        assert row["met"] in (True, None), row
    assert value(result, "window IoU")["value"] == 1.0
    assert value(result, "held-out share of the oracle's")["value"] == pytest.approx(1.0)
    assert value(result, "calibration error")["value"] == pytest.approx(0.0)
    assert value(result, "ambiguous, names given")["value"] == 2.0
    json.dumps(result)


def test_every_kind_of_mistake_is_counted_and_listed():
    answers = [
        answer("null", "nothing"),
        answer("artefact", "artefact", truth("time_delay", "artefact")),
        answer("single", "single", truth("wear")),
        answer("extra", "single", truth("wear")),
        answer("half", "pair", truth("wear"), truth("camber")),
        answer("vague", "ambiguous", truth("temperature"), acceptable=("temperature", "wear")),
        answer("outside", "unknown", truth("backlash", "unknown")),
    ]
    reports = {
        "null": report(entry("camber")),
        "artefact": report(entry("relaxation_length")),
        "single": report(verdict="agrees"),
        "extra": report(entry("wear"), entry("camber")),
        "half": report(entry("wear")),
        "vague": report(entry("wear", "friction_scale")),
        "outside": report(entry("time_delay")),
    }
    result = score(reports, answers)
    assert {m["case"] for m in result["misses"]} == set(reports)
    assert value(result, "false physics")["value"] == 1.0
    assert value(result, "exact set, single")["value"] == 0.0
    assert value(result, "exact set, pair")["value"] == 0.0
    assert value(result, "ambiguous covered")["value"] == 0.0
    assert value(result, "false names, outside the catalogue")["value"] == 1.0
    half = next(m for m in result["misses"] if m["case"] == "half")
    assert half["missed"] == ["camber"]
    assert half["invented"] == []
    extra = next(m for m in result["misses"] if m["case"] == "extra")
    assert extra["invented"] == ["camber"]


def test_an_artefact_named_with_physics_left_open_is_no_false_physics():
    a = answer("a", "artefact", truth("time_delay", "artefact"))
    assert not false_physics(report(entry("time_delay", "relaxation_length")), a)
    assert not false_physics(report(entry("relaxation_length", "time_delay")), a)
    assert false_physics(report(entry("relaxation_length")), a)
    assert not exact_set(report(entry("relaxation_length", "time_delay")), a)


def test_naming_everything_covers_nothing():
    a = answer("a", "ambiguous", truth("wear"), acceptable=("temperature", "wear"))
    assert covers(report(entry("temperature", "wear")), a)
    assert covers(report(entry("wear")), a)
    assert not covers(report(entry("temperature")), a)
    assert not covers(report(entry("wear", "temperature", "camber")), a)


def test_the_same_name_twice_is_not_the_exact_set():
    a = answer("a", "single", truth("wear"))
    assert exact_set(report(entry("wear")), a)
    assert not exact_set(report(entry("wear"), entry("wear")), a)
    assert exact_set(report(entry("wear"), entry("unexplained")), a), "no catalogue name"


def test_weak_effects_do_not_count_towards_the_target_but_are_shown():
    answers = [
        answer("weak", "single", truth("wear", over_noise=0.4)),
        answer("strong", "single", truth("wear", over_noise=0.7)),
    ]
    result = score({"weak": report(), "strong": report(entry("wear"))}, answers)
    assert value(result, "exact set, single")["value"] == 0.5
    assert value(result, "exact set, single above 0.6 noise")["n"] == 1
    assert value(result, "exact set, single above 0.6 noise")["met"] is True
    bins = {(r["above"], r["up_to"]): r["value"] for r in result["by_strength"]}
    assert bins == {(0.0, 0.6): 0.0, (0.6, 1.0): 1.0}
    assert result["by_effect"][0]["n"] == 2


def test_intervals_are_wilsons():
    answers = [answer(str(i), "nothing") for i in range(50)]
    result = score({str(i): report() for i in range(50)}, answers)
    row = value(result, "false physics")
    z2 = 1.959963984540054**2
    assert row["low"] == pytest.approx(0.0, abs=1e-12)
    assert row["high"] == pytest.approx(z2 / (50 + z2))


@pytest.mark.parametrize(
    ("a", "b", "expected"),
    [
        ([(0, 10)], [(0, 10)], 1.0),
        ([(0, 10)], [(5, 15)], 1.0 / 3.0),
        ([(0, 4), (6, 10)], [(0, 10)], 0.8),
        ([(0, 6), (4, 10)], [(0, 10)], 1.0),
        ([], [(0, 10)], 0.0),
        ([(0, 1)], [(2, 3)], 0.0),
        ([], [], 1.0),
    ],
)
def test_interval_iou(a, b, expected):
    assert interval_iou(a, b) == pytest.approx(expected)
    assert interval_iou(b, a) == pytest.approx(expected)


def test_calibration_error_of_known_cases():
    assert calibration_error([1.0, 1.0], [True, False]) == pytest.approx(0.5)
    assert calibration_error([0.75] * 4, [True, True, True, False]) == pytest.approx(0.0)
    assert calibration_error([0.95, 0.05], [False, True]) == pytest.approx(0.95)
    assert np.isnan(calibration_error([], []))


def test_calibration_stands_beside_what_chance_alone_would_show():
    rng = np.random.default_rng(1)
    sure = [0.9] * 50
    exact, floor = calibration_rows("error", sure, [True] * 45 + [False] * 5, at_most=0.03, rng=rng)
    assert exact["value"] == pytest.approx(0.0, abs=1e-12)
    assert exact["met"]
    assert 0.02 < floor["value"] < 0.05
    assert floor["name"] == "error, by chance alone"
    wrong, same_floor = calibration_rows("error", sure, [False] * 50, at_most=0.03, rng=rng)
    assert wrong["value"] == pytest.approx(0.9)
    assert wrong["low"] > same_floor["high"]
    none, _ = calibration_rows("error", [], [], at_most=0.03, rng=rng)
    assert none["value"] is None
    assert none["n"] == 0


def test_a_finding_is_calibrated_by_whether_any_of_its_names_is_true():
    given = report(entry("friction_scale", "force_gain", confidence=1.0))
    result = score({"a": given}, [answer("a", "single", truth("force_gain", kind="artefact"))])
    assert value(result, "calibration error")["value"] == pytest.approx(1.0)
    assert value(result, "calibration error of the findings")["value"] == pytest.approx(0.0)


def test_recovered_share_of_the_oracles_gain():
    a = answer("a", "single", truth("wear"))
    assert recovered({"fy": {"rms_after": 40.0}}, a) == pytest.approx(1.0)
    assert recovered({"fy": {"rms_after": 100.0}}, a) == pytest.approx(0.0)
    assert recovered({"fy": {"rms_after": 1e6}}, a) == -1.0
    assert recovered({}, a) == pytest.approx(0.0), "a force that is not predicted is uncorrected"
    half = np.sqrt((100.0**2 + 40.0**2) / 2.0)
    assert recovered({"fy": {"rms_after": half}}, a) == pytest.approx(0.5)
    from dataclasses import replace

    flat = replace(a, oracle={"fy": {"rms_before": 41.0, "rms_oracle": 40.0}})
    assert recovered({"fy": {"rms_after": 40.0}}, flat) is None


def test_windows_and_regimes_are_scored_for_rightly_named_strong_effects_only():
    answers = [
        answer("hit", "single", truth("wear")),
        answer("wrong", "single", truth("wear")),
        answer("weak", "single", truth("wear", over_noise=0.8)),
    ]
    where = {"normal_load": [3000.0, 4000.0], "speed": [0.0, 1.0]}
    shown = {"when": [[10.0, 15.0]], "where": where}
    reports = {
        "hit": report(entry("wear", **shown)),
        "wrong": report(entry("camber", **shown)),
        "weak": report(entry("wear", **shown)),
    }
    result = score(reports, answers)
    assert value(result, "window IoU")["n"] == 1
    assert value(result, "window IoU")["value"] == pytest.approx(0.5)
    assert value(result, "regime IoU")["n"] == 1
    assert value(result, "regime IoU")["value"] == pytest.approx(0.5)


def test_a_case_without_a_report_stops_the_scoring():
    with pytest.raises(DomainError, match="1 of 1 cases have no report"):
        score({}, [answer("a", "nothing")])


def test_what_the_same_schedule_cannot_separate_is_acceptable_both_ways():
    conicity, camber = AMBIGUOUS_SETS[2], AMBIGUOUS_SETS[3]
    assert set(conicity) == set(camber)


def test_the_first_key_is_scored_beside_the_mended_one():
    answers, reports = [], {}
    for number, alternative in enumerate(("camber_offset", "force_offset")):
        truly = truth("plysteer_conicity")
        answers.append(answer(f"case_{number}", "ambiguous", truly, acceptable=AMBIGUOUS_SETS[2]))
        reports[f"case_{number}"] = report(entry("plysteer_conicity", alternative))
    result = score(reports, answers)
    assert value(result, "ambiguous covered")["value"] == 1.0
    assert value(result, "ambiguous covered, first key")["value"] == 0.5


@pytest.mark.parametrize(
    ("target", "n", "met", "said"),
    [
        (">= 0.95", 1, True, "too few cases"),
        (">= 0.95", 72, True, "too few cases"),
        (">= 0.95", 73, True, "met"),
        ("<= 0.02", 187, False, "too few cases"),
        ("<= 0.02", 189, False, "missed"),
        ("<= 2.0", 80, True, "met"),
        (None, 80, None, ""),
    ],
)
def test_a_goal_needs_cases_enough_to_be_shown(target, n, met, said):
    assert outcome({"target": target, "n": n, "met": met}) == said


@pytest.mark.parametrize(
    ("target", "low", "high", "said"),
    [
        (">= 0.95", 0.246, 0.663, "missed"),
        (">= 0.95", 0.246, 0.96, "too few cases"),
        ("<= 0.02", 0.03, 0.2, "missed"),
        ("<= 0.02", 0.01, 0.2, "too few cases"),
        (">= 0.95", float("nan"), float("nan"), "too few cases"),
    ],
)
def test_a_goal_beyond_the_interval_is_missed_by_few_cases_too(target, low, high, said):
    assert outcome({"target": target, "n": 18, "met": False, "low": low, "high": high}) == said


def test_every_score_has_a_name_in_the_fields_words():
    result = score([], [])
    assert [row["name"] for row in result["scores"] if in_words(row["name"]) == row["name"]] == []
