"""Whether what the report says could have been seen is seen, and whether its intervals hold the truth.

python benchmarks/visible_sizes.py --put-in --minutes 60   # effects of that size, found or not; resumes
python benchmarks/visible_sizes.py --sizes                 # sizes beside a likelihood-ratio test; resumes
python benchmarks/visible_sizes.py --table                 # rates of both, beside the rows and on a page

Recordings in which nothing is missing: of the rig simulator (fresh seeds), and real ones (development
sweeps, ``concealed/real``) with the model fitted to the recording. The effects of a recording are taken in an
order that is drawn, and the recordings in turn, so that wherever the run stops the rows are a fair sample.

``--put-in``: one parameter of an effect is put in by its mechanism at the size that the report of that
recording says would be named in 95% of cases, with a sign that is drawn. Found: the name or one of its
alternatives. The 95% interval of each parameter of an effect that is named alone is asked whether it holds
the truth (what was not put in is 0). ``--sizes``: the size beside that at which a likelihood-ratio test that
knows form and noise sees it in 95%, and the estimate beside its standard error where the truth is 0.

Rows: ``benchmarks/results/visible_found.csv`` and ``visible_sizes.csv``, each with the hash of the engine
that made it and its date; rates: ``visible_sizes.txt``.
"""

from __future__ import annotations

import argparse
import csv
import hashlib
import time
import warnings
from collections.abc import Callable, Iterator
from dataclasses import replace
from datetime import UTC, datetime
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd
from doc_tables import markdown, write_between

import tire_pipeline.mismatch
from tire_pipeline.concealed import Case, CaseSettings, make_case
from tire_pipeline.concealed.real import RealPlan, make_real_case
from tire_pipeline.errors import DomainError, RecordingError
from tire_pipeline.mismatch import Explainer, explain_mismatch
from tire_pipeline.mismatch.proof.trial import put_in
from tire_pipeline.mismatch.proof.visible import Sight, sights
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.mismatch.report.assemble import Explained

RECORDINGS = Path(__file__).resolve().parents[2] / "shared" / "recordings"
RESULTS = Path(__file__).parent / "results"
FOUND, SIZES, TABLE = (
    RESULTS / name for name in ("visible_found.csv", "visible_sizes.csv", "visible_sizes.txt")
)
PAGE, MARK = (
    Path(__file__).resolve().parents[1] / "docs" / "explanation" / "concealed_results.md",
    "<!-- from visible_sizes.py -->",
)
SEEDS = {
    "simulated": range(75_400, 75_412),
    "calspan": range(75_500, 75_504),
    "dart": range(75_600, 75_603),
    "tydex": range(75_700, 75_702),
}
ROWS = (1000, 5000)
"""Of a simulated recording: an explanation of a longer one takes ten times as long."""
Z = 1.959964
KEY = "source seed effect parameter".split()
OF_FOUND = "rows size error told found first verdict names inside asked z why seconds".split()
OF_SIZES = "rows misfit seen told value error".split()


@cache
def code() -> str:
    """Hash of the engine."""
    folder = Path(tire_pipeline.mismatch.__file__).parent
    total = hashlib.sha256()
    for path in sorted(folder.rglob("*.py")):
        total.update(path.read_bytes())
    return total.hexdigest()[:12]


def case_of(source: str, seed: int) -> Case:
    """Return a recording in which nothing is missing; a simulated one is short."""
    if source == "simulated":
        return make_case(seed, "nothing", CaseSettings(rows=ROWS))[0]
    case = make_real_case(RealPlan(seed=seed, source=source, kind="nothing"), RECORDINGS, "development")[0]
    return replace(case, recording=as_explained(case))


def as_explained(case: Case) -> pd.DataFrame:
    """Return the recording at the rate at which it is explained, by means of consecutive samples."""
    rows = prepare(case.tire, case.recording).rows
    if rows.size == len(case.recording):
        return case.recording
    sample = np.searchsorted(rows, np.arange(len(case.recording)), side="right") - 1
    return case.recording.groupby(np.maximum(sample, 0)).mean()


def turns(sources: list[str]) -> Iterator[tuple[str, int]]:
    """Yield sources and seeds, one of each source in turn."""
    for k in range(max(len(SEEDS[source]) for source in sources)):
        yield from ((source, SEEDS[source][k]) for source in sources if k < len(SEEDS[source]))


@cache
def weighed(source: str, seed: int) -> tuple[Case, Explained] | None:
    """Return a recording and what the posterior says; None where something is named with nothing put in."""
    try:
        case = case_of(source, seed)
        it = Explainer().weigh(case.tire, case.recording)
    except (DomainError, RecordingError) as error:
        print(f"{source} {seed}: {error}", flush=True)
        return None
    if it.answer.names:
        print(f"{source} {seed}: {'+'.join(it.answer.names)} is named with nothing put in", flush=True)
        return None
    return case, it


def shown(it: Explained) -> Iterator[Sight]:
    """Yield what a recording shows of each parameter."""
    yield from sights(it.analysis, it.sets, it.answer.named)


