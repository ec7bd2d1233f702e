"""The open-world half: a case comes back the same, and the judge counts what is right."""

import json
import subprocess
from collections import Counter

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.concealed.open_world.tuning import MECHANISMS
from tire_pipeline.concealed.open_world.world import Nominal
from tire_pipeline.concealed.unnamed import __main__ as trial
from tire_pipeline.concealed.unnamed.cases import CATALOGUE_NAMES, draw_open_case
from tire_pipeline.concealed.unnamed.judge import drivers_right, equation_right, moment_removed, removed
from tire_pipeline.mismatch.unnamed_physics.found import Alternative, UnnamedPhysics, UnnamedReport
from tire_pipeline.mismatch.unnamed_physics.language.symbols import NominalValues

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


def test_the_moment_is_judged_by_what_its_true_change_removes():
    case = draw_open_case(5, (BY_NAME["offset drive"],), strength=6.0, rows=1500)
    inputs = {c: case.held_out[c].to_numpy() for c in ("slip_angle", "slip_ratio", "camber", "normal_load")}
    plain = case.tire.forces(**inputs, limits="ignore", outputs=("mz",)).mz
    true = (case.held_with - case.held_without)[:, 2]
    halfway = pd.DataFrame({"mz": plain + 0.5 * true})
    assert moment_removed(case, pd.DataFrame({"mz": plain + true})) == (pytest.approx(1.0), False)
    assert 0.5 < moment_removed(case, halfway)[0] < 1.0
    assert moment_removed(case, pd.DataFrame({"mz": plain - true}))[1]
    assert np.isnan(moment_removed(case, pd.DataFrame({"fy": plain}))[0])


def test_the_true_equation_of_a_moment_counts():
    found = report("0.04*R0*fx*(fy/F0)", output="mz")
    assert equation_right(found, BY_NAME["offset drive"], Nominal())
    assert not equation_right(report("0.04*R0*fx", output="mz"), BY_NAME["offset drive"], Nominal())


def test_a_plan_of_400_has_every_mechanism_alone_in_twos_and_beside_named_causes():
    planned = [trial.planned("tuning", number) for number in range(400)]
    kinds = Counter((len(mechanisms), len(beside)) for mechanisms, beside in planned)
    assert {kind: round(count / 400, 1) for kind, count in kinds.items()} == {
        (1, 0): 0.5,
        (2, 0): 0.2,
        (1, 1): 0.2,
    }
    for kind in kinds:
        held = Counter(m.name for ms, beside in planned for m in ms if (len(ms), len(beside)) == kind)
        assert set(held) == set(BY_NAME)
    assert {cause for _, beside in planned for cause in beside} == set(CATALOGUE_NAMES)
    assert all(len({m.name for m in mechanisms}) == len(mechanisms) for mechanisms, _ in planned)


def test_the_oracle_takes_away_a_named_cause_too():
    case = draw_open_case(5, (BY_NAME["drum runout"],), ("force offset",), 3.0, rows=1500)
    named = case.held_with - case.held_without - case.added[0].change[1500:]
    assert np.ptp(named, axis=0) == pytest.approx(0.0, abs=1e-9)  # an offset is the same in every row
    assert list(np.abs(named[0]) > 1.0) == [False, True, False]


def test_a_run_goes_on_where_it_was_and_its_table_is_committed(tmp_path, monkeypatch):
    asked = []
    row = {"mechanism": "m", "beside": "", "strength": 2.0, "verdict": "agrees", "names": "", "equation": ""}
    row |= {
        "false_name": False,
        "drivers": "",
        "true_drivers": "",
        "drivers_right": False,
        "in_grammar": True,
    }
    row |= {"driver_shared": False, "equation_right": False, "removed": 0.5, "worse": False}
    row |= {"oracle_worse": False, "removed_moment": None, "worse_moment": False, "seconds": 1.0}
    for name in trial.ON_RESIDUAL:
        row |= {f"removed_{name}": 0.1, f"worse_{name}": False}
    monkeypatch.setattr(trial, "run", lambda half, number: asked.append(number) or {"case": number, **row})
    page = tmp_path / "docs" / "history" / "proofs.md"
    page.parent.mkdir(parents=True)
    (tmp_path / "benchmarks" / "results").mkdir(parents=True)
    page.write_text("a\n<!-- unnamed tuning, from concealed.unnamed -->\nold\n<!-- end -->\nb\n", "utf-8")
    git = ["git", "-C", str(tmp_path)]
    for words in (["init", "-q"], ["config", "user.email", "a@b.c"], ["config", "user.name", "a"]):
        subprocess.run([*git, *words], check=True)
    common = ["--folder", str(tmp_path / "rows"), "--write", str(tmp_path), "--commit"]
    trial.main(["tuning", "--cases", "2", *common])
    trial.main(["tuning", "--cases", "3", *common])
    assert asked == [0, 1, 2]
    log = subprocess.run([*git, "log", "--format=%s"], check=True, capture_output=True, text=True).stdout
    assert [line.split(",")[1].strip() for line in log.splitlines()] == ["3 cases", "2 cases"]
    text = page.read_text("utf-8")
    assert "| an equation was kept | 0.00 | 3 |" in text
    assert "old" not in text
    assert text.startswith("a\n")
    assert text.endswith("b\n")
    assert [json.loads(f.read_text())["case"] for f in sorted(tmp_path.glob("rows/*/*/*.json"))] == [0, 1, 2]
