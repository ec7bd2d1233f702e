"""How often the 90% band of a supplier's bias, as ``translate`` gives it for each file, holds the true bias.

    python benchmarks/bias_bands.py --seeds 34

One fleet (bias size, seed) after another; its lines go to ``benchmarks/results/bias_bands.csv``, and fleets
that are in there already are not measured again. The true bias is the mean over 100 tires, none of them
learned from, of the target's sealed file less the supplier's; the band is the mean of the files' bands.
``files_holding_zero`` is the share of files of which this part's band holds zero. Nothing was fitted to this:
the bands' width (``effects.QUANTILE``) is older.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import numpy as np
import pandas as pd
from bench_translation import labelled, load_fleet

from tire_pipeline.translation.curves.space import PARTS, UNIT
from tire_pipeline.translation.judge.bias_band import bias_band
from tire_pipeline.translation.judge.effects import KEY_PARTS

RESULTS = Path(__file__).parent / "results" / "bias_bands.csv"
KEYS = ["bias_size", "seed", "translator"]


def measure(size: float, seed: int, names: list[str]) -> pd.DataFrame:
    """Measure the bands of each translator on one additive fleet."""
    target, training, judges = load_fleet("additive", size, seed, ("tuning",))
    judge = judges["tuning"]
    organisations = judge.inputs["category"].to_numpy(str)
    rows = []
    for name in names:
        translator = labelled(name).fit(training, target=target, seed=seed)
        model = translator.model
        band = bias_band(model, translator.predict(judge.inputs))
        verdict = translator.translation(judge.inputs, bands=False).report["verdict"].to_numpy(str)
        source, theirs = (model.space.encode(table)[0] for table in (judge.inputs, judge.target))
        for k, part in enumerate(KEY_PARTS):
            place = model.space.slices[part]
            along = model.space.back[part].mean(axis=1) * UNIT[PARTS[part].group]
            true = np.expm1((source - theirs)[:, place] @ along)
            for organisation in np.unique(organisations):
                own = organisations == organisation
                low, high = band.low[own, k], band.high[own, k]
                mean = true[own].mean()
                rows.append(
                    {
                        "translator": name,
                        "organisation": organisation,
                        "part": part,
                        "true_bias": mean,
                        "low": low.mean(),
                        "high": high.mean(),
                        "holds": low.mean() <= mean <= high.mean(),
                        "files_holding_zero": ((low <= 0.0) & (high >= 0.0)).mean(),
                        "already_unbiased": (verdict[own] == "already unbiased").mean(),
                    }
                )
    return pd.DataFrame(rows).assign(bias_size=size, seed=seed).round(4)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, nargs="+", default=[34])
    parser.add_argument("--sizes", type=float, nargs="+", default=[0.0, 1.0])
    parser.add_argument("--names", nargs="+", default=["paired_mixed_model", "mixed_model"])
    parser.add_argument("--results", type=Path, default=RESULTS)
    asked = parser.parse_args()
    asked.results.parent.mkdir(parents=True, exist_ok=True)
    for seed in asked.seeds:
        for size in asked.sizes:
            done = pd.read_csv(asked.results) if asked.results.exists() else pd.DataFrame(columns=KEYS)
            made = done[(done["bias_size"] == size) & (done["seed"] == seed)]
            names = [name for name in asked.names if name not in set(made["translator"])]
            if not names:
                continue
            started = time.perf_counter()
            found = measure(size, seed, names)
            pd.concat([done, found] if len(done) else [found]).to_csv(asked.results, index=False)
            print(size, seed, f"{time.perf_counter() - started:.0f} s", file=sys.stderr, flush=True)
    found = pd.read_csv(asked.results)
    print(found.groupby(["bias_size", "translator"])[["holds", "files_holding_zero"]].mean().to_string())


if __name__ == "__main__":
    main()
