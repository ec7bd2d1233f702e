"""What a run says of own files that nothing can judge."""

from __future__ import annotations

import pandas as pd

from tire_pipeline.evaluation.all_translators import NO_CHANGE, UNJUDGED
from tire_pipeline.reporting.evaluation.evaluation_outcome import say_outcome

BEST = {"name": "mixed model", "tires": 0}
NOT_JUDGED = pd.DataFrame(columns=["set", "metric", "translator", "rms"])


def _said(verdicts: list[str]) -> str:
    own = pd.DataFrame({"set": UNJUDGED, "translator": BEST["name"], "verdict": verdicts})
    own["expected_rms_ratio"] = [0.2 if verdict == "translated" else float("nan") for verdict in verdicts]
    before = own.assign(translator=NO_CHANGE, verdict="", expected_rms_ratio=float("nan"))
    table = pd.concat([before, own], ignore_index=True)
    return say_outcome(table.assign(tire=table.index.astype(str)), NOT_JUDGED, BEST, "own_lab")[0]


def test_none_translated_says_what_became_of_each():
    said = _said(["already unbiased", "refused", "already unbiased"])
    assert said.startswith(
        "Of your files in the test split (3), none was translated (2 already unbiased, 1 refused)."
    )
    assert "`kedro run --pipeline translate`, with the same --params, translates all of your files." in said
    assert "estimate" not in said


def test_some_translated_says_how_many_and_the_estimate():
    said = _said(["translated", "refused"])
    assert said.startswith(
        "Of your files in the test split (2), 1 was translated to own_lab by the mixed model"
    )
    assert "shrink to 20%" in said
