"""Nodes: what each tuning case says, sizes learnt from all of it, and each source judged without itself."""

from __future__ import annotations

import json
import pickle
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from functools import partial
from hashlib import sha256
from itertools import compress
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from pydantic import Field

from tire_pipeline.calibration.cases import KnownCase, plans
from tire_pipeline.code_hash import code_hash
from tire_pipeline.concealed.scoring.calibration import calibration_error
from tire_pipeline.errors import TirePipelineError
from tire_pipeline.files.read_later import FilesToMake, Read, StoredFiles
from tire_pipeline.mismatch.inference.analysis import analyse
from tire_pipeline.mismatch.inference.learn_sizes import (
    Learnt,
    Tuning,
    evidence_about,
    learn,
    log_scores,
    pruned,
)
from tire_pipeline.mismatch.inference.learnt.sizes import LearntSizes, learnt
from tire_pipeline.mismatch.inference.sets.answer import answered
from tire_pipeline.mismatch.inference.sets.enumerate import enumerate_sets
from tire_pipeline.mismatch.inference.thinning import thinned
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.parameters import Parameters
from tire_pipeline.tasks import Map, all_done, in_turn

_STOPPED_CASE = pickle.dumps(None)
"""Of a case that stops before the sets are weighed, or cannot be made."""
CASES_A_TASK = 8


class CalibrateMismatchParameters(Parameters):
    """What the posterior learns from.

    Parameters
    ----------
    recordings : str
        Folder of real recordings; without it only simulated cases are used.
    real, first, second, unnamed : dict of int to int
        Seed -> number of cases of each kind.
    step : float
        Factor by which each size is tried larger and smaller; 1 learns the odds only.
    """

    recordings: str = "../shared/recordings"
    real: dict[int, int] = {}
    first: dict[int, int] = {}
    second: dict[int, int] = {}
    unnamed: dict[int, int] = {}
    step: float = Field(1.6, ge=1.0)


def reduce_cases(parameters: CalibrateMismatchParameters) -> FilesToMake:
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
            return _STOPPED_CASE


def reduced(known: KnownCase) -> Tuning | None:
    """Return what a case says of its sets, or None if it stops before they are weighed."""
    prepared = prepare(known.tire, known.recording)
    if prepared.stopped:
        return None
    truth, sizes = known.truth, learnt()
    sets = enumerate_sets(analyse(thinned(prepared.data)), sizes, [truth] if truth else [])
    tuning = Tuning(sets.case, known.source, truth, known.right, known.unnamed)
    return pruned(tuning, sizes) if tuning.rights().any() else None


def weigh_cases(reduced_cases: StoredFiles, parameters: CalibrateMismatchParameters) -> FilesToMake:
    """Work out the evidence of each case's hypotheses about the sizes in use; done once for these sizes."""
    sizes = sha256(json.dumps([learnt().to_dict(), parameters.step]).encode()).hexdigest()[:12]
    return {f"{sizes}/{name}": _WeighedCase(read, parameters.step) for name, read in reduced_cases.items()}


class _WeighedCase:
    """The evidence of one case, when it is asked for."""

    def __init__(self, read: Read, step: float) -> None:
        self.read, self.step = read, step

    def __call__(self) -> bytes:
        case = pickle.loads(self.read())
        return _STOPPED_CASE if case is None else pickle.dumps(evidence_about(case, learnt(), self.step))


