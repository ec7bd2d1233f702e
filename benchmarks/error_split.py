"""Where the error of the translator with pairs comes from, on tuning tires; parts of it put right by truth.

    python benchmarks/error_split.py           # prints
    python benchmarks/error_split.py --write   # puts the table between the marks in docs/translation.md

Nothing here is a translator: biases put right are fitted on the sealed truth, each tire's by the other tires;
parts put right are the tire's own truth.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
from bench_translation import Judge, load_fleet
from doc_tables import markdown, write_between
from sklearn.linear_model import RidgeCV
from sklearn.model_selection import GroupKFold, cross_val_predict

from tire_pipeline.evaluation import curves_of, evaluate_translations
from tire_pipeline.translation.curve_translator import MixedModel, PairedMixedModel

PAGE = Path(__file__).parent.parent / "docs" / "translation.md"
BEGIN = "<!-- from error_split.py -->"
METRICS = ["forces", "cornering_stiffness", "peak_friction"]
PARTS = ("cornering stiffness", "lateral friction", "lateral shape")
ROWS = (
    "as it is",
    "mean bias of each actor right",
    "bias right as far as the file's curves and metadata tell it",
    *(f"{part} right" for part in PARTS),
    "all scores right",
)


class Errors:
    """Errors of a table of translations: forces, stiffness, peak friction."""

    def __init__(self, judge: Judge) -> None:
        self.before, self.after = (curves_of(t, lateral_only=True) for t in (judge.inputs, judge.target))

    def of(self, table: pd.DataFrame) -> np.ndarray:
        """Mean squared errors over those of the untranslated files, (3,)."""
        found = evaluate_translations(
            curves_of(table, lateral_only=True), self.before, self.after, lateral_only=True
        )
        return found.summary.loc[METRICS, "ratio"].to_numpy()


def learned(judge: Judge, gap: np.ndarray, known: np.ndarray | None) -> np.ndarray:
    """What of ``gap`` (n, p) a ridge on ``known`` (n, d), or the mean alone, tells of tires left out."""
    out = np.zeros_like(gap)
    for category in np.unique(judge.inputs["category"]):
        own = np.flatnonzero(judge.inputs["category"] == category)
        folds = GroupKFold(min(10, own.size))
        if known is None:
            for others, left in folds.split(own, groups=judge.tire[own]):
                out[own[left]] = gap[own[others]].mean(axis=0)
            continue
        x = (known[own] - known[own].mean(axis=0)) / (known[own].std(axis=0) + 1e-9)
        ridge = RidgeCV(np.logspace(0, 5, 11), alpha_per_target=True)
        out[own] = cross_val_predict(ridge, x, gap[own], cv=folds, groups=judge.tire[own])
    return out


def split(judge: Judge, translator: MixedModel) -> pd.DataFrame:
    """Errors as multiples of the floor's, one line for each of ``ROWS``."""
    space = translator.model.space
    found = translator.predict(judge.inputs)
    target, _ = space.encode(judge.target)
    gap = target - found.target
    known = np.concatenate([found.source, translator.model.metadata.regressors(judge.inputs)], axis=1)
    wanted = [
        found.target,
        found.target + learned(judge, gap, None),
        found.target + learned(judge, gap, known),
    ]
    for part in PARTS:
        scores = found.target.copy()
        scores[:, space.slices[part]] = target[:, space.slices[part]]
        wanted.append(scores)
    errors = Errors(judge)
    floor = errors.of(judge.second)
    tables = [translator._decode(judge.inputs, replace(found, target=one)) for one in (*wanted, target)]
    found_ratios = [errors.of(table) / floor for table in tables]
    return pd.DataFrame(found_ratios, index=pd.Index(ROWS, name="what"), columns=METRICS)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kinds", nargs="+", default=["additive", "drifting", "interacting"])
    parser.add_argument("--seeds", type=int, nargs="+", default=[202])
    parser.add_argument("--write", action="store_true")
    asked = parser.parse_args()
    columns = {}
    for kind in asked.kinds:
        of_seeds = []
        for seed in asked.seeds:
            target, training, judges = load_fleet(kind, 1.0, seed, ("tuning",))
            translator = PairedMixedModel().fit(training, target=target, seed=seed)
            of_seeds.append(split(judges["tuning"], translator))
        mean = sum(of_seeds) / len(of_seeds)
        columns[kind] = [" / ".join(f"{value:.2f}" for value in row) for row in mean.to_numpy()]
    rows = [(what, *(columns[kind][i] for kind in asked.kinds)) for i, what in enumerate(ROWS)]
    text = markdown(("", *asked.kinds), rows)
    seeds = ", ".join(map(str, asked.seeds))
    head = f"Tuning tires (seeds: {seeds}) at the calibrated bias, forces / stiffness / peak friction."
    text = f"{head}\n\n{text}"
    print(text)
    if asked.write:
        write_between(PAGE, BEGIN, text)


if __name__ == "__main__":
    main()
