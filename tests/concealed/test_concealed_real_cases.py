"""Cases from real recordings: which sweeps they are made from, and what is put into them."""

import os
from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.concealed import seal, unseal
from tire_pipeline.concealed.real import RealAnswer, make_real_case, real_plan
from tire_pipeline.concealed.real.plan import EFFECTS, HIDEABLE, SOURCE_KINDS, SOURCE_SHARES
from tire_pipeline.concealed.real.put_in import (
    INSERTED_EFFECTS,
    Details,
    RecordedSession,
    friction_work,
    put_in,
    way_rolled_by,
)
from tire_pipeline.concealed.real.sources import SOURCES, development_list, pool, sweeps
from tire_pipeline.magic_formula import TireModel

RECORDINGS = Path(__file__).resolve().parents[3] / "shared" / "recordings"


@pytest.fixture
def recordings() -> Path:
    if not RECORDINGS.exists() and not os.environ.get("CI"):
        pytest.skip(f"{RECORDINGS} is not there")
    return RECORDINGS


def test_the_plan_has_enough_with_nothing_and_little_from_tydex():
    plans = real_plan(400, 20261124)
    assert len({p.seed for p in plans}) == 400
    assert sum(p.kind == "nothing" for p in plans) >= 100
    assert sum(p.source == "tydex" for p in plans) <= 0.15 * 400
    assert {p.source for p in plans} == set(SOURCES)
    assert plans == real_plan(400, 20261124)
    assert plans != real_plan(400, 20261125)
    assert sum(SOURCE_SHARES.values()) == pytest.approx(1.0)
    for source, kinds in SOURCE_KINDS.items():
        assert sum(kinds.values()) == pytest.approx(1.0), source


def test_every_mechanism_is_drawn_from_some_source():
    drawn = {name for table in EFFECTS.values() for names in table.values() for name in names}
    assert drawn | {"quantisation"} == set(INSERTED_EFFECTS)
    assert {name for sets in HIDEABLE.values() for names in sets for name in names} <= {
        "camber",
        "inflation_pressure",
        "load_sensitivity",
    }


def test_every_listed_sweep_exists_and_is_never_sealed(recordings):
    """A list that no longer matches the recordings would seal what thresholds were set with."""
    found = {s.sha256 for source in SOURCES for s in sweeps(recordings, source)}
    assert set(development_list()) <= found
    for source in SOURCES:
        here = {s.sha256 for s in pool(recordings, source, "sealed")}
        assert here
        assert not here & set(development_list())
        assert len(here) + len(pool(recordings, source, "development")) == len(sweeps(recordings, source))


@pytest.mark.parametrize(
    ("source", "count"),
    [
        pytest.param(source, count, marks=() if (source, count) == ("tydex", 4) else pytest.mark.long)
        for source, count in product(SOURCES, (4, 12))
    ],
)
def test_a_case_shows_and_holds_out_different_sweeps_of_its_pool(recordings, source, count):
    allowed = {s.sha256 for s in pool(recordings, source, "sealed")}
    for plan in real_plan(count, 3, source=source):
        case, answer = make_real_case(plan, recordings)
        assert not set(answer.shown) & set(answer.held_out)
        assert {*answer.fit, *answer.shown, *answer.held_out} <= allowed
        assert (answer.kind == "nothing") == (not answer.effects)
        assert all(e.over_misfit >= 0.5 for e in answer.effects)
        assert "piece" not in case.recording
        if "time" in case.recording:
            assert np.all(np.diff(case.recording["time"]) > 0.0)
            assert np.all(np.diff(case.held_out["time"]) > 0.0)
        again, same = make_real_case(plan, recordings)
        pd.testing.assert_frame_equal(case.recording, again.recording)
        assert answer.to_dict() == same.to_dict()


