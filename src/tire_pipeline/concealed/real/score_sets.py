"""Scores of the half from real recordings: the scorer of the simulated half, and what is asked of sets.

A *set* is a name with the alternatives that the recording leaves open. One of more than three names is no
answer. A set that holds what is missing is right, whichever name comes first; one that does not is false,
whatever its confidence.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from tire_pipeline.concealed.cases.sealed_answers import EffectTruth
from tire_pipeline.concealed.effect_names import PHYSICS
from tire_pipeline.concealed.real.cases import RealAnswer
from tire_pipeline.concealed.scoring.calibration import calibration_rows
from tire_pipeline.concealed.scoring.findings import NameSet, name_sets
from tire_pipeline.concealed.scoring.rows import mean_row, share_row
from tire_pipeline.concealed.scoring.score import Report, recovered

MOST_NAMES = 3
"""A larger set counts as no answer."""

STRONG = 2.0
"""Effects of so many misfits and more must be found."""

SAME_ERROR = 1e-6
"""Share by which rounding may move a held-out error."""

HeldOut = Mapping[str, Mapping[str, Mapping[str, float]]]


def answered(report: Report) -> list[NameSet]:
    """Sets that count as an answer."""
    return [s for s in name_sets(report) if len(s[0]) <= MOST_NAMES]


def is_false(names: Sequence[str], answer: RealAnswer) -> bool:
    """Whether a set holds nothing of what is missing."""
    return not {e.name for e in answer.effects} & set(names)


def found_first(report: Report, effect: EffectTruth) -> bool:
    """Whether an effect is the name put first of a set."""
    return any(names[0] == effect.name for names, _ in answered(report))


def found_among(report: Report, effect: EffectTruth) -> bool:
    """Whether an effect is among the names of a set."""
    return any(effect.name in names for names, _ in answered(report))


def score_real(
    reports: Mapping[str, Report],
    answers: Iterable[RealAnswer],
    *,
    held_out: HeldOut,
) -> dict[str, Any]:
    """Score reports on cases from real recordings.

    Parameters
    ----------
    reports : mapping
        Case -> ``report.to_dict()``.
    answers : iterable of RealAnswer
    held_out : mapping
        Case -> output -> ``rms_before``, ``rms_after``, N.

    Returns
    -------
    dict
        ``scores``: rows of {source, name, value, low, high, n, target, met}, all sources together first;
        ``by_effect``; ``by_strength``; ``misses``.
    """
    pairs = [(reports[a.case_id], a) for a in answers]
    sources = ["all", *sorted({a.source for _, a in pairs})]
    scores = []
    for source in sources:
        rows = [(r, a) for r, a in pairs if source in ("all", a.source)]
        scores += [{"source": source, **row} for row in _rows(rows, held_out)]
    return {
        "n": len(pairs),
        "scores": scores,
        "by_strength": _by_strength(pairs),
        "by_effect": _by_effect(pairs),
        "misses": [m for r, a in pairs if (m := _miss(r, a, held_out.get(a.case_id, {})))],
    }


def _rows(pairs: list[tuple[Report, RealAnswer]], held_out: HeldOut) -> list[dict[str, Any]]:
    empty = [(r, a) for r, a in pairs if a.kind == "nothing"]
    known = [(r, a) for r, a in pairs if a.kind not in ("nothing", "unknown")]
    strong = [(r, a, e) for r, a in known for e in a.effects if e.over_misfit >= STRONG]
    plain = [(r, a, e) for r, a, e in strong if a.kind != "ambiguous"]
    hidden = [(r, e) for r, a in known for e in a.effects if e.name in a.hidden]
    sets = [(names, a, p) for r, a in pairs for names, p in answered(r)]
    ratios = [_ratio(held_out[a.case_id]) for _, a in pairs if a.case_id in held_out]
    shares = [
        share
        for _, a in known
        if a.case_id in held_out and (share := recovered(held_out[a.case_id], a)) is not None
    ]
    return [
        share_row("false physics, nothing missing", [_any_physics(r) for r, _ in empty], at_most=0.02),
        share_row("any name, nothing missing", [bool(name_sets(r)) for r, _ in empty]),
        share_row(
            "right name first, twice the misfit", [found_first(r, e) for r, _, e in plain], at_least=0.9
        ),
        share_row("the same, ambiguous ones too", [found_first(r, e) for r, _, e in strong]),
        share_row(
            "truth among the names, twice the misfit",
            [found_among(r, e) for r, _, e in strong],
            at_least=0.95,
        ),
        share_row(
            "truth among the names, any strength", [found_among(r, e) for r, a in known for e in a.effects]
        ),
        share_row("hidden physics named first, any strength", [found_first(r, e) for r, e in hidden]),
        share_row("hidden physics among the names, any strength", [found_among(r, e) for r, e in hidden]),
        share_row("sets that hold nothing of the truth", [is_false(n, a) for n, a, _ in sets]),
        share_row(
            "false names, outside the catalogue",
            [bool(name_sets(r)) for r, a in pairs if a.kind == "unknown"],
        ),
        mean_row("names a set", [len(n) for r, _ in pairs for n, _ in name_sets(r)], at_most=1.7),
        share_row(
            "sets of more than three names",
            [len(n) > MOST_NAMES for r, _ in pairs for n, _ in name_sets(r)],
            at_most=0.0,
        ),
        share_row(
            "held-out error above the model's own", [x > 1.0 + SAME_ERROR for x in ratios], at_most=0.0
        ),
        mean_row("held-out error over the model's own, largest", [max(ratios)] if ratios else []),
        mean_row("held-out share of the oracle's", shares),
        *calibration_rows(
            "calibration error of the findings",
            [p for _, _, p in sets],
            [not is_false(n, a) for n, a, _ in sets],
            at_most=0.03,
            rng=np.random.default_rng(0),
        ),
        share_row("refused", [r.get("verdict") == "refused" for r, _ in pairs]),
    ]


def _any_physics(report: Report) -> bool:
    return any(name in PHYSICS for names, _ in name_sets(report) for name in names)


def _ratio(errors: Mapping[str, Mapping[str, float]]) -> float:
    before = sum(e["rms_before"] ** 2 for e in errors.values())
    after = sum(e["rms_after"] ** 2 for e in errors.values())
    return float(np.sqrt(after / before)) if before > 0.0 else 1.0


def _by_strength(pairs: list[tuple[Report, RealAnswer]]) -> list[dict[str, Any]]:
    edges = ((0.0, 1.0), (1.0, 2.0), (2.0, 4.0), (4.0, np.inf))
    tests: dict[str, Callable[[Report, EffectTruth], bool]] = {"first": found_first, "among": found_among}
    out = []
    for low, high in edges:
        here = [
            (r, e) for r, a in pairs if a.kind != "unknown" for e in a.effects if low <= e.over_misfit < high
        ]
        for what, test in tests.items():
            if here:
                row = share_row(what, [test(r, e) for r, e in here])
                out.append({"above": low, "up_to": None if np.isinf(high) else high, **row})
    return out


def _by_effect(pairs: list[tuple[Report, RealAnswer]]) -> list[dict[str, Any]]:
    """How often each effect was found, of twice the misfit and more and in all."""
    names = sorted({e.name for _, a in pairs if a.kind != "unknown" for e in a.effects})
    out = []
    for name in names:
        here = [(r, e) for r, a in pairs for e in a.effects if e.name == name]
        strong = [(r, e) for r, e in here if e.over_misfit >= STRONG]
        out.append(
            {
                "effect": name,
                "n": len(here),
                "first": sum(found_first(r, e) for r, e in here),
                "among": sum(found_among(r, e) for r, e in here),
                "n_strong": len(strong),
                "first_strong": sum(found_first(r, e) for r, e in strong),
                "among_strong": sum(found_among(r, e) for r, e in strong),
            }
        )
    return out


def _miss(
    report: Report, answer: RealAnswer, errors: Mapping[str, Mapping[str, float]]
) -> dict[str, Any] | None:
    """Describe a case that was not answered correctly; None for the others."""
    sets = name_sets(report)
    false = [names for names, _ in answered(report) if is_false(names, answer)]
    missed = (
        [] if answer.kind == "unknown" else [e.name for e in answer.effects if not found_among(report, e)]
    )
    second = [e.name for e in answer.effects if found_among(report, e) and not found_first(report, e)]
    large = [names for names, _ in sets if len(names) > MOST_NAMES]
    ratio = _ratio(errors) if errors else 1.0
    if not (false or missed or second or large or ratio > 1.0 + SAME_ERROR):
        return None
    return {
        "case": answer.case_id,
        "source": answer.source,
        "kind": answer.kind,
        "true": [e.name for e in answer.effects],
        "over_misfit": [round(e.over_misfit, 2) for e in answer.effects],
        "hidden": list(answer.hidden),
        "rate": answer.rate,
        "verdict": report.get("verdict"),
        "sets": [[list(names), round(p, 3)] for names, p in sets],
        "missed": missed,
        "not_first": second,
        "false": [list(names) for names in false],
        "held_out_ratio": round(ratio, 4),
    }
