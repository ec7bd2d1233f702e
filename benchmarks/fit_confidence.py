"""Fit how sure a name is (src/tire_pipeline/mismatch/proof/calibration.json) to the cases of spent proofs.

Run: python benchmarks/fit_confidence.py [--seeds 20261129 20261130 20261131] [--write]

About ten minutes a seed on two cores. Only seeds whose proof is published may be used: a name counts as right
as in the proof, if the case conceals it or cannot tell it from what it conceals.
"""

from __future__ import annotations

import argparse
import json
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np
from threadpoolctl import threadpool_limits

import tire_pipeline.mismatch.explain as explaining
from tire_pipeline.concealed import case_plan, make_case
from tire_pipeline.concealed.measures import calibration_error
from tire_pipeline.mismatch.proof.confidence import calibrate, confidence, features

FILE = Path(explaining.__file__).parent / "proof" / "calibration.json"
SEEDS = (20261129, 20261130, 20261131)
CASES = 400
Row = tuple[dict[str, float], bool, float]


def rows_of(planned: tuple[int, str]) -> list[Row]:
    """Evidence of each effect that is named in a case, whether it is right, and its confidence so far."""
    case, answer = make_case(*planned)
    rows: list[Row] = []

    def noted(search: Any, index: int, near: list[Any], left: Any) -> float:
        sure = confidence(search, index, near, left)
        name = search.fit.names[index]
        rows.append((features(search, index, near, left), name in answer.right_names, sure))
        return sure

    with patch.object(explaining, "confidence", noted), threadpool_limits(1):
        explaining.explain_mismatch(case.tire, case.recording)
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, nargs="+", default=SEEDS)
    parser.add_argument("--write", action="store_true")
    asked = parser.parse_args()
    plan = [planned for seed in asked.seeds for planned in case_plan(CASES, seed)]
    with ProcessPoolExecutor(2) as pool:
        rows = [row for some in pool.map(rows_of, plan) for row in some]
    evidence, correct, sure = zip(*rows, strict=True)
    print(
        f"{len(rows)} named effects, {np.mean(correct):.3f} right, said {np.mean(sure):.3f}, "
        f"calibration error {calibration_error(list(sure), list(correct)):.3f}"
    )
    seeds = ", ".join(map(str, asked.seeds))
    table = calibrate(evidence, correct, f"the {CASES} cases of each of the spent proofs {seeds}")
    text = json.dumps(table, indent=1) + "\n"
    print(text)
    if asked.write:
        FILE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