def test_real_answers_survive_sealing(recordings):
    answers = [make_real_case(plan, recordings)[1] for plan in real_plan(3, 5, source="tydex")]
    data, sha256 = seal(answers)
    back = unseal(data, sha256, RealAnswer)
    assert {a.case_id: a.to_dict() for a in back} == {a.case_id: a.to_dict() for a in answers}


@pytest.fixture
def tire() -> TireModel:
    return TireModel.from_coefficients(
        {"FNOMIN": 2000.0, "UNLOADED_RADIUS": 0.2, "PCY1": 1.4, "PDY1": 1.5, "PKY1": -40.0, "PKY2": 2.0},
        version="5.2",
    )


@pytest.fixture
def run(tire) -> tuple[pd.DataFrame, RecordedSession]:
    time = np.arange(0.0, 20.0, 0.01)
    frame = pd.DataFrame(
        {
            "time": time,
            "slip_angle": 0.15 * np.sin(0.9 * time),
            "normal_load": 2000.0 + 300.0 * np.sin(0.13 * time),
            "camber": 0.02,
            "speed": 11.0 + np.sin(0.2 * time),
            "tread_temperature": 60.0 + time,
            "piece": np.repeat([0, 1], 1000),
        }
    )
    frame["fy"] = tire.forces(
        slip_angle=frame["slip_angle"].to_numpy(), normal_load=frame["normal_load"].to_numpy()
    ).fy
    return frame, RecordedSession(tire, 0.0, 20.0, 2000.0, 11.0, 65.0, 3e4, 3500.0, -1.0, 0.2)


PLAIN = Details(1.0, "fy", 2.0, 12.0, (4.0, 6.0), 0.3)


def forces(tire: TireModel, frame: pd.DataFrame) -> np.ndarray:
    return tire.forces(
        slip_angle=frame["slip_angle"].to_numpy(), normal_load=frame["normal_load"].to_numpy()
    ).fy


@pytest.mark.parametrize("name", list(INSERTED_EFFECTS))
def test_a_mechanism_of_strength_near_nothing_changes_nothing(run, name):
    frame, session = run
    inserted = INSERTED_EFFECTS[name]
    if not inserted.scaled:
        return
    tiny = 1e-7 * (session.largest if inserted.share_of == "force" else 1.0)
    out = put_in(frame, {name: tiny}, session, {name: PLAIN})
    for channel in ("slip_angle", "fy", "camber"):
        scale = float(frame[channel].abs().max())
        np.testing.assert_allclose(out[channel], frame[channel], atol=1e-3 * scale)


@pytest.mark.parametrize(("name", "scaling"), [("friction_scale", "LMUY"), ("stiffness_scale", "LKY")])
def test_similarity_is_what_the_scaling_factors_of_the_formula_do(run, tire, name, scaling):
    """A recording of another friction made without any formula is that of the formula with the factor."""
    frame, session = run
    out = put_in(frame, {name: 0.2}, session, {name: PLAIN})
    expected = forces(tire.replace(**{scaling: 1.2}), out)
    np.testing.assert_allclose(out["fy"], expected, atol=0.01 * session.largest)
    assert np.abs(forces(tire, out) - expected).max() > 0.03 * session.largest


