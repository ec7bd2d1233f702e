"""Where the error of the translator with pairs comes from, on tuning tires: parts of it put right by truth,
and how it shrinks with more tires that all organisations measured.

    python benchmarks/error_split.py           # prints
    python benchmarks/error_split.py --write   # puts the table into docs/explanation/translation_results.md

Biases put right are fitted on the sealed truth of the tires that are not judged; parts put right are the
tire's own truth: nothing of that is a translator. Rows with more pairs are: they have the first measurement
of such tires by all organisations beside the training files, and nothing else. Other tires than those judged.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
from bench_translation import Judge, judge_of, make_judged_fleet, training_of
from doc_tables import markdown, write_between
from joblib import Parallel, delayed
from sklearn.linear_model import RidgeCV

from tire_pipeline.evaluation import curves_of, evaluate_translations
from tire_pipeline.translation.population.model import Prediction
from tire_pipeline.translation.translator import MixedModel

PAGE = Path(__file__).parent.parent / "docs" / "explanation" / "translation_results.md"
BEGIN = "<!-- from error_split.py -->"
METRICS = ["forces", "cornering_stiffness", "peak_friction"]
PARTS = ("cornering stiffness", "lateral friction", "lateral shape")
JUDGED = 200
"""Tires that are judged; the others teach what truth could tell, or serve as further pairs."""
MORE_PAIRS = (8, 24, 56)
"""Tires that all organisations measured, beyond the fleet's own eight."""


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


def learned(judge: Judge, gap: np.ndarray, known: np.ndarray | None, judged: np.ndarray) -> np.ndarray:
    """What of ``gap`` (n, p) a ridge on ``known`` (n, d), or the mean alone, tells of the judged rows.

    It is fitted to the other rows of the same category; the result is (judged, p).
    """
    out = np.zeros_like(gap)
    category = judge.inputs["category"].to_numpy(dtype=str)
    for name in np.unique(category):
        taught, asked = (np.flatnonzero((category == name) & side) for side in (~judged, judged))
        if known is None:
            out[asked] = gap[taught].mean(axis=0)
            continue
        middle, spread = known[taught].mean(axis=0), known[taught].std(axis=0) + 1e-9
        ridge = RidgeCV(np.logspace(0, 5, 11), alpha_per_target=True)
        ridge.fit((known[taught] - middle) / spread, gap[taught])
        out[asked] = ridge.predict((known[asked] - middle) / spread)
    return out[judged]


def put_right(judge: Judge, translator: MixedModel, judged: np.ndarray) -> dict[str, Prediction]:
    """The translator's prediction for the judged rows, and the same with parts put right."""
    space = translator.model.space
    found = translator.predict(judge.inputs)
    target, _ = space.encode(judge.target)
    gap = target - found.target
    known = np.concatenate([found.source, translator.model.metadata.regressors(judge.inputs)], axis=1)
    own = Prediction(**{name: getattr(found, name)[judged] for name in vars(found)})
    wanted = {
        "as it is": own.target,
        "mean bias of each organisation right": own.target + learned(judge, gap, None, judged),
        "bias right as far as the file's curves and metadata tell it": own.target
        + learned(judge, gap, known, judged),
    }
    for part in PARTS:
        scores = own.target.copy()
        scores[:, space.slices[part]] = target[judged][:, space.slices[part]]
        wanted[f"{part} right"] = scores
    wanted["all scores right"] = target[judged]
    return {what: replace(own, target=scores) for what, scores in wanted.items()}


def decoded(translator: MixedModel, rows: pd.DataFrame, found: Prediction) -> pd.DataFrame:
    """Tires of the predicted scores, whatever the verdict."""
    return translator.parts.decoder.decode(translator.model, rows, found)


def split(kind: str, seed: int, tires: int) -> pd.DataFrame:
    """Errors as multiples of the floor's, one line for each thing that is put right."""
    fleet = make_judged_fleet(kind, 1.0, seed, ("tuning",), tires)
    target, training, every = fleet.settings.target, training_of(fleet), judge_of(fleet, "tuning")
    names = np.unique(every.tire)
    judged = np.isin(every.tire, names[:JUDGED])
    rows, truth, second = (
        t[judged].reset_index(drop=True) for t in (every.inputs, every.target, every.second)
    )
    errors = Errors(Judge(rows, *(t.drop_duplicates("file") for t in (truth, second))))
    floor = errors.of(second)
    translator = MixedModel(pairs=True).fit(training, target=target, seed=seed)
    found = {
        what: errors.of(decoded(translator, rows, one)) / floor
        for what, one in put_right(every, translator, judged).items()
    }
    others = {"without pairs": MixedModel(pairs=False).fit(training, target=target, seed=seed)}
    measured = pd.concat([every.inputs, every.target.drop_duplicates("file")], ignore_index=True)
    tire = measured["file"].str.split("/").str[-1].to_numpy()
    for more in MORE_PAIRS:
        further = measured[np.isin(tire, names[JUDGED : JUDGED + more])]
        table = pd.concat([training, further], ignore_index=True)
        what = f"{fleet.settings.paired_tires + more} tires measured by all"
        others[what] = MixedModel(pairs=True).fit(table, target=target, seed=seed)
    for what, other in others.items():
        found[what] = errors.of(decoded(other, rows, other.predict(rows))) / floor
    return pd.DataFrame.from_dict(found, orient="index", columns=METRICS)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kinds", nargs="+", default=["additive", "drifting", "interacting"])
    parser.add_argument("--seeds", type=int, nargs="+", default=[213, 214, 215])
    parser.add_argument("--tires", type=int, default=1000)
    parser.add_argument("--write", action="store_true")
    asked = parser.parse_args()
    jobs = [(kind, seed) for kind in asked.kinds for seed in asked.seeds]
    tables = Parallel(n_jobs=2)(delayed(split)(kind, seed, asked.tires) for kind, seed in jobs)
    columns = {}
    for kind in asked.kinds:
        own = [table for (of, _), table in zip(jobs, tables, strict=True) if of == kind]
        mean = sum(table.to_numpy() for table in own) / len(own)
        columns[kind] = [" / ".join(f"{value:.2f}" for value in row) for row in mean]
    rows = [(what, *(columns[kind][i] for kind in asked.kinds)) for i, what in enumerate(tables[0].index)]
    seeds = ", ".join(map(str, asked.seeds))
    head = (
        f"{JUDGED} tuning tires of each fleet (seeds {seeds}) at the calibrated bias, forces / stiffness / "
        f"peak friction; truth of {asked.tires - JUDGED} others."
    )
    text = f"{head}\n\n{markdown(('', *asked.kinds), rows)}"
    print(text)
    if asked.write:
        write_between(PAGE, BEGIN, text)


if __name__ == "__main__":
    main()
