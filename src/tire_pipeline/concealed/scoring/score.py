"""Scores of explanations against the sealed answers, with confidence intervals and every miss.

The reports come as the dictionaries of ``report.to_dict()``; the rules are in
``docs/explanation/concealed.md`` and were fixed before any report was scored.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np

from tire_pipeline.concealed.cases.sealed_answers import Answer, EffectTruth
from tire_pipeline.concealed.effect_names import ARTEFACTS, PHYSICS
from tire_pipeline.concealed.scoring.calibration import calibration_rows
from tire_pipeline.concealed.scoring.findings import name_sets
from tire_pipeline.concealed.scoring.overlap import interval_iou
from tire_pipeline.concealed.scoring.rows import mean_row, share_row
from tire_pipeline.errors import DomainError

STRENGTH_LIMIT = 0.6
"""Effects stronger than this share of the noise must be found."""

LOCATION_LIMIT = 1.0
"""Windows and regimes are scored for effects stronger than the noise."""

GAIN_LIMIT = 0.1
"""Held-out recovery is scored where the oracle removes this share of the squared error."""

STRENGTH_BINS = (0.0, 0.6, 1.0, 2.0, 4.0, np.inf)
"""Edges, in effect over noise, of the groups that the scores are also given by."""

Report = Mapping[str, Any]


def named(report: Report) -> tuple[str, ...]:
    """Catalogue names that a report puts first, in its order."""
    names = [str(effect["name"]) for effect in report.get("effects", ())]
    return tuple(name for name in names if name in PHYSICS or name in ARTEFACTS)


def covering(report: Report) -> set[str]:
    """Catalogue names of a report together with the alternatives it leaves open."""
    out: set[str] = set()
    for effect in report.get("effects", ()):
        out |= {str(effect["name"]), *map(str, effect.get("alternatives", ()))}
    return {name for name in out if name in PHYSICS or name in ARTEFACTS}


def false_physics(report: Report, answer: Answer) -> bool:
    """Whether physics is named where none is missing.

    An effect that leaves the true artefact open among its alternatives is not counted.
    """
    truth = {effect.name for effect in answer.effects}
    for effect in report.get("effects", ()):
        open_to_truth = truth & set(effect.get("alternatives", ()))
        if effect["name"] in PHYSICS and effect["name"] not in truth and not open_to_truth:
            return True
    return False


def exact_set(report: Report, answer: Answer) -> bool:
    """Whether the names put first are the true ones, none too many and none too few."""
    found = named(report)
    return len(found) == len(set(found)) and set(found) == {e.name for e in answer.effects}


def recovered(held_out: Mapping[str, Mapping[str, float]], answer: Answer) -> float | None:
    """Squared held-out error removed, as a share of what the oracle removes.

    Parameters
    ----------
    held_out : mapping
        Output -> ``rms_before`` and ``rms_after`` of the explained model on the held-out run, N.
    answer : Answer

    Returns
    -------
    float or None
        Held within -1 and 1; None where the oracle removes too little to tell.
    """
    before = best = after = 0.0
    for output, oracle in answer.oracle.items():
        before += oracle["rms_before"] ** 2
        best += oracle["rms_oracle"] ** 2
        got = held_out.get(output)
        rms_after = got["rms_after"] if got is not None else oracle["rms_before"]
        after += rms_after**2
    if before <= 0.0 or (before - best) / before < GAIN_LIMIT:
        return None
    return min(max((before - after) / (before - best), -1.0), 1.0)


def score(
    reports: Mapping[str, Report],
    answers: Iterable[Answer],
    *,
    held_out: Mapping[str, Mapping[str, Mapping[str, float]]] | None = None,
    seed: int = 0,
) -> dict[str, Any]:
    """Score reports against answers.

    Parameters
    ----------
    reports : mapping
        Case -> ``report.to_dict()``. Every case must be there.
    answers : iterable of Answer
    held_out : mapping, optional
        Case -> output -> ``rms_before``, ``rms_after`` of the explained model on held-out data.
    seed : int
        For the bootstrap of means.

    Returns
    -------
    dict
        ``scores``: list of {name, value, low, high, n, target, met}; ``by_strength``;
        ``by_effect``; ``misses``: every case that was not answered correctly, with the reason.

    Raises
    ------
    DomainError
        If a case has no report.
    """
    rows = list(answers)
    absent = [a.case_id for a in rows if a.case_id not in reports]
    if absent:
        raise DomainError(
            f"{len(absent)} of {len(rows)} cases have no report, first {absent[0]}",
            where="score",
            todo="explain all cases before scoring",
        )
    pairs = [(reports[a.case_id], a) for a in rows]
    rng = np.random.default_rng(seed)
    return {
        "n": len(rows),
        "scores": _name_scores(pairs) + _value_scores(pairs, held_out or {}, rng),
        "by_strength": _by_strength(pairs),
        "by_effect": _by_effect(pairs),
        "misses": [miss for report, answer in pairs if (miss := _miss(report, answer))],
    }


def _name_scores(pairs: list[tuple[Report, Answer]]) -> list[dict[str, Any]]:
    def of(*kinds: str) -> list[tuple[Report, Answer]]:
        return [(r, a) for r, a in pairs if a.kind in kinds]

    def strong(rows: list[tuple[Report, Answer]]) -> list[tuple[Report, Answer]]:
        return [(r, a) for r, a in rows if weakest(a) > STRENGTH_LIMIT]

    null, single, double = of("nothing", "artefact"), of("single"), of("pair")
    vague, outside = of("ambiguous"), of("unknown")
    count = [len(covering(r)) for r, _ in vague]
    return [
        share_row("false physics, nothing missing", [false_physics(r, a) for r, a in of("nothing")]),
        share_row("false physics, artefact only", [false_physics(r, a) for r, a in of("artefact")]),
        share_row("false physics", [false_physics(r, a) for r, a in null], at_most=0.02),
        share_row("any name, nothing missing", [bool(named(r)) for r, _ in of("nothing")]),
        share_row("artefact found", [exact_set(r, a) for r, a in of("artefact")]),
        share_row("exact set, single", [exact_set(r, a) for r, a in single]),
        share_row(
            "exact set, single above 0.6 noise",
            [exact_set(r, a) for r, a in strong(single)],
            at_least=0.95,
        ),
        share_row("exact set, pair", [exact_set(r, a) for r, a in double]),
        share_row(
            "exact set, pair above 0.6 noise",
            [exact_set(r, a) for r, a in strong(double)],
            at_least=0.85,
        ),
        share_row("ambiguous covered", [covers(r, a) for r, a in vague], at_least=0.95),
        share_row("ambiguous covered, first key", [covers(r, _by_first_key(a)) for r, a in vague]),
        mean_row("ambiguous, names given", count, at_most=2.0),
        share_row(
            "false names, outside the catalogue",
            [bool(named(r)) for r, _ in outside],
            at_most=0.05,
        ),
    ]


def _by_first_key(answer: Answer) -> Answer:
    """The answer as the first published proof's key had it: see ``effect_names.AMBIGUOUS_SETS``."""
    if any(e.name == "camber_offset" for e in answer.effects):
        return answer
    return replace(answer, acceptable=tuple(n for n in answer.acceptable if n != "camber_offset"))


