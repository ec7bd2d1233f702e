"""Nodes: what each tuning case says, sizes learnt from all of it, and each source judged without itself."""

from __future__ import annotations

import pickle
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from joblib import Parallel, delayed
from pydantic import Field

from tire_pipeline.calibration.cases import KnownCase, plans
from tire_pipeline.code_hash import code_hash
from tire_pipeline.errors import TirePipelineError
from tire_pipeline.mismatch.inference.analysis import analyse
from tire_pipeline.mismatch.inference.learn_sizes import START, Tuning, learn, log_scores, pruned
from tire_pipeline.mismatch.inference.learnt.sizes import LearntSizes
from tire_pipeline.mismatch.inference.sets.answer import answered
from tire_pipeline.mismatch.inference.sets.enumerate import enumerate_sets
from tire_pipeline.mismatch.inference.thinning import thinned
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.parameters import Parameters

Work = dict[str, Callable[[], bytes]]
Folder = Mapping[str, Callable[[], bytes]]
_NOTHING = pickle.dumps(None)
"""Of a case that stops before the sets are weighed, or cannot be made."""


class CalibrateMismatchParameters(Parameters):
    """What the posterior learns from.

    Parameters
    ----------
    recordings : str
        Folder of real recordings; without it only simulated cases are used.
    real, first, second, unnamed : dict of int to int
        Seed -> number of cases of each kind.
    step : float
        Factor by which each number is tried larger and smaller; 1 learns odds and background only.
    processes : int
    """

    recordings: str = "../shared/recordings"
    real: dict[int, int] = {}
    first: dict[int, int] = {}
    second: dict[int, int] = {}
    unnamed: dict[int, int] = {}
    step: float = Field(1.6, ge=1.0)
    processes: int = Field(2, ge=1)


def reduce_cases(parameters: CalibrateMismatchParameters) -> Work:
    """Make each tuning case and keep the evidence of its sets; done once for each version of the code."""
    code = code_hash("mismatch", "calibration", "concealed", "magic_formula")
    made = plans(
        Path(parameters.recordings), parameters.real, parameters.first, parameters.second, parameters.unnamed
    )
    return {f"{code}/{name}.pkl": _ReducedCase(make) for name, make in made}


class _ReducedCase:
    """One case, made and reduced when it is asked for."""

    def __init__(self, make: Callable[[], KnownCase]) -> None:
        self.make = make

    def __call__(self) -> bytes:
        try:
            return pickle.dumps(reduced(self.make()))
        except TirePipelineError:
            return _NOTHING


def reduced(known: KnownCase) -> Tuning | None:
    """Return what a case says of its sets, or None if it stops before they are weighed."""
    prepared = prepare(known.tire, known.recording)
    if prepared.stopped:
        return None
    truth = known.truth
    sets = enumerate_sets(analyse(thinned(prepared.data)), START, [truth] if truth else [])
    tuning = Tuning(sets.case, known.source, truth, known.right, known.unnamed)
    return pruned(tuning) if tuning.rights().any() else None


def learn_sizes(
    reduced_cases: Folder, parameters: CalibrateMismatchParameters
) -> tuple[dict[str, Any], pd.DataFrame]:
    """Learn from all sources, and judge each by sizes that were learnt without it.

    Returns
    -------
    sizes : dict
        ``sizes`` and their ``provenance``.
    table : DataFrame
        Source, cases, log score of the true set, of base rates, and how far confidences are off.
    """
    cases = [t for read in reduced_cases.values() if (t := pickle.loads(read())) is not None]
    steps = (parameters.step,) if parameters.step > 1.0 else ()
    sizes = learn(cases, steps=steps, mapped=_Mapped(parameters.processes))
    rows = [{"source": s, **judged(*_without(s, cases, sizes))} for s in sorted({t.source for t in cases})]
    return {"sizes": sizes.to_dict(), "provenance": _made_with(cases, sizes, parameters)}, pd.DataFrame(rows)


class _Mapped:
    """``map`` over so many processes."""

    def __init__(self, processes: int) -> None:
        self.processes = processes

    def __call__(self, function: Any, items: Any) -> Any:
        return Parallel(n_jobs=self.processes, batch_size=8)(delayed(function)(item) for item in items)


def _without(source: str, cases: list[Tuning], sizes: LearntSizes) -> tuple[list[Tuning], LearntSizes]:
    """Return the cases of one source, and sizes whose odds and background were learnt from the others."""
    others = [each for each in cases if each.source != source]
    learnt = learn(others, sizes, steps=()) if others else sizes
    return [each for each in cases if each.source == source], learnt


def _made_with(
    cases: list[Tuning], sizes: LearntSizes, parameters: CalibrateMismatchParameters
) -> dict[str, Any]:
    return {
        "cases": dict(Counter(each.source for each in cases)),
        "seeds": {n: list(getattr(parameters, n)) for n in ("real", "first", "second", "unnamed")},
        "code": code_hash("mismatch", "magic_formula", "tir"),
        "date": datetime.now(UTC).date().isoformat(),
        "log_score": float(log_scores(cases, sizes).mean()),
    }


def judged(cases: list[Tuning], sizes: LearntSizes) -> dict[str, float]:
    """Return log score, that of base rates, and the expected error of the confidences of some cases."""
    bare = replace(sizes, independent=1e-6)
    said = [
        (sure, bool(set(names) & {n for right in t.right for n in right}))
        for t in cases
        for names, sure in answered(t.case, sizes).sets
    ]
    return {
        "cases": len(cases),
        "log_score": float(log_scores(cases, sizes).mean()),
        "log_score_of_base_rates": float(log_scores(cases, bare).mean()),
        "sets": len(said),
        "mean_confidence": float(np.mean([sure for sure, _ in said])) if said else float("nan"),
        "hold_the_truth": float(np.mean([held for _, held in said])) if said else float("nan"),
    }
