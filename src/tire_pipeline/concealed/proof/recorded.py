"""The half of the proof from real recordings: cases -> explanations -> scores, as the simulated half."""

from __future__ import annotations

from collections import Counter
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import Any

import pandas as pd

from tire_pipeline.code_hash import code_hash
from tire_pipeline.concealed import unseal
from tire_pipeline.concealed.proof import case_files as files
from tire_pipeline.concealed.proof.simulated import (
    METHOD,
    ProveConcealedParameters,
    answers_of,
    explain_cases,
    explained_by,
    part_cases,
)
from tire_pipeline.concealed.real import RealAnswer, real_plan
from tire_pipeline.concealed.real.published import published
from tire_pipeline.concealed.real.score_sets import score_real
from tire_pipeline.concealed.real.sources import available, development_list, fingerprint
from tire_pipeline.files.read_later import FilesToMake, StoredFiles
from tire_pipeline.tasks import Labelled


def real_cases_to_make(parameters: ProveConcealedParameters) -> FilesToMake:
    """Make the cases from the sealed sweeps; none if the recordings are not available."""
    real = parameters.real
    folder = Path(real.recordings)
    if not available(folder):
        return {}
    code = f"{code_hash('concealed', 'magic_formula', 'recordings')}-{fingerprint(folder)}"
    return {
        f"{code}/{plan.seed:010d}_{plan.source}-{plan.kind}.zip": Labelled(
            f"case {plan.seed}", partial(files.made_real_case, plan, folder)
        )
        for plan in real_plan(real.cases, real.seed)
    }


def part_real_cases(made: StoredFiles) -> tuple[FilesToMake, FilesToMake, dict[str, Any]]:
    """Separate what is shown, what is held out, and the answers, which are sealed by a hash."""
    return part_cases(made, RealAnswer)


def explain_real_cases(shown: StoredFiles) -> FilesToMake:
    """Explain every case from real recordings; neither answers nor held-out forces are available here."""
    return explain_cases(shown)


def explain_real_by_baselines(shown: StoredFiles, parameters: ProveConcealedParameters) -> FilesToMake:
    """The same cases by the baselines."""
    return explained_by(shown, parameters.real.baselines)


def score_real_proof(
    explained: StoredFiles,
    by_baselines: StoredFiles,
    held_out: StoredFiles,
    sealed: dict[str, Any],
    parameters: ProveConcealedParameters,
) -> tuple[pd.DataFrame, pd.DataFrame, dict[str, Any]]:
    """Score all methods against the sealed answers, beside one that knows them and one that says nothing.

    Returns
    -------
    scores : DataFrame
        ``method, source, name, value, low, high, n, target, met``; the published ones where there are no
        recordings.
    misses : DataFrame
        Every case that ``explain_mismatch`` did not answer correctly, and why.
    details : dict
        What the proof was made with, and scores by strength and by effect.
    """
    answers = unseal(sealed["answers"].encode(), sealed["sha256"], RealAnswer)
    if not answers:
        scores, made = published()
        return scores, pd.DataFrame(columns=["case"]), {"made": made, "published": True}
    methods = {**dict(answers_of(explained, by_baselines, held_out)), **oracle_and_floor(answers)}
    tables, details, misses = [], {}, pd.DataFrame(columns=["case"])
    for method, (reports, errors) in methods.items():
        result = score_real(reports, answers, held_out=errors)
        tables.append(pd.DataFrame(result["scores"]).assign(method=method))
        if method == METHOD:
            details = {key: result[key] for key in ("n", "by_strength", "by_effect")}
            misses = pd.DataFrame(result["misses"]) if result["misses"] else misses
    scores = pd.concat(tables, ignore_index=True)
    scores = scores[["method", *[c for c in scores.columns if c != "method"]]]
    return scores, misses, {**details, "published": False, "made": _made_with(answers, sealed, parameters)}


def oracle_and_floor(answers: list[RealAnswer]) -> dict[str, tuple[dict[str, Any], dict[str, Any]]]:
    """Return what knows the answers (oracle) and what never says anything (floor), scored as the others.

    Parameters
    ----------
    answers : list of RealAnswer

    Returns
    -------
    dict of str to (reports, errors)
        By name; reports and held-out errors by case.
    """
    silent = {a.case_id: {"verdict": "agrees", "effects": []} for a in answers}
    right = {
        a.case_id: {
            "verdict": "explained",
            "effects": [
                {"name": e.name, "alternatives": [], "confidence": 1.0}
                for e in a.effects
                if a.kind != "unknown"
            ],
        }
        for a in answers
    }

    def errors(after: str) -> dict[str, Any]:
        return {
            a.case_id: {
                force: {"rms_before": e["rms_before"], "rms_after": e[after]} for force, e in a.oracle.items()
            }
            for a in answers
        }

    return {"oracle": (right, errors("rms_oracle")), "floor": (silent, errors("rms_before"))}


def _made_with(
    answers: list[RealAnswer], sealed: dict[str, Any], parameters: ProveConcealedParameters
) -> dict[str, Any]:
    return {
        "seed": parameters.real.seed,
        "cases": len(answers),
        "by_source": dict(sorted(Counter(a.source for a in answers).items())),
        "code": code_hash("mismatch", "magic_formula", "tir"),
        "cases_code": code_hash("concealed", "magic_formula", "recordings"),
        "date": datetime.now(UTC).date().isoformat(),
        "sha256": sealed["sha256"],
        "sealed_sweeps": len({sweep for a in answers for sweep in (*a.fit, *a.shown, *a.held_out)}),
        "development_sweeps": len(development_list()),
    }
