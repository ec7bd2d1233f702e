"""Classification of files of unknown suppliers: are files of suppliers that were never seen turned away?

    python benchmarks/open_set.py --seeds 31 32 33 --write

One fleet (kind, bias size, seed) after another; six lines each go to ``benchmarks/results/open_set.csv``, and
fleets that are in there already are not measured again. Probability and typicality that a file needs (0.95,
0.10) were fixed on fleets of seeds 202 to 205 before any of seeds 31 to 33 was made.

``right`` and ``wrong``: files of known suppliers, tires left out. ``given_when_unseen``: files of a category
of which no file was learned from. Feature sets: ``all`` is what ``translate`` uses; without the conditions
that files state (``curves and zeros``), and from the coefficients' values alone (``curves``), to show what
each adds. Rows of the categories G to K: small laboratories that copy the rig, the ranges and the fits of a
large one with small changes; no file of theirs is learned from.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import numpy as np
import pandas as pd
from bench_translation import read_all
from doc_tables import markdown, write_between

from tire_pipeline.classifiers.open_set import OpenSetClassifier, left_out_check
from tire_pipeline.classifiers.supplier_features import supplier_features
from tire_pipeline.fleet import FleetSettings, make_fleet
from tire_pipeline.representations.coefficients import DATASETS, LATERAL_WITHOUT_CAMBER
from tire_pipeline.tire_table import dedupe_and_filter, normalize_table

RESULTS = Path(__file__).parent / "results" / "open_set.csv"
PAGE = Path(__file__).resolve().parents[1] / "docs" / "explanation" / "translation.md"
BEGIN = "<!-- from open_set.py -->"
KEYS = ["kind", "bias_size", "seed"]
_COEFFICIENTS = len(DATASETS["full"])
FEATURES = {
    "all": slice(None),
    "curves and zeros": slice(2 * _COEFFICIENTS),
    "curves": slice(_COEFFICIENTS),
}


def measure(kind: str, size: float, seed: int) -> pd.DataFrame:
    """Measure one fleet with each set of features."""
    counts = {"hidden_tires": 1, "tuning_tires": 1, "threads": 1}
    fleet = make_fleet(FleetSettings(seed=seed, kind=kind, bias_size=size, **counts))
    every = read_all(fleet.files)
    table = normalize_table(dedupe_and_filter(every, features=LATERAL_WITHOUT_CAMBER)[0], 6000.0)
    small = normalize_table(every[~every["category"].isin(table["category"].unique())], 6000.0)
    labels, tires = table["category"].to_numpy(str), table["tire_id"].to_numpy(str)
    values, copied = supplier_features(table)[0], supplier_features(small)[0]
    parts = []
    for name, columns in FEATURES.items():
        known = left_out_check(values[:, columns], labels, tires, seed=seed)
        found = OpenSetClassifier().fit(values[:, columns], labels, tires, seed=seed)
        given = pd.Series(found.assign(copied[:, columns]).given, index=small["category"].to_numpy(str))
        copies = given.groupby(level=0).agg(["size", "mean"]).reset_index()
        copies.columns = ["category", "files", "given_when_unseen"]
        parts.append(pd.concat([known, copies], ignore_index=True).assign(features=name))
    found = pd.concat(parts, ignore_index=True).assign(kind=kind, bias_size=size, seed=seed)
    return found[[*KEYS, "features", "category", "files", "right", "wrong", "given_when_unseen"]].round(4)


def summary(found: pd.DataFrame, by: tuple[str, ...] = ("features", "kind", "bias_size")) -> pd.DataFrame:
    """By features, kind and size: shares over all files, and the worst category of any fleet."""
    rows = []
    for keys, own in found.groupby(list(by)):
        known = own["right"].notna()
        large, copies = own[known], own[~known]
        weights = large["files"] / large["files"].sum()
        rows.append(
            {
                **dict(zip(by, keys, strict=True)),
                "right": float(np.dot(large["right"], weights)),
                "right_worst": large["right"].min(),
                "wrong": float(np.dot(large["wrong"], weights)),
                "given_when_unseen": large["given_when_unseen"].mean(),
                "given_when_unseen_worst": large["given_when_unseen"].max(),
                "copies_given": np.average(copies["given_when_unseen"], weights=copies["files"]),
            }
        )
    return pd.DataFrame(rows).round(3)


def write_table(found: pd.DataFrame) -> None:
    """Put the summary over the kinds of fleets into docs/explanation/translation.md."""
    shares = ["right", "right, worst", "to another", "unseen", "unseen, worst", "copies"]
    rows = [
        [row[0], f"{row[1]:g}", *(f"{value:.3f}" for value in row[2:])]
        for row in summary(found, ("features", "bias_size")).itertuples(index=False)
    ]
    head = ["features", "bias size", *shares]
    write_between(PAGE, BEGIN, markdown(head, rows))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, nargs="+", default=[31, 32, 33])
    parser.add_argument("--kinds", nargs="+", default=["additive", "interacting", "drifting"])
    parser.add_argument("--sizes", type=float, nargs="+", default=[1.0, 0.3])
    parser.add_argument("--results", type=Path, default=RESULTS)
    parser.add_argument("--write", action="store_true", help="write it into docs/explanation/translation.md")
    asked = parser.parse_args()
    asked.results.parent.mkdir(parents=True, exist_ok=True)
    for seed in asked.seeds:
        for size in asked.sizes:
            for kind in asked.kinds:
                done = pd.read_csv(asked.results) if asked.results.exists() else pd.DataFrame(columns=KEYS)
                if (done[KEYS] == [kind, size, seed]).all(axis=1).any():
                    continue
                started = time.perf_counter()
                found = measure(kind, size, seed)
                pd.concat([done, found] if len(done) else [found]).to_csv(asked.results, index=False)
                print(kind, size, seed, f"{time.perf_counter() - started:.0f} s", file=sys.stderr, flush=True)
    found = pd.read_csv(asked.results)
    print(summary(found).to_string(index=False))
    if asked.write:
        write_table(found)


if __name__ == "__main__":
    main()
