"""Cases of spent proofs and of tuning that were answered wrongly once: how many are right now.

``spent_cases.csv`` holds seed and kind of each. They were picked because they are hard, so the rates are
lower than those of a proof.
"""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest
from weighed import named_sets

from tire_pipeline.concealed import make_case
from tire_pipeline.concealed.scoring.rows import share_row

CASES = pd.read_csv(Path(__file__).with_name("spent_cases.csv"))


def _rates(cases: pd.DataFrame) -> dict[str, float]:
    """Share of the cases whose sets of names hold the whole truth, and of those without a false set."""
    right, clean, misses = [], [], []
    for seed, kind in cases.itertuples(index=False):
        case, answer = make_case(int(seed), str(kind))
        truth = set() if kind == "unknown" else {effect.name for effect in answer.effects}
        given = named_sets(case.tire, case.recording)
        clean.append(all(names & truth for names in given))
        right.append(clean[-1] and truth <= set().union(*given))
        if not right[-1]:
            misses.append((seed, kind, [sorted(names) for names in given], sorted(truth)))
    for name, hits in (("right", right), ("nothing false", clean)):
        row = share_row(name, hits)
        print(f"{name}: {row['value']:.3f} ({row['low']:.3f} to {row['high']:.3f}) of {row['n']}")
    print(*misses, sep="\n")
    return {"right": sum(right) / len(right), "clean": sum(clean) / len(clean)}


@pytest.mark.long
def test_the_spent_cases_are_mostly_right():
    rates = _rates(CASES)
    assert rates["right"] >= 0.8
    assert rates["clean"] >= 0.8
