"""Every translator on the same hidden tires: kinds of fleet x bias sizes x seeds, with floor and oracle.

    python benchmarks/bench_translation.py --seeds 19 20 21 --sizes 1 0.6 0.3 0

One line a fleet and translator goes to ``benchmarks/results/translation.csv``; fleets that are in there
already are not measured again. Everything about the translators was fixed on tuning sets of other seeds (201
to 215) before the hidden sets of seeds 19 to 21 were looked at; those of seeds 1 to 18 had been looked at
before the last change. The oracle is fitted here, on the hidden truth itself.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from sklearn.linear_model import RidgeCV
from sklearn.model_selection import GroupKFold, cross_val_predict

from tire_pipeline.evaluation import Curves, curves_of, evaluate_translations
from tire_pipeline.fleet import Fleet, FleetSettings, make_fleet
from tire_pipeline.reporting.translation.translation_page import MIXED
from tire_pipeline.representations.coefficients import LATERAL_WITHOUT_CAMBER
from tire_pipeline.tir import read_tir
from tire_pipeline.tire_table import dedupe_and_filter, from_models, normalize_table
from tire_pipeline.translation.base import make_translator
from tire_pipeline.translation.curves.pure_slip import (
    Points,
    aligning_torque,
    columns,
    lateral_force,
    longitudinal_force,
)
from tire_pipeline.translation.judge.leave_one_out import leave_one_tire_out
from tire_pipeline.translation.population.fit_model import PreparedTraining, prepare
from tire_pipeline.translation.population.fit_space import fit_curve_space
from tire_pipeline.translation.result import TRANSLATED, TranslationResult
from tire_pipeline.translation.translator import COEFFICIENTS, MixedModel

RESULTS = Path(__file__).parent / "results" / "translation.csv"
ALWAYS = ("no_change", "greedy_forest", *MIXED)
AT_CALIBRATED = ("likelihood_agent", "curious_agent", "cycle_consistent")
_FORCES = {"fy": lateral_force, "fx": longitudinal_force, "mz": aligning_torque}


def read_all(files: Mapping[str, str]) -> pd.DataFrame:
    """Files by ``.../<category>/<name>`` to a tire table."""
    models = (
        (path, path.split("/")[-2], read_tir(text.encode("latin-1"), path=path))
        for path, text in files.items()
    )
    return from_models(models)


class Judge:
    """One set of evaluation tires with the target's sealed measurements."""

    def __init__(self, inputs: pd.DataFrame, first: pd.DataFrame, second: pd.DataFrame) -> None:
        self.inputs = inputs
        name = inputs["file"].str.split("/").str[-1]
        self.target, self.second = (
            t.set_index(t["file"].str.split("/").str[-1]).loc[name].reset_index(drop=True)
            for t in (first, second)
        )
        self.tire = name.to_numpy()
        self.source_curves, self.target_curves = curves_of(inputs), curves_of(self.target)

    def measure(self, table: pd.DataFrame | Curves) -> dict[str, float]:
        curves = table if isinstance(table, Curves) else curves_of(table)
        found = evaluate_translations(curves, self.source_curves, self.target_curves)
        self.per_file = found.per_file
        row = {
            f"ratio_{name}": found.summary.loc[name, "ratio"]
            for name in found.summary.index
            if name != "mean"
        }
        return {**row, "improved": found.summary.loc["mean", "improved"]}

    def judge_result(self, result: TranslationResult, ungated: pd.DataFrame) -> dict[str, float]:
        """Coverage of the bands; precision and recall of not translating."""
        found = {}
        truth = columns(self.target)
        for name, band in result.bands.items():
            points = Points.grid(band.slip, band.normal_load, [0.0])
            values = _FORCES[name](truth, points).reshape(band.middle.shape)
            known = np.isfinite(band.low).all(axis=(1, 2))
            inside = ((values >= band.low) & (values <= band.high))[known]
            found[f"coverage_{name}"] = inside.mean() if inside.size else np.nan
        self.measure(ungated)
        metrics = ("forces", "cornering_stiffness", "peak_friction")
        relative = sum(self.per_file[m] / self.per_file[f"{m}_untranslated"].mean() for m in metrics)
        before = sum(
            self.per_file[f"{m}_untranslated"] / self.per_file[f"{m}_untranslated"].mean() for m in metrics
        )
        grown = (relative > before).to_numpy()
        kept = (result.report["verdict"] != TRANSLATED).to_numpy()
        found["left_alone"] = kept.mean()
        found["harmful"] = grown.mean()
        found["refusal_precision"] = grown[kept].mean() if kept.any() else np.nan
        found["refusal_recall"] = kept[grown].mean() if grown.any() else np.nan
        return found