def weakest(answer: Answer) -> float:
    """Strength over noise of a case's weakest effect; 0 where there is none."""
    return min((e.over_noise for e in answer.effects), default=0.0)


def covers(report: Report, answer: Answer) -> bool:
    """Whether the names given, with alternatives, hold the truth and nothing unacceptable."""
    given = covering(report)
    truth = {e.name for e in answer.effects}
    return truth <= given <= answer.right_names


def _value_scores(
    pairs: list[tuple[Report, Answer]],
    held_out: Mapping[str, Mapping[str, Mapping[str, float]]],
    rng: np.random.Generator,
) -> list[dict[str, Any]]:
    windows: list[float] = []
    regimes: list[float] = []
    confidence: list[float] = []
    correct: list[bool] = []
    for report, answer in pairs:
        truth = {e.name: e for e in answer.effects}
        for effect in report.get("effects", ()):
            if effect["name"] not in PHYSICS and effect["name"] not in ARTEFACTS:
                continue
            confidence.append(float(effect.get("confidence", 1.0)))
            correct.append(effect["name"] in answer.right_names)
            true = truth.get(effect["name"])
            if true is not None and true.over_noise > LOCATION_LIMIT:
                windows.append(interval_iou(effect.get("when", ()), true.when))
                regimes += _regime_ious(effect, true)
    shares = [
        share
        for _, a in pairs
        if a.effects and a.kind != "unknown" and a.case_id in held_out
        if (share := recovered(held_out[a.case_id], a)) is not None
    ]
    sets = [
        (p, not {e.name for e in answer.effects}.isdisjoint(names))
        for report, answer in pairs
        for names, p in name_sets(report)
    ]
    return [
        mean_row("window IoU", windows, at_least=0.8, rng=rng),
        mean_row("regime IoU", regimes, at_least=0.8, rng=rng),
        mean_row("held-out share of the oracle's", shares, at_least=0.9, rng=rng),
        *calibration_rows("calibration error", confidence, correct, at_most=0.05, rng=rng),
        *calibration_rows(
            "calibration error of the findings",
            [p for p, _ in sets],
            [right for _, right in sets],
            at_most=0.03,
            rng=rng,
        ),
    ]


