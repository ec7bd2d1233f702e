"""The posterior over sets beside the search, on development cases: reduce, learn, judge.

python benchmarks/posterior_cases.py reduce --source real --seed 22 --cases 60 --folder /tmp/tuning
python benchmarks/posterior_cases.py reduce --source first --seed 770001 --cases 40 --folder /tmp/tuning
python benchmarks/posterior_cases.py reduce --source second --seed 4242 --cases 60 --folder /tmp/tuning
python benchmarks/posterior_cases.py learn --folder /tmp/tuning [--without calspan] --out learnt.json
python benchmarks/posterior_cases.py judge --seed 21 --cases 60 --sizes learnt.json

``reduce`` may be stopped and begun again: what is in the folder is not made twice. ``real`` cases are of the
sweeps of ``development.csv`` only; the second simulator is used through its interface.
"""

from __future__ import annotations

import argparse
import json
import pickle
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.code_hash import code_hash
from tire_pipeline.concealed import case_plan, make_case
from tire_pipeline.concealed.real import make_real_case, real_plan
from tire_pipeline.concealed.real.score import answered as told_sets
from tire_pipeline.concealed.real.score import found_among, found_first, is_false
from tire_pipeline.concealed.second import CAUSES, draw_case
from tire_pipeline.errors import DomainError, RecordingError
from tire_pipeline.magic_formula import fit_magic_formula
from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.posterior.answer import answered
from tire_pipeline.mismatch.inference.posterior.calibrate import START, Tuning, learn, log_scores, pruned
from tire_pipeline.mismatch.inference.posterior.enumerate import enumerated
from tire_pipeline.mismatch.inference.posterior.products import OfCase
from tire_pipeline.mismatch.inference.posterior.sizes import LearntSizes
from tire_pipeline.mismatch.inference.search_state import begin
from tire_pipeline.mismatch.inference.thinning import thinned
from tire_pipeline.mismatch.recording.checks import prepare

RECORDINGS = Path(__file__).resolve().parents[2] / "shared" / "recordings"
EXACT = {"clipping", "stuck_channel", "sign_convention", "unit_error"}
"""Faults that are found without a fit, by both engines alike."""
STRONG = 2.0
WEAK = 1.0
SECOND = {
    "inflation pressure": "inflation_pressure",
    "unknown camber": "camber_offset",
    "tread temperature": "temperature",
    "tread wear": "wear",
    "path curvature": "turn_slip",
    "relaxation": "relaxation_length",
    "sliding speed": "speed_dependence",
    "load sensitivity": "load_sensitivity",
    "surface friction": "friction_scale",
    "tread stiffness": "stiffness_scale",
    "carcass stiffness": "stiffness_scale",
    "force offset": "force_offset",
    "force gain": "force_gain",
    "crosstalk": "crosstalk",
    "load crosstalk": "crosstalk",
    "delay": "time_delay",
    "low-pass filter": "low_pass",
    "slip angle offset": "slip_angle_offset",
    "drift": "sensor_drift",
}
"""Causes of the second simulator -> names of the catalogue."""
LEFT_OUT = ("clipping", "unit error", "quantisation")


@dataclass(frozen=True)
class Known:
    """An effect that a case holds."""

    name: str
    over_misfit: float


@dataclass(frozen=True)
class Made:
    """A case, and what it holds."""

    label: str
    source: str
    kind: str
    tire: Any
    recording: pd.DataFrame
    effects: tuple[Known, ...]
    acceptable: tuple[str, ...] = ()


def real_cases(seed: int, count: int) -> Iterator[Made]:
    """Make cases from real recordings."""
    for number, plan in enumerate(real_plan(count, seed)):
        try:
            case, answer = make_real_case(plan, RECORDINGS, "development")
        except DomainError as error:
            print("not made:", error, flush=True)
            continue
        yield _made(f"real_{seed}_{number:03d}", plan.source, case, answer)


