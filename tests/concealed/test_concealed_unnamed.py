"""The open-world half: a case comes back the same, and the judge counts what is right."""

import numpy as np
import pytest

from tire_pipeline.concealed.open_world.tuning import MECHANISMS
from tire_pipeline.concealed.open_world.world import Nominal
from tire_pipeline.concealed.unnamed.cases import draw_open_case
from tire_pipeline.concealed.unnamed.judge import drivers_right, equation_right, removed
from tire_pipeline.mismatch.unnamed_physics.found import Alternative, UnnamedPhysics, UnnamedReport
from tire_pipeline.mismatch.unnamed_physics.symbols import NominalValues

OWN = NominalValues(F0=4200.0, R0=0.3, V0=15.0, P0=2.3e5, T0=45.0)
BY_NAME = {m.name: m for m in MECHANISMS}


def report(*texts, output="fy"):
    first, *others = [{output: text} for text in texts]
    return UnnamedReport(
        UnnamedPhysics(first, (), "", {}, OWN), alternatives=[Alternative(e, (), 1.0) for e in others]
    )


def test_a_case_comes_back_the_same_and_holds_what_was_put_in():
    chosen = (BY_NAME["drum runout"],)
    one, again = (draw_open_case(5, chosen, strength=3.0, rows=1500) for _ in range(2))
    assert one.recording.equals(again.recording)
    assert one.added[0].strength == pytest.approx(3.0, rel=0.01)
    assert len(one.held_out) == 375
    assert np.any(one.held_with != one.held_without)
    assert one.held_out["time"].iloc[0] > one.recording["time"].iloc[-1]


@pytest.mark.parametrize(
    ("name", "text", "right"),
    [
        ("edge lift", "(-53)*fy*(g^2)*(L)", True),
        ("edge lift", "(-53)*fy*(L)*(g)*(g)", True),
        ("edge lift", "(-53)*fy*(g^2)", False),
        ("edge lift", "(-53)*fy*(g^2)*(L) + 0.3*fy", False),
        ("edge lift", "2*fy*lag(L, 0.1)*g^2", False),
        ("soft when hot and loaded", "0.1*fy*h*L", True),
        ("soft when hot and loaded", "0.1*fy*h", False),
        ("bushing hysteresis", "0.1*fy_slip*(play(fy/(F0*L), 0.4) - fy/(F0*L))", False),
    ],
)
def test_an_equation_is_right_if_it_is_the_true_one_but_for_its_size(name, text, right):
    nominal = Nominal(load=4000.0, speed=18.0, temperature=45.0)
    assert equation_right(report(text), BY_NAME[name], nominal) is right


def test_the_first_three_equations_count_and_the_fourth_does_not():
    wrong, true = "fy*g", "fy*g^2*L"
    nominal = Nominal()
    assert equation_right(report(wrong, wrong, true), BY_NAME["edge lift"], nominal)
    assert not equation_right(report(wrong, wrong, wrong, true), BY_NAME["edge lift"], nominal)


def test_drivers_are_right_only_if_none_is_missing_and_none_too_many():
    assert drivers_right(("speed", "camber"), ("camber", "speed"), {}) == (True, True)
    assert drivers_right(("speed",), ("camber", "speed"), {}) == (False, True)
    assert drivers_right(("speed", "camber"), ("camber",), {}) == (False, True)
    assert drivers_right((), ("camber",), {}) == (False, False)
    together = {"speed": "speed", "tread_temperature": "speed"}
    assert drivers_right(("tread_temperature",), ("speed",), together) == (True, True)


def test_removed_is_a_share_of_what_the_oracle_removes():
    before = {"fx": 4.0, "fy": 4.0}
    assert removed(before, {"fx": 4.0, "fy": 2.5}, {"fx": 4.0, "fy": 1.0})[0] == pytest.approx(0.5)
    assert removed(before, {"fx": 4.0, "fy": 5.5}, {"fx": 4.0, "fy": 1.0})[0] == pytest.approx(-0.5)
    assert np.isnan(removed(before, before, {"fx": 4.0, "fy": 3.9})[0])