@pytest.mark.parametrize(
    ("name", "strength", "channel", "expected"),
    [
        ("force_offset", 50.0, "fy", lambda f: f["fy"] + 50.0),
        ("force_gain", 0.1, "fy", lambda f: 1.1 * f["fy"]),
        ("slip_angle_offset", 0.01, "slip_angle", lambda f: f["slip_angle"] + 0.01),
        ("camber_offset", 0.01, "camber", lambda f: f["camber"] + 0.01),
        ("crosstalk", 0.05, "fy", lambda f: f["fy"] + 0.05 * f["normal_load"]),
        ("sensor_drift", 80.0, "fy", lambda f: f["fy"] + 4.0 * f["time"]),
        ("clipping", 0.2, "fy", lambda f: f["fy"].clip(-2800.0, 2800.0)),
        ("quantisation", 100.0, "fy", lambda f: 100.0 * np.round(f["fy"] / 100.0)),
        ("sign_convention", 1.0, "fy", lambda f: -f["fy"]),
        ("unit_error", 1.0, "fy", lambda f: 2.0 * f["fy"]),
        ("compliance", 0.01, "slip_angle", lambda f: f["slip_angle"] - 0.01 * f["fy"] / 3500.0),
    ],
)
def test_artefacts_do_what_they_say_to_their_channel_only(run, name, strength, channel, expected):
    frame, session = run
    out = put_in(frame, {name: strength}, session, {name: PLAIN})
    np.testing.assert_allclose(out[channel], expected(frame))
    others = [c for c in frame if c != channel]
    pd.testing.assert_frame_equal(out[others], frame[others])


def test_lags_begin_anew_with_every_sweep(run):
    frame, session = run
    for name in ("time_delay", "low_pass", "relaxation_length"):
        out = put_in(frame, {name: 0.3}, session, {name: PLAIN})
        for first in (0, 1000):
            assert out["fy"].iloc[first] == pytest.approx(frame["fy"].iloc[first])
        assert np.abs(out["fy"] - frame["fy"]).max() > 50.0


def test_a_sweep_that_is_held_out_has_the_wear_of_its_recording(run):
    """It had a new tire's, beside other sweeps of the same minutes."""
    frame, session = run
    shown, held = frame[frame["piece"] == 0], frame[frame["piece"] == 1]
    session = replace(session, done=(shown["time"].to_numpy(), friction_work(shown)))
    worn = put_in(frame, {"wear": -0.1}, session, {"wear": PLAIN})
    by_itself = put_in(held, {"wear": -0.1}, session, {"wear": PLAIN})
    np.testing.assert_allclose(by_itself["fy"], worn["fy"][held.index], rtol=1e-3)


def test_a_wheel_rolls_on_in_a_sweep_that_is_held_out(run):
    """Its angle began anew, so that whoever carried the wave on was wrong: 1.84 times the error."""
    frame, session = run
    shown, held = frame[frame["piece"] == 0], frame[frame["piece"] == 1]
    session = replace(session, rolled=(shown["time"].to_numpy(), way_rolled_by(shown)))
    whole = put_in(frame, {"nonuniformity": 0.01}, session, {"nonuniformity": PLAIN})
    by_itself = put_in(held, {"nonuniformity": 0.01}, session, {"nonuniformity": PLAIN})
    np.testing.assert_allclose(by_itself["fy"], whole["fy"][held.index], atol=1.0)
    assert np.abs(whole["fy"] - frame["fy"])[held.index].max() > 100.0


def test_a_lag_in_distance_is_shorter_at_speed(run):
    frame, session = run
    sizes = []
    for speed in (5.0, 20.0):
        out = put_in(
            frame.assign(speed=speed), {"relaxation_length": 0.4}, session, {"relaxation_length": PLAIN}
        )
        sizes.append(np.std(out["fy"] - frame["fy"]))
    assert sizes[1] < 0.4 * sizes[0]


def test_friction_changes_from_a_moment_on_and_with_work(run):
    frame, session = run
    out = put_in(frame, {"surface_change": 0.1}, session, {"surface_change": PLAIN})
    after = (frame["time"] >= 12.0).to_numpy()
    np.testing.assert_allclose(out["fy"][after], 1.1 * frame["fy"][after])
    np.testing.assert_array_equal(out["fy"][~after], frame["fy"][~after])
    worn = put_in(frame, {"wear": -0.1}, session, {"wear": PLAIN})
    moving = frame["fy"].abs().to_numpy() > 100.0
    factor = (worn["fy"] / frame["fy"]).to_numpy()[moving]
    assert np.all(np.diff(factor) <= 1e-12), "work is never undone"