def first_cases(seed: int, count: int) -> Iterator[Made]:
    """Make cases of the project's own simulator."""
    for number, (case_seed, kind) in enumerate(case_plan(count, seed)):
        yield _made(f"first_{seed}_{number:03d}", "first", *make_case(case_seed, kind))


def _made(label: str, source: str, case: Any, answer: Any) -> Made:
    effects = tuple(Known(e.name, e.over_misfit) for e in answer.effects)
    return Made(label, source, answer.kind, case.tire, case.recording, effects, tuple(answer.acceptable))


def second_cases(seed: int, count: int) -> Iterator[Made]:
    """Make cases of the second simulator, with a formula fitted to its references."""
    names = [cause for cause in CAUSES if cause not in LEFT_OUT]
    for number in range(count):
        rng = np.random.default_rng([seed, number])
        several = 1 if rng.random() >= 0.3 else 0
        wanted = tuple(rng.choice(names, size=1 if rng.random() < 0.75 else 2, replace=False))
        case = draw_case(rng, wanted if several else "nothing", rows=3000)
        points = pd.concat([table.iloc[::8] for table in case.references], ignore_index=True)
        tire = fit_magic_formula(
            points,
            nominal_load=case.truth.tire.nominal_load,
            unloaded_radius=case.truth.tire.radius,
            starts=2,
            loss="linear",
        ).model
        pairs = zip(case.truth.causes, case.truth.strengths, strict=True)
        effects = tuple(Known(SECOND.get(cause, "unknown"), float(size)) for cause, size in pairs)
        unknown = any(e.name == "unknown" for e in effects)
        kind = "unknown" if unknown else ("single" if effects else "nothing")
        yield Made(f"second_{seed}_{number:03d}", "second", kind, tire, case.recording, effects)


MAKERS = {"real": real_cases, "first": first_cases, "second": second_cases}


def truth_of(made: Made) -> tuple[tuple[str, ...], tuple[tuple[str, ...], ...]]:
    """Return the true set, and all sets that are right."""
    seen = [e for e in made.effects if e.name in catalogue() and e.name not in EXACT]
    ways = []
    for effect in seen:
        instead = [(name,) for name in made.acceptable] if made.kind == "ambiguous" else []
        absent: list[tuple[str, ...]] = [()] if effect.over_misfit < WEAK else []
        ways.append([(effect.name,), *instead, *absent])
    right = {tuple(sorted(sum(way, ()))) for way in product(*ways)}
    return tuple(sorted(e.name for e in seen)), tuple(right)


def reduced(made: Made, *, with_truth: bool) -> tuple[OfCase | None, list[tuple[str, float]]]:
    """Return what the recording says, and what was found in it without a fit."""
    prepared = prepare(made.tire, made.recording)
    findings = [(f.name, f.evidence) for f in prepared.findings]
    if prepared.stopped:
        return None, findings
    truth, _ = truth_of(made)
    beside = [truth] if with_truth and truth else []
    return enumerated(begin(thinned(prepared.data)), START, beside), findings


def reduce_all(asked: argparse.Namespace) -> None:
    """Make cases and keep what they say, one file a case."""
    asked.folder.mkdir(parents=True, exist_ok=True)
    for made in MAKERS[asked.source](asked.seed, asked.cases):
        file = asked.folder / f"{made.label}.pkl"
        if file.exists():
            continue
        begun = time.process_time()
        try:
            case, _ = reduced(made, with_truth=True)
        except RecordingError as error:
            print(made.label, error, flush=True)
            continue
        if case is not None:
            tuning = Tuning(case, made.source, *truth_of(made), made.kind == "unknown")
            file.write_bytes(pickle.dumps(pruned(tuning)))
        print(made.label, made.source, made.kind, f"{time.process_time() - begun:.1f} s", flush=True)


