"""Whether what the report says could have been seen is seen: effects of that size put in, and counted.

python benchmarks/visible_sizes.py --sizes                 # the sizes alone, beside a likelihood-ratio test
python benchmarks/visible_sizes.py --minutes 60            # put them in; goes on where it stopped
python benchmarks/visible_sizes.py --table                 # rates of what was counted

Recordings in which nothing is missing: of the rig simulator (fresh seeds), and real ones (development sweeps,
``concealed/real``). Each parameter of each effect is put in at the size that the report of that recording
says would be named in 95% of cases, with a sign that is drawn, and at twice that size. Named: the name or one
of its alternatives. The 95% interval of each parameter of an effect that is named alone is asked whether it
holds the truth (what was not put in is 0). Results: ``benchmarks/results/visible_sizes.csv``, each row with
the hash of the engine that made it.
"""

from __future__ import annotations

import argparse
import csv
import hashlib
import time
import warnings
from collections.abc import Iterator
from datetime import UTC, datetime
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd

import tire_pipeline.mismatch
from tire_pipeline.concealed import Case, make_case
from tire_pipeline.concealed.real import RealPlan, make_real_case
from tire_pipeline.errors import DomainError, RecordingError
from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch import search as searching
from tire_pipeline.mismatch.checks import prepare
from tire_pipeline.mismatch.restart import search_all
from tire_pipeline.mismatch.state import Search
from tire_pipeline.mismatch.thinning import thinned
from tire_pipeline.mismatch.trial import put_in
from tire_pipeline.mismatch.visible import Sight, one_sided, sights

RECORDINGS = Path(__file__).resolve().parents[2] / "shared" / "recordings"
RESULTS = Path(__file__).parent / "results" / "visible_sizes.csv"
SEEDS = {
    "simulated": range(62_400, 62_408),
    "calspan": range(62_500, 62_504),
    "dart": range(62_600, 62_603),
    "tydex": range(62_700, 62_702),
}
FACTORS = (1.0, 2.0)
COLUMNS = (
    "source seed effect parameter factor size error told found first verdict names inside asked why seconds "
    "code date"
).split()
Z = 1.959964


@cache
def code() -> str:
    """Hash of the engine."""
    folder = Path(tire_pipeline.mismatch.__file__).parent
    total = hashlib.sha256()
    for path in sorted(folder.rglob("*.py")):
        total.update(path.read_bytes())
    return total.hexdigest()[:12]


def case_of(source: str, seed: int) -> Case:
    """Return a recording in which nothing is missing."""
    if source == "simulated":
        return make_case(seed, "nothing")[0]
    return make_real_case(RealPlan(seed=seed, source=source, kind="nothing"), RECORDINGS, "development")[0]


def searched(case: Case) -> Search:
    """Search a recording as it is."""
    search = searching.begin(thinned(prepare(case.tire, case.recording).data))
    search_all(search)
    return search


def each() -> Iterator[tuple[str, int, Case, Search]]:
    """Yield all recordings in which nothing is named as they are, one of each source in turn."""
    for k in range(max(map(len, SEEDS.values()))):
        for source, seeds in SEEDS.items():
            if k >= len(seeds):
                continue
            try:
                case = case_of(source, seeds[k])
                search = searched(case)
            except (DomainError, RecordingError) as error:
                print(f"{source} {seeds[k]}: {error}", flush=True)
                continue
            if search.fit.names:
                print(
                    f"{source} {seeds[k]}: {'+'.join(search.fit.names)} is named with nothing put in",
                    flush=True,
                )
                continue
            yield source, seeds[k], case, search


def sizes() -> None:
    """Print the sizes beside those of a likelihood-ratio test."""
    ratios = []
    for source, seed, _, search in each():
        begun = time.process_time()
        found = list(sights(search))
        seconds = time.process_time() - begun
        print(f"{source} {seed}: {search.data.size} rows, {seconds:.1f} s, misfit {search.misfit}")
        for s in found:
            ratios.append(
                {
                    "source": source,
                    "effect": s.variant.name,
                    "parameter": s.parameter.name,
                    "ratio": s.seen / s.told,
                }
            )
            label = f"  {s.variant.name:20s} {s.parameter.name:20s}"
            sizes = f"{s.seen:10.4g} {s.told:10.4g} {s.seen / s.told:6.2f}"
            print(label, sizes, f"out {s.ruled_out:.4g} ({s.value / s.error:.1f} sigma)")
    table = pd.DataFrame(ratios)
    table = table[np.isfinite(table["ratio"])]
    print(table.groupby("effect")["ratio"].agg(["median", "max", "size"]).round(2).to_string())
    print("median over the catalogue", round(table.groupby("effect")["ratio"].median().median(), 2))


