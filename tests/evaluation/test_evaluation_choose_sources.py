"""Which files ``evaluate`` translates."""

import pandas as pd

from tire_pipeline.evaluation.all_translators import choose_sources
from tire_pipeline.evaluation.parameters import EvaluateParameters

FLEET = {"hidden/A/one.tir": None, "four/B/two.tir": None}
SPLITS = pd.DataFrame({"file": ["mine/one.tir", "lab/two.tir"], "random": "test", "by_tire": "test"})


def test_evaluation_tires_of_the_fleet_judge_files_of_the_fleet():
    chosen = choose_sources(FLEET, {"A/x.tir": None, "D/y.tir": None}, SPLITS, EvaluateParameters(), "D")
    assert chosen == {"folder": "evaluation", "files": list(FLEET)}


def test_beside_own_files_they_do_not_count():
    chosen = choose_sources(
        FLEET, {file: None for file in SPLITS["file"]}, SPLITS, EvaluateParameters(), "lab"
    )
    assert chosen == {"folder": "tir", "files": ["mine/one.tir"]}