def learn_from(asked: argparse.Namespace) -> None:
    """Learn from the kept cases and write sizes with where they come from."""
    files = sorted(asked.folder.glob("*.pkl"))
    cases = [pickle.loads(file.read_bytes()) for file in files]
    used = [each for each in cases if each.source != asked.without]
    sizes = learn(used, steps=asked.steps)
    table = {
        "sizes": sizes.to_dict(),
        "provenance": {
            "cases": dict(Counter(each.source for each in used)),
            "seeds": sorted({file.stem.rsplit("_", 1)[0] for file in files}),
            "code": code_hash("mismatch", "magic_formula", "tir"),
            "log_score": float(log_scores(used, sizes).mean()),
        },
    }
    left = [each for each in cases if each.source == asked.without]
    if left:
        table["provenance"]["log_score_left_out"] = float(log_scores(left, sizes).mean())
    asked.out.write_text(json.dumps(table, indent=1) + "\n", encoding="utf-8")
    print(json.dumps(table, indent=1))


def judge(asked: argparse.Namespace) -> None:
    """Print both engines' answers and a table, on the same cases."""
    sizes = LearntSizes(**json.loads(asked.sizes.read_text(encoding="utf-8"))["sizes"])
    rows: dict[str, list[tuple[Made, dict, float]]] = {"search": [], "posterior": []}
    for made in real_cases(asked.seed, asked.cases):
        for engine in rows:
            begun = time.process_time()
            told = {"sets": _told(engine, made, sizes)}
            rows[engine].append((made, told, time.process_time() - begun))
        said = {engine: each[-1][1]["sets"] for engine, each in rows.items()}
        print(made.label, made.source, [(e.name, round(e.over_misfit, 1)) for e in made.effects], said)
    print(pd.DataFrame({engine: summary(each) for engine, each in rows.items()}).to_string())


def _told(engine: str, made: Made, sizes: LearntSizes) -> list[tuple[tuple[str, ...], float]]:
    try:
        if engine == "search":
            return list(explain_mismatch(made.tire, made.recording).sets)
        case, findings = reduced(made, with_truth=False)
    except RecordingError:
        return []
    named = () if case is None else answered(case, sizes).sets
    return [*(((name,), sure) for name, sure in findings), *named]


def summary(rows: Sequence[tuple[Made, dict, float]]) -> dict[str, str]:
    """Return counts of one engine."""
    empty = [told for made, told, _ in rows if made.kind == "nothing"]
    known = [(made, told) for made, told, _ in rows if made.kind not in ("nothing", "unknown")]
    strong = [
        (told, effect)
        for made, told in known
        for effect in made.effects
        if effect.over_misfit >= STRONG and effect.name not in EXACT and made.kind != "ambiguous"
    ]
    sets = [(names, made) for made, told in known for names, _ in told_sets(told)]
    return {
        "right name first, twice the misfit": f"{sum(found_first(*s) for s in strong)} of {len(strong)}",
        "among the names": f"{sum(found_among(*s) for s in strong)} of {len(strong)}",
        "a name where nothing is missing": f"{sum(bool(t['sets']) for t in empty)} of {len(empty)}",
        "sets that hold nothing true": f"{sum(is_false(n, m) for n, m in sets)} of {len(sets)}",
        "median s of processor": f"{np.median([s for *_, s in rows]):.1f}",
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    commands = parser.add_subparsers(required=True)
    for name, work in (("reduce", reduce_all), ("learn", learn_from), ("judge", judge)):
        command = commands.add_parser(name)
        command.set_defaults(work=work)
        command.add_argument("--seed", type=int, default=22)
        command.add_argument("--cases", type=int, default=60)
        command.add_argument("--source", choices=list(MAKERS), default="real")
        command.add_argument("--folder", type=Path)
        command.add_argument("--without", help="source that is left out")
        command.add_argument("--out", type=Path)
        command.add_argument("--sizes", type=Path)
        command.add_argument(
            "--steps", type=float, nargs="*", default=(), help="2.0: form errors and tails, too"
        )
    asked = parser.parse_args()
    asked.work(asked)


if __name__ == "__main__":
    main()