def learn_sizes(
    reduced_cases: StoredFiles,
    weighed_cases: StoredFiles,
    parameters: CalibrateMismatchParameters,
    *,
    work: Map = in_turn,
) -> tuple[dict[str, Any], pd.DataFrame]:
    """Learn from all sources, and judge each by sizes that were learnt without it.

    Parameters
    ----------
    reduced_cases, weighed_cases : mapping of callable
        Of :func:`reduce_cases` and :func:`weigh_cases`, in one order.
    parameters : CalibrateMismatchParameters
    work : Map
        Weighs the cases by the sizes that are tried, some cases a task.

    Returns
    -------
    sizes : dict
        ``sizes`` and their ``provenance``.
    table : DataFrame
        Of :func:`judged`, a row for each source, and the mean log score of the sizes in use.
    """
    cases = [t for read in reduced_cases.values() if (t := pickle.loads(read())) is not None]
    about = [e for read in weighed_cases.values() if (e := pickle.loads(read())) is not None]
    mapped = _Mapped(work)
    found = learn(cases, learnt(), step=parameters.step, about=about, mapped=mapped)
    rows = []
    in_use = log_scores(cases, learnt(), evidence=[each[0] for each in about])
    for source, sizes in found.without.items():
        here = [each.source == source for each in cases]
        own = list(compress(cases, here))
        of_source = judged(own, sizes, found.sizes, mapped)
        of_source["log_score_of_the_sizes_in_use"] = float(in_use[here].mean())
        rows.append({"source": source, **of_source})
    made = {"sizes": found.sizes.to_dict(), "provenance": _made_with(cases, found, parameters)}
    return made, pd.DataFrame(rows)


@dataclass(frozen=True)
class _SaidBy:
    """Confidence of each set of names that a case gets by some sizes, and whether it holds the truth."""

    sizes: LearntSizes

    def __call__(self, each: Tuning) -> list[tuple[float, bool]]:
        right = {name for names in each.right for name in names}
        return [(sure, bool(set(names) & right)) for names, sure in answered(each.case, self.sizes).sets]


class _Mapped:
    """``map`` over cases by the run's workers."""

    def __init__(self, work: Map) -> None:
        self.work = work

    def __call__(self, function: Callable[[Tuning], Any], cases: Iterable[Tuning]) -> list[Any]:
        every = list(cases)
        tasks = {
            f"cases from number {first + 1} on": partial(
                _of_each, function, every[first : first + CASES_A_TASK]
            )
            for first in range(0, len(every), CASES_A_TASK)
        }
        done = all_done(self.work, tasks, "weighing the sizes")
        return [found for task in done.values() for found in task.result()]


def _of_each(function: Callable[[Tuning], Any], cases: Sequence[Tuning]) -> list[Any]:
    return [function(case) for case in cases]


def _made_with(cases: list[Tuning], found: Learnt, parameters: CalibrateMismatchParameters) -> dict[str, Any]:
    return {
        "command": "kedro run --pipeline calibrate_mismatch",
        "cases": dict(Counter(each.source for each in cases)),
        "seeds": {n: list(getattr(parameters, n)) for n in ("real", "first", "second", "unnamed")},
        "code": code_hash("mismatch", "magic_formula", "tir"),
        "date": datetime.now(UTC).date().isoformat(),
        "log_score": found.score,
        "log_score_of_the_sizes_before": found.start,
        "curvature": found.curvature,
    }


def judged(
    cases: list[Tuning], without: LearntSizes, every: LearntSizes, mapped: _Mapped
) -> dict[str, float]:
    """Return how sizes that were learnt without a source do on its cases.

    Parameters
    ----------
    cases : list of Tuning
        Of one source.
    without : LearntSizes
        Learnt from the other sources.
    every : LearntSizes
        Learnt from all of them, this one, too: no sizes of this model do much better.
    mapped : callable
        Spreads the work.

    Returns
    -------
    dict
        Cases; mean log score, that of ``every`` and that of base rates, which know the odds alone; and of
        the sets of names how many there are, their mean confidence, how many hold the truth, and how far
        confidences are off (expected calibration error).
    """
    said = [each for found in mapped(_SaidBy(without), cases) for each in found]
    sure, held = np.array(said, dtype=float).reshape(-1, 2).T
    odds_alone = replace(without, independent=1e-6)
    return {
        "cases": len(cases),
        "log_score": float(log_scores(cases, without, mapped).mean()),
        "log_score_learnt_with_it": float(log_scores(cases, every, mapped).mean()),
        "log_score_of_base_rates": float(log_scores(cases, odds_alone, mapped).mean()),
        "sets": len(said),
        "mean_confidence": float(sure.mean()) if said else float("nan"),
        "hold_the_truth": float(held.mean()) if said else float("nan"),
        "calibration_error": calibration_error(sure, held.astype(bool)),
    }
