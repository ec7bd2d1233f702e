"""The baselines: same form of report, and what they can and cannot do."""

import json
from functools import cache

import numpy as np
import pytest

from tire_pipeline.concealed import held_out_errors, make_case
from tire_pipeline.concealed.baselines import BASELINES
from tire_pipeline.concealed.baselines.regressors import make_groups
from tire_pipeline.concealed.cases.clean_run import residual


def case_with(name: str, kind: str, over_noise: float):
    for seed in range(300):
        from tire_pipeline.concealed.cases.drawn_effects import choose
        from tire_pipeline.concealed.effect_names import CASE_KINDS

        root = np.random.SeedSequence([seed, CASE_KINDS.index(kind)])
        rng = np.random.default_rng(root.spawn(61)[0])
        if choose(rng, kind).effects == (name,):
            case, answer = make_case(seed, kind)
            if answer.effects[0].over_noise > over_noise:
                return case, answer
    raise AssertionError(f"no {kind} case with {name} in 300 seeds")


@pytest.fixture(scope="module")
def pressure():
    return case_with("inflation_pressure", "single", 1.5)


@pytest.fixture(scope="module")
def answered(pressure):
    """What a baseline says of the case, made once for each; a whole formula is fitted to every tenth row."""
    case, _ = pressure
    rows = {"refitted_formula": case.recording.iloc[::10]}
    return cache(lambda name: BASELINES[name](case.tire, rows.get(name, case.recording)))


@pytest.mark.parametrize("name", list(BASELINES))
def test_reports_have_the_form_that_the_scorer_reads(name, pressure, answered):
    case, _ = pressure
    report = answered(name)
    data = json.loads(json.dumps(report.to_dict()))
    assert set(data) == {"verdict", "effects", "fit", "next_experiment"}
    for effect in data["effects"]:
        assert effect["kind"] in ("physics", "artefact")
        assert 0.0 <= effect["confidence"] <= 1.0
        assert all(low <= high for low, high in effect["when"])
    assert list(report.predict(case.held_out).columns) == ["fx", "fy"]


def test_stepwise_and_sindy_find_a_strong_pressure_effect(answered):
    for name in ("bic_stepwise", "pysindy"):
        effects = answered(name).to_dict()["effects"]
        assert "inflation_pressure" in [e["name"] for e in effects]


def test_a_gaussian_process_improves_unseen_data_and_names_nothing(pressure, answered):
    case, _ = pressure
    report = answered("gaussian_process")
    assert report.effects == []
    errors = held_out_errors(case, report.predict)
    assert errors["fy"]["rms_after"] < 0.9 * errors["fy"]["rms_before"]


def test_plain_stepwise_names_false_physics_where_nothing_is_missing():
    from tire_pipeline.concealed.effect_names import PHYSICS

    wrong = 0
    for seed in range(6):
        case, _ = make_case(seed, "nothing")
        effects = BASELINES["bic_stepwise"](case.tire, case.recording).effects
        wrong += any(e["name"] in PHYSICS for e in effects)
    assert wrong >= 3, "unguarded selection takes the model's misfit for physics"


def test_held_out_errors_see_no_forces_and_count_what_is_missing(pressure):
    case, _ = pressure
    seen = []

    def predict(frame):
        seen.extend(frame.columns)
        return frame.assign(fy=case.held_out["fy"])[["fy"]]

    errors = held_out_errors(case, predict)
    assert "fy" not in seen
    assert "fx" not in seen
    assert errors["fy"]["rms_after"] == 0.0
    assert errors["fx"]["rms_after"] == errors["fx"]["rms_before"]


@pytest.mark.parametrize("channel", ["slip_angle", "camber"])
def test_a_regressor_is_what_its_effect_adds(pressure, channel):
    """At two degrees of camber, as the formula has a kink at none."""
    case, _ = pressure
    leaned = case.recording["camber"] + np.radians(2.0)
    frame = case.recording.assign(camber=leaned, fx=0.0, fy=0.0)
    groups = make_groups(case.tire, frame)
    shifted = frame.assign(**{channel: frame[channel] + 1e-4})
    change = -(residual(case.tire, shifted) - residual(case.tire, frame)) / 1e-4
    column = groups[f"{channel}_offset"][:, :, 0]
    np.testing.assert_allclose(column, change, atol=0.02 * np.abs(change).max())
