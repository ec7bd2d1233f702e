"""The classifier's figures on the demonstration fleet, beside the thesis' (docs/explanation/fleet.md).

python benchmarks/calibrate_fleet.py 1 2 3
"""

from __future__ import annotations

import sys

import numpy as np
import pandas as pd

from tire_pipeline.classifiers.evaluate import evaluate_classifier
from tire_pipeline.fleet import FleetSettings, make_fleet
from tire_pipeline.progress import track
from tire_pipeline.representations import make_representation
from tire_pipeline.tir import read_tir
from tire_pipeline.tire_table import dedupe_and_filter, from_models, normalize_table, split_table

THESIS = {
    ("random_forest", True, "random"): 0.970,
    ("naive_bayes", False, "random"): 0.801,
    ("naive_bayes", True, "random"): 0.765,
    ("ann", True, "random"): 0.954,
}
TRAININGS = 3


def figures(seed: int) -> pd.DataFrame:
    """Accuracies on one fleet."""
    fleet = make_fleet(FleetSettings(seed=seed))
    texts = track(fleet.files.items(), "reading the fleet", total=len(fleet.files))
    raw = from_models((path, path.split("/")[0], read_tir(text.encode("cp1252"))) for path, text in texts)
    encoder = make_representation("coefficients")
    kept, _ = dedupe_and_filter(raw, features=encoder.feature_names)
    table = normalize_table(kept, 6000.0)
    splits = split_table(table, seed=seed)
    features, labels = encoder.encode(table), table["category"].to_numpy(dtype=str)
    rows = []
    for name, smote in (
        ("random_forest", True),
        ("naive_bayes", False),
        ("naive_bayes", True),
        ("ann", True),
    ):
        for split in ("random", "by_tire"):
            train = np.flatnonzero(splits[split] == "train")
            test = np.flatnonzero(splits[split] == "test")
            result = evaluate_classifier(
                name, features, labels, train, test, seeds=range(TRAININGS), smote=smote
            )
            rows.append(
                {
                    "classifier": name,
                    "smote": smote,
                    "split": split,
                    "seed": seed,
                    "accuracy": result.accuracy,
                }
            )
    return pd.DataFrame(rows)


def main() -> None:
    """Print the table."""
    seeds = [int(each) for each in sys.argv[1:]] or [1]
    every = pd.concat([figures(seed) for seed in seeds])
    keys = ["classifier", "smote", "split"]
    table = every.pivot_table(index=keys, columns="seed", values="accuracy", sort=False)
    table["mean"] = table.mean(axis=1)
    table["thesis"] = [THESIS.get(key, float("nan")) for key in table.index]
    print(table.round(3).to_string())


if __name__ == "__main__":
    main()
