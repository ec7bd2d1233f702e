"""Write the figures of docs/explanation/translation_results.md from ``benchmarks/results/translation.csv``.

python benchmarks/translation_tables.py          # prints
python benchmarks/translation_tables.py --write  # puts them into docs/explanation/translation_results.md
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
import pandas as pd
from doc_tables import markdown, write_between

from tire_pipeline.reporting.translation.translation_page import MIXED, check_goals

ROOT = Path(__file__).parent.parent
RESULTS = ROOT / "benchmarks" / "results" / "translation.csv"
BANDS = RESULTS.with_name("translation_bands.csv")
PAGE = ROOT / "docs" / "explanation" / "translation_results.md"
BIAS = RESULTS.with_name("translation_bias_truth.csv")
BEGIN_SUMMARY = "<!-- summary, from translation_tables.py -->"
BEGIN_GOALS = "<!-- goals, from translation_tables.py -->"
BEGIN_BIAS = "<!-- bias, from translation_tables.py -->"
BEGIN_BANDS = "<!-- bands, from translation_tables.py -->"
BEGIN = "<!-- from translation_tables.py -->"

RATIOS = ["ratio_forces", "ratio_cornering_stiffness", "ratio_peak_friction"]
MORE = ["ratio_forces_camber", "ratio_fx", "ratio_mz"]
COVERAGE = ["coverage_fy", "coverage_fx", "coverage_mz"]


def _slashed(values: pd.Series) -> str:
    return " / ".join(f"{value:.3f}" for value in values)


def in_short(hidden: pd.DataFrame) -> str:
    """RMS errors that the mixed models leave at the calibrated bias, beside the floor's."""
    own = hidden[hidden["bias_size"] == 1.0]
    rows = []
    for kind, fleets in own.groupby("kind"):
        for name in (*MIXED, "floor"):
            mine = fleets[fleets["translator"] == name]
            left = np.sqrt(mine[RATIOS].mean())
            cells = [f"{value:.0%}" for value in (*left, mine["improved"].mean())]
            rows.append((str(kind), name, *cells))
    head = ("fleet", "translator", "forces", "cornering stiffness", "peak friction", "files improved")
    return markdown(head, rows)


def bias_inside() -> str:
    """How often the reported bias holds the true one."""
    beside = pd.read_csv(BIAS)
    return f"Of the {len(beside)} intervals measured last, {beside['inside'].mean():.0%} hold the true bias."


def bands_inside(hidden: pd.DataFrame) -> str:
    """How much of the target's measurement the bands hold, where each was measured last."""
    own, last = hidden[hidden["bias_size"] == 1.0], pd.read_csv(BANDS)
    last = last[last["set"] == "hidden"]
    before = own[own["translator"].isin(set(MIXED) - set(last["translator"]))]
    means = pd.concat([before, last]).groupby(["kind", "translator"])[COVERAGE].mean()
    said = ", ".join(
        f"{means[column].min():.0%} to {means[column].max():.0%} in {output}"
        for column, output in zip(COVERAGE, ("Fy", "Fx", "Mz"), strict=True)
    )
    return f"The 90% bands hold {said} (shares of the target's points, by kind of fleet and translator)."


def by_fleet(hidden: pd.DataFrame) -> str:
    """Ratios of the mixed models, the floor and the oracle, by kind and size."""
    rows = []
    for (kind, size), own in hidden.groupby(["kind", "bias_size"]):
        for name in (*MIXED, "floor", "oracle"):
            mine = own[own["translator"] == name]
            if mine.empty:
                continue
            rows.append(
                (
                    str(kind),
                    f"{size:g}",
                    name,
                    str(len(mine)),
                    _slashed(mine[RATIOS].mean()),
                    _slashed(mine[RATIOS].max()),
                    f"{mine['improved'].mean():.2f}",
                )
            )
    return markdown(("kind", "size", "translator", "seeds", "mean ratios", "worst ratios", "improved"), rows)


def all_translators(hidden: pd.DataFrame) -> str:
    """Every translator on the additive fleets of the calibrated bias."""
    own = hidden[(hidden["kind"] == "additive") & (hidden["bias_size"] == 1.0)]
    rows = []
    for name in own["translator"].unique():
        mine = own[own["translator"] == name]
        worst = _slashed(mine[RATIOS].max())
        means = (_slashed(mine[RATIOS].mean()), worst, _slashed(mine[MORE].mean()))
        seeds = " ".join(str(seed) for seed in sorted(mine["seed"]))
        rows.append((str(name), seeds, *means, f"{mine['improved'].mean():.2f}"))
    head = ("translator", "seeds", "mean ratios", "worst ratios", "with camber / fx / mz", "improved")
    return markdown(head, rows)