def without_gate(translator: MixedModel, inputs: pd.DataFrame, result: TranslationResult) -> pd.DataFrame:
    """What would have come out if nothing had been left alone."""
    table = result.table.copy()
    kept = (result.report["verdict"] != TRANSLATED).to_numpy()
    if kept.any():
        names = list(COEFFICIENTS)
        table.loc[kept, names] = translator.with_verdict(gate=False).translate(inputs[kept])[names].to_numpy()
    return table


def oracle(judge: Judge, translator: MixedModel) -> pd.DataFrame:
    """Ridge of the hidden truth on the source's scores and metadata; tires left out in folds."""
    rows = judge.inputs
    found = translator.predict(rows)
    target, _ = translator.model.space.encode(judge.target)
    known = np.concatenate([found.source, translator.model.metadata.regressors(rows)], axis=1)
    moved = np.zeros_like(found.source)
    for category in np.unique(rows["category"]):
        own = (rows["category"] == category).to_numpy()
        x = (known[own] - known[own].mean(axis=0)) / (known[own].std(axis=0) + 1e-9)
        ridge = RidgeCV(np.logspace(0, 5, 11), alpha_per_target=True)
        folds = GroupKFold(min(10, own.sum()))
        moved[own] = cross_val_predict(
            ridge, x, (target - found.source)[own], cv=folds, groups=judge.tire[own]
        )
    return translator.parts.decoder.decode(
        translator.model, rows, replace(found, target=found.source + moved)
    )


def labelled(label: str) -> Any:
    """The translator of a row of the results: a mixed model's label says its options."""
    if label not in MIXED:
        return make_translator(label)
    options = {"pairs": label.startswith("paired"), "learn_from_batch": "batch" in label}
    return make_translator("mixed_model", **options)


def make_judged_fleet(kind: str, size: float, seed: int, sets: tuple[str, ...], tires: int = 100) -> Fleet:
    """Make one fleet with so many tires in each of the evaluation sets ``sets``."""
    counts = {f"{name}_tires": tires if name in sets else 1 for name in ("tuning", "hidden")}
    return make_fleet(FleetSettings(seed=seed, kind=kind, bias_size=size, threads=1, **counts))


def training_of(fleet: Fleet) -> pd.DataFrame:
    """The training files as a table."""
    kept, _ = dedupe_and_filter(read_all(fleet.files), features=LATERAL_WITHOUT_CAMBER)
    return normalize_table(kept, 6000.0).reset_index(drop=True)


def evaluation_table(files: Mapping[str, str], name: str, categories: tuple[str, ...] = ()) -> pd.DataFrame:
    """The files of one evaluation set, of these categories only if any are named."""
    chosen = {
        path: text
        for path, text in files.items()
        if path.startswith(f"{name}/") and (not categories or path.split("/")[1] in categories)
    }
    return normalize_table(read_all(chosen).reset_index(drop=True), 6000.0)


def judge_of(fleet: Fleet, name: str) -> Judge:
    """The judge of one evaluation set."""
    own = (fleet.settings.target,)
    truth = (evaluation_table(files, name, own) for files in (fleet.truth.first, fleet.truth.second))
    return Judge(evaluation_table(fleet.evaluation, name), *truth)