def try_one(case: Case, search: Search, sight: Sight, factor: float, seed: int) -> dict[str, object]:
    """Put one effect in and explain."""
    rng = np.random.default_rng(
        [seed, *sight.variant.name.encode(), *sight.parameter.name.encode(), int(10 * factor)]
    )
    sign = 1.0 if one_sided(sight.parameter) else float(rng.choice([-1.0, 1.0]))
    truth = sight.values(search.data, sign * factor * sight.seen)
    recording = put_in(case.tire, case.recording, sight.variant.name, truth)
    begun = time.perf_counter()
    report = explain_mismatch(case.tire, recording)
    sets = [{e.name, *e.alternatives} for e in report.effects]
    right = [e for e in report.effects if e.name == sight.variant.name]
    inside = asked = 0
    for e in right:
        for name, (value, error, _) in e.parameters.items():
            if error > 0.0 and name not in sight.form and len(report.effects) == 1:
                asked += 1
                inside += abs(value - truth.get(name, 0.0)) <= Z * error
    why = next((c["why"] for c in report.candidates if c["name"] == sight.variant.name), "")
    return {
        "size": sign * factor * sight.seen,
        "error": sight.error,
        "told": sight.told,
        "found": int(any(sight.variant.name in s for s in sets)),
        "first": int(bool(right)),
        "verdict": report.verdict,
        "names": "; ".join("/".join([e.name, *e.alternatives]) for e in report.effects),
        "inside": inside,
        "asked": asked,
        "why": why,
        "seconds": round(time.perf_counter() - begun, 1),
    }


def count(minutes: float) -> None:
    """Put in and count, until the time is over."""
    end = time.monotonic() + 60.0 * minutes
    done = set()
    if RESULTS.exists():
        past = pd.read_csv(RESULTS, dtype=str)
        done = {
            tuple(row)
            for row in past.loc[
                past["code"] == code(), ["source", "seed", "effect", "parameter", "factor"]
            ].to_numpy()
        }
    new = not RESULTS.exists()
    with RESULTS.open("a", newline="", encoding="utf-8") as file:
        out = csv.DictWriter(file, COLUMNS)
        if new:
            out.writeheader()
        for source, seed, case, search in each():
            for sight in sights(search):
                if not np.isfinite(sight.seen):
                    continue
                for factor in FACTORS:
                    key = (source, str(seed), sight.variant.name, sight.parameter.name, str(factor))
                    if key in done:
                        continue
                    row = try_one(case, search, sight, factor, seed)
                    row |= dict(zip(("source", "seed", "effect", "parameter", "factor"), key, strict=True))
                    out.writerow(row | {"code": code(), "date": datetime.now(UTC).date().isoformat()})
                    file.flush()
                    if time.monotonic() > end:
                        return


def table() -> None:
    """Print the rates of the newest engine's rows."""
    rows = pd.read_csv(RESULTS)
    rows = rows[rows["code"] == rows["code"].iloc[-1]]
    rows["ratio"] = rows["size"].abs() / rows["factor"] / rows["told"]
    for by in ("source", "effect"):
        print(
            rows.groupby([by, "factor"])
            .agg(
                found=("found", "mean"),
                first=("first", "mean"),
                inside=("inside", "sum"),
                asked=("asked", "sum"),
                ratio=("ratio", "median"),
                n=("found", "size"),
            )
            .round(2)
            .to_string()
        )
    for factor, part in rows.groupby("factor"):
        held = f"{part['inside'].sum()} of {part['asked'].sum()}"
        print(f"factor {factor}: found {part['found'].mean():.3f} of {len(part)}; intervals {held}")
    by_effect = rows.groupby("effect")["ratio"].median()
    middle, most = by_effect.median(), by_effect.max()
    print(f"size over that of the likelihood-ratio test: median {middle:.2f}, most {most:.2f}")


def main() -> None:
    """Run what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", action="store_true")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--minutes", type=float, default=30.0)
    asked = parser.parse_args()
    warnings.simplefilter("ignore")
    if asked.table:
        table()
    elif asked.sizes:
        sizes()
    else:
        count(asked.minutes)


if __name__ == "__main__":
    main()
