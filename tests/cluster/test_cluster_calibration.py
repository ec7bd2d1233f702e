"""Learning the sizes of the posterior: the same to the last bit wherever the cases are weighed."""

from __future__ import annotations

import pickle
import sys
from functools import partial
from pathlib import Path

import pandas as pd
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "mismatch"))
from small_rig import COEFFICIENTS, rig_force, schedule

from tire_pipeline.calibration import learning
from tire_pipeline.calibration.cases import KnownCase
from tire_pipeline.calibration.learning import CalibrateMismatchParameters, learn_sizes, reduced, weigh_cases
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.tasks import in_processes, in_turn


def _recording(tire: TireModel, friction: float) -> pd.DataFrame:
    time, slip_angle, load, pressure = schedule(seconds=60.0, rate=10.0)
    channels = {"time": time, "slip_angle": slip_angle, "normal_load": load, "speed": 16.7}
    return pd.DataFrame({**channels, "pressure": pressure, "fy": rig_force(tire, slip_angle, load, friction)})


@pytest.fixture(scope="module")
def stored():
    """Of two cases of two sources: what is stored of their sets, and of the evidence of these."""
    tire = TireModel.from_coefficients(COEFFICIENTS, version="5.2")
    cases = {}
    for number, (source, friction) in enumerate([("first", 1.0), ("second", 1.2)]):
        effects = () if friction == 1.0 else (("friction_scale", 3.0),)
        known = KnownCase(source, "single", tire, _recording(tire, friction), effects)
        cases[f"{number}.pkl"] = partial(bytes, pickle.dumps(reduced(known)))
    weighed = weigh_cases(cases, CalibrateMismatchParameters())
    return cases, {name: partial(bytes, weigh()) for name, weigh in weighed.items()}


@pytest.mark.parametrize("where", ["processes", "cluster"])
def test_sizes_are_learnt_by_the_runs_workers_and_the_same_to_the_last_bit(
    stored, where, request, monkeypatch
):
    """One case a task, so that more than one worker has one."""
    other = in_processes(2) if where == "processes" else request.getfixturevalue("work")
    asked = []

    def noted(tasks, what):
        asked.append(len(tasks))
        return other(tasks, what)

    made, scores = learn_sizes(*stored, CalibrateMismatchParameters(), work=in_turn)
    monkeypatch.setattr(learning, "CASES_A_TASK", 1)
    made_there, scores_there = learn_sizes(*stored, CalibrateMismatchParameters(), work=noted)
    assert max(asked) == 2
    assert made_there["sizes"] == made["sizes"]
    assert made_there["provenance"]["log_score"] == made["provenance"]["log_score"]
    assert made_there["provenance"]["curvature"] == made["provenance"]["curvature"]
    pd.testing.assert_frame_equal(scores_there, scores, check_exact=True)
    assert sorted(scores["source"]) == ["first", "second"]
