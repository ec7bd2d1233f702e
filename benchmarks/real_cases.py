"""What `explain_mismatch` makes of cases from real recordings: for development.

python benchmarks/real_cases.py --seed 7 --cases 60                     # all sources
python benchmarks/real_cases.py --seed 7 --cases 30 --source calspan --kind hidden
python benchmarks/real_cases.py --seed 7 --cases 60 --only friction_scale --each --processes 2
python benchmarks/real_cases.py --seed 7 --case 463891998 --page out.html   # one case again

Made from the sweeps of ``development.csv`` only, which no sealed case is made from. The proof itself is
``kedro run --pipeline prove_concealed``.
"""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path

import pandas as pd
from joblib import Parallel, delayed

from tire_pipeline.concealed import held_out_errors
from tire_pipeline.concealed.real import RealAnswer, RealPlan, make_real_case, real_plan
from tire_pipeline.concealed.real.score_sets import (
    answered,
    found_among,
    found_first,
    is_false,
    name_sets,
    score_real,
)
from tire_pipeline.errors import DomainError, RecordingError
from tire_pipeline.mismatch import explain_mismatch

RECORDINGS = Path(__file__).resolve().parents[2] / "shared" / "recordings"
Result = tuple[RealPlan, RealAnswer, dict, dict, float]


def run(plan: RealPlan, page: Path | None = None) -> Result | str:
    """Make and explain one case; a text where it could not be made."""
    try:
        case, answer = make_real_case(plan, RECORDINGS, "development")
    except DomainError as error:
        return str(error)
    begun = time.perf_counter()
    try:
        report = explain_mismatch(case.tire, case.recording)
        told = report.to_dict()
        if hasattr(report, "sets"):
            told["sets"] = [[list(names), p] for names, p in report.sets]
        errors = held_out_errors(case, report.corrected.predict)
        if page is not None:
            report.to_html(page)
    except RecordingError as error:
        told = {"verdict": "refused", "effects": [], "problem": str(error)}
        errors = {"fy": dict.fromkeys(("rms_before", "rms_after"), answer.oracle["fy"]["rms_before"])}
    return plan, answer, told, errors, time.perf_counter() - begun


def line(result: Result) -> dict:
    """One case in a row."""
    plan, answer, told, errors, seconds = result
    before, after = (errors["fy"][k] for k in ("rms_before", "rms_after"))
    sets = name_sets(told)
    known = [] if plan.kind == "unknown" else answer.effects
    said = "; ".join("/".join(names) + f" {p:.2f}" for names, p in sets)
    return {
        "seed": plan.seed,
        "source": plan.source,
        "kind": plan.kind,
        "true": ", ".join(
            f"{e.name} {e.over_misfit:.1f}" + "*" * (e.name in answer.hidden) for e in answer.effects
        ),
        "said": said or f"{told['verdict']} {told.get('problem', '')}",
        "first": sum(found_first(told, e) for e in known),
        "among": sum(found_among(told, e) for e in known),
        "of": len(known),
        "false": sum(is_false(names, answer) for names, _ in answered(told)),
        "before": before,
        "after": after,
        "oracle": answer.oracle["fy"]["rms_oracle"],
        "worse": after > before * (1.0 + 1e-6),
        "rate": answer.rate,
        "s": seconds,
    }


def show(row: dict) -> None:
    """Print one case."""
    print(
        f"{row['seed']:>9} {row['source']:7} {row['kind']:9} {row['true'] or '-':50.50} -> "
        f"{row['said']:60.60} {row['before']:8.2f} {row['after']:8.2f} ({row['oracle']:.2f}) "
        f"{row['s']:5.1f} s{' WORSE' if row['worse'] else ''}",
        flush=True,
    )


def summarise(results: list[Result]) -> None:
    """Print tables by kind, by score and by effect."""
    rows = pd.DataFrame([line(r) for r in results])
    rows["gone"] = 1.0 - (rows["after"] / rows["before"]) ** 2
    table = rows.groupby(["source", "kind"]).agg(
        cases=("seed", "size"),
        of=("of", "sum"),
        first=("first", "sum"),
        among=("among", "sum"),
        false=("false", "sum"),
        worse=("worse", "sum"),
        gone=("gone", "median"),
        s=("s", "mean"),
        s_max=("s", "max"),
    )
    result = score_real(
        {r[1].case_id: r[2] for r in results},
        [r[1] for r in results],
        held_out={r[1].case_id: r[3] for r in results},
    )
    scores = pd.DataFrame(result["scores"])
    scores = scores[scores["source"] == "all"].dropna(subset=["value"])
    kept = ["name", "value", "low", "high", "n", "target", "met"]
    print("\n", table.round(2).to_string(), sep="")
    print("\n", scores[kept].round(3).to_string(index=False), sep="")
    print("\n", pd.DataFrame(result["by_effect"]).to_string(index=False), sep="")


def asked_for() -> argparse.Namespace:
    """What the command line says."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--seed", type=int, default=7)
    parser.add_argument("--cases", type=int, default=60)
    parser.add_argument("--source", choices=["calspan", "dart", "tydex"])
    parser.add_argument("--kind", help="nothing, hidden, physics, artefact, pair, ambiguous or unknown")
    parser.add_argument("--only", help="only cases that hold this effect")
    parser.add_argument("--case", type=int, help="only the case of this seed")
    parser.add_argument("--page", type=Path, help="where to write the report's page (with --case)")
    parser.add_argument("--each", action="store_true", help="print every case, not the misses alone")
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--save", type=Path, help="write answers, reports and errors as JSON")
    return parser.parse_args()


def main() -> None:
    asked = asked_for()
    plans = real_plan(asked.cases, asked.seed, source=asked.source, kind=asked.kind)
    if asked.case is not None:
        plans = [p for p in plans if p.seed == asked.case]
    if asked.only:
        plans = [p for p in plans if asked.only in _effects(p)]
    work = (delayed(run)(p, asked.page if asked.case is not None else None) for p in plans)
    results: list[Result] = []
    for result in Parallel(n_jobs=asked.processes, return_as="generator")(work):
        if isinstance(result, str):
            print("not made:", result, flush=True)
            continue
        results.append(result)
        row = line(result)
        wrong = row["first"] < row["of"] or row["false"] or row["worse"]
        if asked.each or asked.case is not None or wrong:
            show(row)
    if results:
        summarise(results)
    if asked.save:
        kept = [[answer.to_dict(), told, errors] for _, answer, told, errors, _ in results]
        asked.save.write_text(json.dumps(kept))


def _effects(plan: RealPlan) -> set[str]:
    """What a case conceals."""
    try:
        return {e.name for e in make_real_case(plan, RECORDINGS, "development")[1].effects}
    except DomainError:
        return set()


if __name__ == "__main__":
    main()