def _means_by_case(hidden: pd.DataFrame, columns: list[str]) -> list[tuple[str, ...]]:
    """Means of columns over the seeds, a row for each kind, size and mixed model; empty where not known."""
    rows = []
    for (kind, size, name), own in hidden[hidden["translator"].isin(MIXED)].groupby(
        ["kind", "bias_size", "translator"]
    ):
        cells = ["" if pd.isna(value) else f"{value:.2f}" for value in own[columns].mean()]
        rows.append((str(kind), f"{size:g}", str(name), *cells))
    return rows


def bands_and_refusals(hidden: pd.DataFrame) -> str:
    """Coverage of the bands; how often a file was left alone, and rightly."""
    refusals = ["left_alone", "harmful", "refusal_precision", "refusal_recall"]
    head = ("kind", "size", "translator", "fy", "fx", "mz", "left alone", "would grow", "precision", "recall")
    return markdown(head, _means_by_case(hidden, [*COVERAGE, *refusals]))


def goals(hidden: pd.DataFrame) -> str:
    """Goals of the issue beside what was measured."""
    found = check_goals(hidden)
    return markdown(tuple(found.columns), [tuple(map(str, row)) for row in found.to_numpy()])


def bands_since(measured: pd.DataFrame) -> str:
    """Coverage on the fleets that were measured after the bands had been changed."""
    hidden = measured[measured["set"] == "hidden"]
    rows = _means_by_case(hidden, COVERAGE)
    seeds = ", ".join(str(seed) for seed in sorted(hidden["seed"].unique()))
    head = ("kind", "size", "translator", "fy", "fx", "mz")
    return (
        "Bands of the translators without pairs, measured again after those of the aligning torque were "
        f"widened (the table above is from before), seeds {seeds}:\n\n{markdown(head, rows)}"
    )


def tables(measured: pd.DataFrame) -> str:
    """All tables, as markdown."""
    hidden = measured[measured["set"] == "hidden"]
    main = hidden[hidden["translator"].isin(MIXED)]
    fleets = len(main[["kind", "bias_size", "seed"]].drop_duplicates())
    seeds = ", ".join(str(seed) for seed in sorted(main["seed"].unique()))
    refusals = main.dropna(subset=["left_alone"])
    left, grown = refusals["left_alone"].sum(), refusals["harmful"].sum()
    right = (refusals["left_alone"] * refusals["refusal_precision"].fillna(0.0)).sum()
    parts = [
        f"{fleets} fleets of seeds {seeds}. A cell: forces / cornering stiffness / peak friction, as ratios "
        "of mean squared errors, translated over unchanged. Worst: the largest ratio of the seeds, each by "
        "itself.",
        by_fleet(hidden),
        "Every translator on additive fleets at the calibrated bias:",
        all_translators(hidden),
        "Bands: share of the target's points inside, for Fy, Fx and Mz. *Left alone*: share of files. *Would "
        "grow*: share of files whose error the translation would have made larger. Over all fleets, "
        f"{right / max(left, 1e-9):.2f} of the files left alone would have grown (precision), and "
        f"{right / max(grown, 1e-9):.2f} of those that would have grown were left alone (recall).",
        bands_and_refusals(hidden),
        *([bands_since(pd.read_csv(BANDS))] if BANDS.exists() else []),
    ]
    return "\n\n".join(parts)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, default=RESULTS)
    parser.add_argument("--write", action="store_true")
    asked = parser.parse_args()
    measured = pd.read_csv(asked.results)
    hidden = measured[measured["set"] == "hidden"]
    parts = {
        BEGIN_SUMMARY: in_short(hidden),
        BEGIN_BIAS: bias_inside(),
        BEGIN_BANDS: bands_inside(hidden),
        BEGIN_GOALS: goals(hidden),
        BEGIN: tables(measured),
    }
    for begin, text in parts.items():
        print(text)
        if asked.write:
            write_between(PAGE, begin, text)


if __name__ == "__main__":
    main()