@cache
def drawn(source: str, seed: int) -> list[Sight]:
    """Return what can be seen in a recording, in an order that is drawn."""
    known = weighed(source, seed)
    if known is None:
        return []
    found = [s for s in shown(known[1]) if np.isfinite(s.seen)]
    return [found[k] for k in np.random.default_rng(seed).permutation(len(found))]


def try_one(case: Case, it: Explained, sight: Sight, seed: int) -> dict[str, object]:
    """Put one effect in and explain."""
    rng = np.random.default_rng([seed, *sight.variant.name.encode(), *sight.parameter.name.encode()])
    size = sight.seen * (1.0 if sight.parameter.one_sided else float(rng.choice([-1.0, 1.0])))
    truth = sight.values(it.analysis.data, size)
    recording = put_in(case.tire, case.recording, sight.variant.name, truth)
    begun = time.process_time()
    report = explain_mismatch(case.tire, recording)
    right = [e for e in report.effects if e.name == sight.variant.name]
    z = {}
    if len(report.effects) == 1:
        for e in right:
            for name, (value, error, _) in e.parameters.items():
                if error > 0.0 and name not in sight.form:
                    z[name] = (value - truth.get(name, 0.0)) / error
    return {
        "rows": it.analysis.data.size,
        "size": size,
        "error": sight.error,
        "told": sight.told,
        "found": int(any(sight.variant.name in (e.name, *e.alternatives) for e in report.effects)),
        "first": int(bool(right)),
        "verdict": report.verdict,
        "names": "; ".join("/".join([e.name, *e.alternatives]) for e in report.effects),
        "inside": sum(abs(x) <= Z for x in z.values()),
        "asked": len(z),
        "z": "; ".join(f"{name} {x:.2f}" for name, x in z.items()),
        "why": next((c["why"] for c in report.candidates if c["name"] == sight.variant.name), ""),
        "seconds": round(time.process_time() - begun, 1),
    }


def append(path: Path, columns: list[str], rows: list[dict[str, object]]) -> None:
    """Add rows to a table."""
    new = not path.exists()
    with path.open("a", newline="", encoding="utf-8") as file:
        out = csv.DictWriter(file, [*KEY, *columns, "code", "date"])
        if new:
            out.writeheader()
        today = datetime.now(UTC).date().isoformat()
        out.writerows(row | {"code": code(), "date": today} for row in rows)


def done(path: Path, columns: list[str]) -> set[tuple[str, ...]]:
    """Return what this engine has done before."""
    if not path.exists():
        return set()
    past = pd.read_csv(path, dtype=str)
    return {tuple(row) for row in past.loc[past["code"] == code(), columns].to_numpy()}


def count_found(sources: list[str], over: Callable[[], bool]) -> None:
    """Put effects in and count, one of each recording in turn, until the time is over."""
    past, k, more = done(FOUND, KEY), 0, True
    while more:
        more = False
        for source, seed in turns(sources):
            if over():
                return
            known, found = weighed(source, seed), drawn(source, seed)
            if known is None or k >= len(found):
                continue
            more, sight = True, found[k]
            key = (source, str(seed), sight.variant.name, sight.parameter.name)
            if key not in past:
                row = dict(zip(KEY, key, strict=True)) | try_one(*known, sight, seed)
                append(FOUND, OF_FOUND, [row])
                print(*key, row["found"], row["names"], row["z"], row["seconds"], flush=True)
        k += 1


def count_sizes(sources: list[str], over: Callable[[], bool]) -> None:
    """Compare sizes with those of a likelihood-ratio test, until the time is over.

    Nothing is missing in these recordings.
    """
    past = done(SIZES, KEY[:2])
    for source, seed in turns(sources):
        if (source, str(seed)) in past:
            continue
        if over():
            return
        known = weighed(source, seed)
        if known is None:
            continue
        analysis = known[1].analysis
        rows: list[dict[str, object]] = []
        for s in shown(known[1]):
            key = dict(zip(KEY, (source, seed, s.variant.name, s.parameter.name), strict=True))
            figures = (analysis.data.size, analysis.misfit, s.seen, s.told, s.value, s.error)
            rows.append(key | dict(zip(OF_SIZES, figures, strict=True)))
        append(SIZES, OF_SIZES, rows)
        print(source, seed, analysis.data.size, len(rows), flush=True)


def newest(path: Path) -> pd.DataFrame:
    """Return the rows of the engine that made the last one."""
    rows = pd.read_csv(path)
    return rows[rows["code"] == rows["code"].iloc[-1]].copy()


def about(rows: pd.DataFrame) -> str:
    """Say which engine, dates and seeds some rows are of."""
    seeds = "; ".join(
        f"{source} {part['seed'].min()} to {part['seed'].max()} ({part['seed'].nunique()} recordings)"
        for source, part in rows.groupby("source")
    )
    return f"engine {rows['code'].iloc[0]}, {rows['date'].min()} to {rows['date'].max()}, seeds {seeds}"