def _regime_ious(effect: Mapping[str, Any], true: EffectTruth) -> list[float]:
    """One value a channel that both name and over which the truth has an extent."""
    out = []
    for channel, (low, high) in effect.get("where", {}).items():
        if channel in true.where and true.where[channel][1] > true.where[channel][0]:
            out.append(interval_iou([(low, high)], [true.where[channel]]))
    return out


def _by_strength(pairs: list[tuple[Report, Answer]]) -> list[dict[str, Any]]:
    out = []
    for kind in ("single", "pair", "artefact", "ambiguous"):
        for low, high in pairwise(STRENGTH_BINS):
            hits = [
                covers(r, a) if kind == "ambiguous" else exact_set(r, a)
                for r, a in pairs
                if a.kind == kind and low < weakest(a) <= high
            ]
            if hits:
                row = share_row("right", hits)
                upper = None if np.isinf(high) else high
                out.append({"kind": kind, "above": low, "up_to": upper, **row})
    return out


def _by_effect(pairs: list[tuple[Report, Answer]]) -> list[dict[str, Any]]:
    """How often each true effect was among the first names, whatever else was there."""
    hits: dict[str, list[bool]] = {}
    for report, answer in pairs:
        for effect in answer.effects:
            hits.setdefault(effect.name, []).append(effect.name in named(report))
    return [{"effect": name, **share_row("found", hits[name])} for name in sorted(hits)]


def _miss(report: Report, answer: Answer) -> dict[str, Any] | None:
    """Describe what went wrong with a case; None if nothing did."""
    found, truth = set(named(report)), {e.name for e in answer.effects}
    if answer.kind == "ambiguous":
        right = covers(report, answer)
    elif answer.kind == "unknown":
        right, truth = not found, set()
    else:
        right = exact_set(report, answer)
    if right:
        return None
    return {
        "case": answer.case_id,
        "kind": answer.kind,
        "true": [e.name for e in answer.effects],
        "over_noise": [round(e.over_noise, 2) for e in answer.effects],
        "verdict": report.get("verdict"),
        "named": sorted(found),
        "alternatives": sorted(covering(report) - found),
        "missed": sorted(truth - found),
        "invented": sorted(found - truth),
        "missing_channels": list(answer.missing_channels),
    }
