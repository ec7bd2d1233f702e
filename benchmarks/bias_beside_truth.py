"""RQ4 on fleets of several seeds: the reported bias of every pair of organisations beside the sealed truth.

Writes ``benchmarks/results/translation_bias.csv`` and ``translation_bias_truth.csv``, for the page. The truth
is the mean over 100 tires and so has an error, too: how many biases lie inside is said without and with it.
"""

from __future__ import annotations

import argparse

import numpy as np
import pandas as pd
from bench_translation import RESULTS, read_all

from tire_pipeline.evaluation.bias_truth import bias_beside_truth, measured_bias, regime_differences
from tire_pipeline.fleet import FleetSettings, make_fleet
from tire_pipeline.representations.coefficients import LATERAL_WITHOUT_CAMBER
from tire_pipeline.tire_table import dedupe_and_filter, normalize_table
from tire_pipeline.translation.bias_report import BiasReport, bias_report
from tire_pipeline.translation.translator import MixedModel


def inside_with_error(both: pd.DataFrame) -> float:
    """Share of the true biases inside the intervals, these widened by the truth's own standard error."""
    low, high, true = (np.log1p(both[name]) for name in ("low", "high", "true_bias"))
    half = np.hypot(0.5 * (high - low), 1.6449 * both["true_error"])
    return float((np.abs(true - 0.5 * (low + high)) <= half).mean())


def one_fleet(seed: int, coefficients: bool) -> tuple[BiasReport, pd.DataFrame]:
    """The report on one fleet, and its regions beside the truth."""
    fleet = make_fleet(FleetSettings(seed=seed, threads=1, tuning_tires=1))
    kept, _ = dedupe_and_filter(read_all(fleet.files), features=LATERAL_WITHOUT_CAMBER)
    training = normalize_table(kept, 6000.0)
    sealed = {name: text for name, text in fleet.truth.first.items() if name.startswith("hidden")}
    measured = measured_bias(
        normalize_table(read_all(sealed), 6000.0), np.array([2000.0, 4000.0, 6000.0, 8000.0])
    )
    translator = MixedModel(pairs=True).fit(training, target=fleet.settings.target, seed=seed)
    report = bias_report(translator, training, coefficients=coefficients)
    both = bias_beside_truth(report.by_region, measured)
    print(
        f"seed {seed}: {both['inside'].mean():.0%} of {len(both)} true biases lie in the 90% interval, "
        f"{inside_with_error(both):.0%} if the truth's own standard error is counted",
        flush=True,
    )
    print(regime_differences(fleet.truth.regimes, "D", "B"))
    return report, both


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, nargs="+", default=[7, 8, 9], help="the first goes to the page")
    parser.add_argument("--coefficients", action="store_true")
    asked = parser.parse_args()
    found = [one_fleet(seed, asked.coefficients) for seed in asked.seeds]
    report, both = found[0]
    report.by_region.to_csv(RESULTS.with_name("translation_bias.csv"), index=False, float_format="%.5g")
    both.to_csv(RESULTS.with_name("translation_bias_truth.csv"), index=False, float_format="%.5g")
    every = pd.concat([own for _, own in found])
    print(f"all: {every['inside'].mean():.0%}, with the truth's error {inside_with_error(every):.0%}")


if __name__ == "__main__":
    main()
