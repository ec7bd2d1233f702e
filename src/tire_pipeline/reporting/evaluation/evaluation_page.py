"""The report: what was read, what the classifier can do, what the translation did."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from tire_pipeline.classifiers.score_on_splits import CLASSIFIER_WORDS, SPLIT_WORDS
from tire_pipeline.evaluation import curves_of
from tire_pipeline.evaluation.all_translators import NO_CHANGE
from tire_pipeline.evaluation.compare_with_target import FLOOR
from tire_pipeline.evaluation.curves import EvaluationGrid
from tire_pipeline.pages.drawing import colour_of, in_figure, new_figure
from tire_pipeline.reporting import HOME, Figure, Links, Part, Table, Text, render_page
from tire_pipeline.reporting.evaluation.training_figures import confusion_figure, learning_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure as MplFigure

_TABLE_LINKS = [
    (
        "tables/evaluation_summary.csv",
        "evaluation_summary.csv",
        "RMS errors by set and translator",
    ),
    ("tables/evaluation_table.csv", "evaluation_table.csv", "errors of every file"),
    ("tables/ingest_report.csv", "ingest_report.csv", "every file: read, or set aside with line and reason"),
    ("tables/filter_report.csv", "filter_report.csv", "what was removed before training, and why"),
    ("tables/classifier_scores.csv", "classifier_scores.csv", "accuracy of every classifier on both splits"),
]

_HEADING_OF_TABLES = (
    "Tables (CSV): the newest of each, so a later run, also one with other files, replaces them"
)

_METRIC_WORDS = {
    "forces": "lateral force",
    "cornering_stiffness": "cornering stiffness",
    "peak_friction": "peak friction",
    "forces_camber": "lateral force with camber",
    "fx": "longitudinal force",
    "mz": "aligning moment",
}
_GRID = EvaluationGrid(loads=np.array([6000.0]))


def force_figure(translated_table: pd.DataFrame, references: pd.DataFrame, best: dict[str, Any]) -> MplFigure:
    """Lateral force of up to four tires: as measured, as the best translated, and as the target measured.

    Where the target measured them, a second row shows the differences from its measurement.
    """
    shown = translated_table[translated_table["translator"].isin([NO_CHANGE, best["name"]])]
    names = list(dict.fromkeys(shown["set"]))
    part = shown[shown["set"] == names[0]] if names else shown
    tires = list(dict.fromkeys(part["tire"]))[:4]
    columns, rows = max(len(tires), 1), 2 if len(references) else 1
    figure, axes = new_figure(
        rows, columns, width=3.2 * columns, height=2.8 * rows, sharex=True, sharey="row", squeeze=False
    )
    for column, tire in enumerate(tires):
        target = references[references["tire"] == tire] if len(references) else references
        _draw_tire(axes[:, column], part[part["tire"] == tire], target)
        axes[0, column].set_title(in_figure(tire))
        axes[-1, column].set_xlabel("slip angle (deg)")
    axes[0, 0].set_ylabel("lateral force at 6 kN (kN)")
    if rows > 1:
        axes[1, 0].set_ylabel("difference from the target (N)")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=5, fontsize=8)
    return figure


def _draw_tire(axes: np.ndarray, own: pd.DataFrame, target: pd.DataFrame) -> None:
    """Draw one tire's forces and, if there is a second row, their differences from the target's."""
    angles = np.degrees(_GRID.slip_angles)
    reference = _lateral_force(target.head(1)) if len(target) else None
    if reference is not None:
        axes[0].plot(angles, reference, color="black", lw=2, label="target's measurement")
    categories = sorted(own["category"].unique())
    for row in own.to_dict("records"):
        fy = _lateral_force(pd.DataFrame([row]))
        after = row["state"] == "after"
        style: Any = {"color": colour_of(categories.index(row["category"])), "ls": "--" if after else "-"}
        label = f"{in_figure(row['category'])} {'translated' if after else 'as measured'}"
        axes[0].plot(angles, fy, lw=1.1, label=label, **style)
        if reference is not None:
            axes[1].plot(angles, 1e3 * (fy - reference), lw=1.1, **style)


def _lateral_force(row: pd.DataFrame) -> np.ndarray:
    """Of one tire over the slip angles, kN."""
    return np.asarray(curves_of(row, _GRID, lateral_only=True).fy[0, 0] / 1e3)


def build_report(
    outcome: list[str],
    ingest_summary: dict[str, Any],
    filter_report: Iterable[pd.DataFrame],
    tire_table: pd.DataFrame,
    classifier_scores: pd.DataFrame,
    classifier_per_class: pd.DataFrame,
    confusion_table: pd.DataFrame,
    learning_curve: pd.DataFrame,
    evaluation_summary: pd.DataFrame,
    translated_table: pd.DataFrame,
    references: pd.DataFrame,
    best: dict[str, Any],
    target_category: str,
) -> str:
    """One page in plain words; every figure beside what it must be compared with.

    Returns
    -------
    str
        HTML without outside references.
    """
    parts: list[Part] = [
        Text(outcome, emphasis=True),
        _forces(translated_table, references, best, target_category),
        *_translation(evaluation_summary, target_category, best),
        *_files(ingest_summary, filter_report, tire_table),
        *_classifier(tire_table, classifier_scores, classifier_per_class),
        Figure(
            confusion_figure(confusion_table),
            "Each row: how the files of one true category were classified, as shares. A perfect classifier "
            "has 1 on the diagonal.",
        ),
        Figure(
            learning_figure(learning_curve),
            "Reward of the agent over its training steps. A rising curve means that the agent learned to "
            "convince the classifier, not that its tires became right.",
            heading="The thesis' agent",
        ),
    ]
    parts.append(Links(_TABLE_LINKS, heading=_HEADING_OF_TABLES))
    return render_page(f"Tires as {target_category} would have measured them", parts, pages=HOME)


def _forces(table: pd.DataFrame, references: pd.DataFrame, best: dict[str, Any], target: str) -> Figure:
    beside = (
        f", thick as {target} measured. Below, the differences from {target}'s measurement: dashed lines "
        "should lie near zero"
    )
    return Figure(
        force_figure(table, references, best),
        f"Lateral force over slip angle at 6 kN: solid as each source measured, dashed as the {best['name']} "
        f"translated{beside if len(references) else ''}. A file that was not "
        "translated has its solid line only.",
        heading="Force curves",
    )


def _files(ingest: dict[str, Any], dropped: Iterable[pd.DataFrame], table: pd.DataFrame) -> list[Part]:
    counts = table.groupby("category").agg(files=("file", "size"), tires=("tire_id", "nunique")).reset_index()
    parts: list[Part] = [
        Text(
            [
                f"{ingest['read']:,} of {ingest['files']:,} files were read; "
                f"{len(table):,} remain after filtering."
            ],
            heading="The files",
        ),
        Table(counts, "Files and physical tires that remain, by category."),
    ]
    counted = Counter(str(reason) for frame in dropped for reason in frame["reason"])
    if counted:
        reasons = pd.DataFrame(sorted(counted.items()), columns=["reason", "files"])
        parts.append(Table(reasons, "Why files were removed; filter_report.csv names each."))
    if ingest["set_aside"]:
        text = f"{ingest['set_aside']:,} files could not be read; ingest_report.csv gives line and reason."
        parts.append(Text([text]))
    return parts


def _classifier(table: pd.DataFrame, scores: pd.DataFrame, per_class: pd.DataFrame) -> list[Part]:
    forest = scores[(scores["classifier"] == "random_forest") & (scores["features"] == "as they are")]
    by_split = forest.set_index("split")["accuracy"]
    guess = table["category"].value_counts(normalize=True).iloc[0]
    said = (
        "The random forest predicts which organisation measured the tire. It is right for "
        f"{by_split['random']:.1%} of the test files when files are split at random, and for "
        f"{by_split['by_tire']:.1%} when they are split by physical tire. "
        "Only the second figure holds for a new tire: in a random split, variants of one tire are on both "
        "sides, and the forest recognises the tire. "
        f"Always naming the largest category would be right for {guess:.1%}."
    )
    shown = scores.assign(
        split=scores["split"].map(SPLIT_WORDS), classifier=scores["classifier"].replace(CLASSIFIER_WORDS)
    ).rename(columns={"accuracy_std": "± accuracy", "f1": "F1", "f1_std": "± F1", "smote": "SMOTE"})
    for name in ("accuracy", "± accuracy", "F1", "± F1"):
        shown[name] = shown[name].round(3)
    once = shown["trainings"] == 1
    shown.loc[once, ["± accuracy", "± F1"]] = np.nan
    caption = "Accuracy and weighted F1, mean and spread of the trainings."
    if once.any():
        caption += " A dash: one training has no spread."
    detail = per_class.assign(split=per_class["split"].map(SPLIT_WORDS)).rename(
        columns={"f1": "F1", "rows": "files"}
    )
    detail["files"] = detail["files"].astype(int)
    return [
        Text([said], heading="Who measured a tire?"),
        Table(shown, caption, decimals=3),
        Table(detail, "The forest that rewards the thesis' agent, for each category.", decimals=2),
    ]


def _translation(summary: pd.DataFrame, target: str, best: dict[str, Any]) -> list[Part]:
    if summary.empty:
        return []
    caption = (
        "RMS error against the target's measurement, divided by that of the untranslated files: 1 means that "
        "nothing was gained. Floor: the target measuring a second time. Oracle: a constant shift of the "
        "force coefficients of each category, taken from the hidden truth. Improved: share of files that the "
        f"{best['name']} brought closer to the target. The thesis uses the first three metrics."
    )
    rows = summary[summary["metric"] != "mean"]
    wide = rows.assign(ratio=np.sqrt(rows["ratio"])).pivot_table(
        index=["set", "metric"], columns="translator", values="ratio", sort=False
    )
    written = rows[rows["translator"] == best["name"]].set_index(["set", "metric"])
    order = [name for name in dict.fromkeys(rows["translator"]) if name not in (best["name"], FLOOR)]
    shown = wide[[best["name"], FLOOR, *order]].assign(
        improved=written["improved"].map("{:.0%}".format), files=written["files"]
    )
    shown = shown.reset_index().replace({"metric": _METRIC_WORDS})
    return [Table(shown, caption, heading=f"Translation to {target}", decimals=2)]