def found_rates() -> list[str]:
    """Return the rates of what was put in, as lines."""
    rows = newest(FOUND)
    out = [f"Put in at the size `seen` ({about(rows)})"]
    columns = {"found": "mean", "first": "mean", "inside": "sum", "asked": "sum", "size": "size"}
    for by in ("source", "effect"):
        part = rows.groupby(by).agg(columns).rename(columns={"size": "cases"}).round(2)
        out += ["", part.to_string()]
    share, n = rows["found"].mean(), len(rows)
    spread = Z * np.sqrt(max(share * (1.0 - share), 1.0 / n) / n)
    out += ["", f"found {share:.3f} +- {spread:.3f} of {n}; goal 0.90 to 1.00"]
    for name, part in (("simulated", rows[rows["source"] == "simulated"]), ("all", rows)):
        held, asked = int(part["inside"].sum()), int(part["asked"].sum())
        if asked:
            out.append(
                f"intervals hold the truth ({name}): {held} of {asked}, {held / asked:.3f}; goal 0.90 to 0.98"
            )
    return out


def sized() -> tuple[pd.DataFrame, pd.DataFrame, pd.DataFrame]:
    """Return rows of sizes with ``ratio`` and ``held``: all, those with a ratio, simulated intervals."""
    rows = newest(SIZES)
    rows["ratio"] = rows["seen"] / rows["told"]
    rows["held"] = (rows["value"].abs() <= Z * rows["error"]).where(np.isfinite(rows["error"]))
    seen = rows[np.isfinite(rows["seen"]) & np.isfinite(rows["told"])]
    return rows, seen, rows[(rows["source"] == "simulated") & rows["held"].notna()]


def size_rates() -> list[str]:
    """Return the sizes beside those of a likelihood-ratio test, as lines."""
    rows, seen, clean = sized()
    hidden = rows[~np.isfinite(rows["seen"]) & np.isfinite(rows["told"])]
    out = [f"`seen` over the size of a likelihood-ratio test ({about(rows)})"]
    for by in ("source", "effect"):
        out += ["", seen.groupby(by)["ratio"].agg(["median", "max", "size"]).round(2).to_string()]
    by_effect = seen.groupby("effect")["ratio"].median()
    out += [
        "",
        f"median over the catalogue {by_effect.median():.2f}, goal 1.5; largest median of an effect "
        f"{by_effect.max():.2f} ({by_effect.idxmax()}), largest of all {seen['ratio'].max():.2f}, goal 3",
        f"above 3: {int((seen['ratio'] > 3.0).sum())} of {len(seen)}; the test would see it, and the report "
        f"says that no size would be named: {len(hidden)}",
    ]
    held = clean.groupby("effect")["held"].agg(["mean", "size"]).astype(float).round(2)
    out += [
        "",
        "Where the truth is 0, the 95% interval beside all else holds it (simulated):",
        held.to_string(),
    ]
    if len(clean):
        out.append(f"all: {clean['held'].astype(float).mean():.3f} of {len(clean)}")
    return out


def shown_on_page() -> str:
    """Return the rates by source, as a table, and which engines they are of."""
    found, (sizes, seen, clean) = newest(FOUND), sized()
    head = [
        "source",
        "put in",
        "among the names",
        "first",
        "size over that of the test, median",
        "above 3 times",
        "intervals that hold the truth",
    ]
    rows = []
    for source in (*SEEDS, None):
        put = found if source is None else found[found["source"] == source]
        over = seen["ratio"] if source is None else seen.loc[seen["source"] == source, "ratio"]
        held = f"{clean['held'].astype(float).mean():.3f} of {len(clean)}" if source == "simulated" else ""
        rows.append(
            [
                source or "all",
                str(len(put)),
                f"{put['found'].mean():.2f}",
                f"{put['first'].mean():.2f}",
                f"{over.median():.2f}",
                f"{(over > 3.0).sum()} of {len(over)}",
                held,
            ]
        )
    made = f"Put in: {about(found)}.\n\nSizes and intervals: {about(sizes)}."
    return f"{markdown(head, rows)}\n\n{made}"


def table() -> None:
    """Print and write the rates of the newest engine's rows."""
    parts = [rates() for path, rates in ((FOUND, found_rates), (SIZES, size_rates)) if path.exists()]
    text = "\n\n\n".join("\n".join(part) for part in parts) + "\n"
    TABLE.write_text(text, encoding="utf-8")
    if len(parts) > 1:
        write_between(PAGE, MARK, shown_on_page())
    print(text)


def main() -> None:
    """Run what is asked for."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--put-in", action="store_true")
    parser.add_argument("--sizes", action="store_true")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--minutes", type=float, default=30.0)
    parser.add_argument("--source", choices=SEEDS, action="append")
    asked = parser.parse_args()
    warnings.simplefilter("ignore")
    end, sources = time.monotonic() + 60.0 * asked.minutes, asked.source or list(SEEDS)

    def over() -> bool:
        return time.monotonic() > end

    if asked.sizes:
        count_sizes(sources, over)
    if asked.put_in:
        count_found(sources, over)
    if asked.table:
        table()


if __name__ == "__main__":
    main()