def load_fleet(
    kind: str, size: float, seed: int, sets: tuple[str, ...]
) -> tuple[str, pd.DataFrame, dict[str, Judge]]:
    """Make one fleet: its target, training table and, by evaluation set, judge."""
    fleet = make_judged_fleet(kind, size, seed, sets)
    return fleet.settings.target, training_of(fleet), {name: judge_of(fleet, name) for name in sets}


def measure_fleet(
    kind: str, size: float, seed: int, names: tuple[str, ...], sets: tuple[str, ...]
) -> pd.DataFrame:
    """Measure every translator on one fleet."""
    target, training, judges = load_fleet(kind, size, seed, sets)
    rows = []
    shared = fit_curve_space(training)
    prepared: dict[bool, PreparedTraining] = {}
    for name in names:
        started = time.perf_counter()
        options: dict[str, Any] = {}
        if name not in ("no_change", "greedy_forest"):
            pairs = name.startswith("paired")
            if pairs not in prepared:
                prepared[pairs] = prepare(training, pairs=pairs, space_and_cells=shared)
            options["made"] = prepared[pairs]
        translator = labelled(name).fit(training, target=target, seed=seed, **options)
        fitted = time.perf_counter() - started
        for where, judge in judges.items():
            started = time.perf_counter()
            found: dict[str, float] = {"fit_seconds": fitted}
            if name in MIXED:
                result = translator.translation(judge.inputs)
                found["translate_seconds"] = time.perf_counter() - started
                table = result.table
                found |= judge.judge_result(result, without_gate(translator, judge.inputs, result))
            else:
                table = translator.translate(judge.inputs)
                found["translate_seconds"] = time.perf_counter() - started
            rows.append({"set": where, "translator": name, **judge.measure(table), **found})
        if name in ("mixed_model", "paired_mixed_model"):
            left = leave_one_tire_out(
                training, target, pairs=pairs, model=translator.model, made=prepared[pairs]
            )
            rows.append(
                {
                    "set": "leave one tire out",
                    "translator": name,
                    "ratio_features": left["error"].sum() / left["error_unchanged"].sum(),
                    "improved": (left["ratio"] < 1.0).mean(),
                }
            )
        if name == "paired_mixed_model" and "hidden" in judges:
            judge = judges["hidden"]
            rows.append({"set": "hidden", "translator": "floor", **judge.measure(judge.second)})
            best = judge.measure(oracle(judge, translator))
            rows.append({"set": "hidden", "translator": "oracle", **best})
    return pd.DataFrame(rows).assign(kind=kind, bias_size=size, seed=seed)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, nargs="+", default=[19, 20, 21])
    parser.add_argument("--kinds", nargs="+", default=["additive", "interacting", "drifting"])
    parser.add_argument("--sizes", type=float, nargs="+", default=[1.0, 0.3, 0.6, 0.0])
    parser.add_argument("--sets", nargs="+", choices=["tuning", "hidden"], default=["hidden"])
    parser.add_argument("--names", nargs="+", help="translators, instead of all")
    parser.add_argument("--results", type=Path, default=RESULTS)
    asked = parser.parse_args()
    asked.results.parent.mkdir(parents=True, exist_ok=True)
    for size in asked.sizes:
        for seed in asked.seeds:
            for kind in asked.kinds:
                done = pd.read_csv(asked.results) if asked.results.exists() else pd.DataFrame()
                if kind == "drifting" and size == 0.0:
                    continue  # all protocols are the same then: byte for byte the additive fleet
                if len(done) and ((done.kind == kind) & (done.bias_size == size) & (done.seed == seed)).any():
                    continue
                started = time.perf_counter()
                every = (*ALWAYS, *AT_CALIBRATED) if size == 1.0 and kind == "additive" else ALWAYS
                names = tuple(asked.names or every)
                found = measure_fleet(kind, size, seed, names, tuple(asked.sets))
                pd.concat([done, found], ignore_index=True).to_csv(asked.results, index=False)
                print(kind, size, seed, f"{time.perf_counter() - started:.0f} s", file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
