"""The thesis' figures from our results, by file name: ``figure_5_1`` ... ; both splits where they differ."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import pandas as pd

from tire_pipeline.classifiers.score_on_splits import SPLITS
from tire_pipeline.pages.drawing import MARKERS, colour_of, name_ticks, new_figure
from tire_pipeline.progress import track
from tire_pipeline.reporting import Drawing
from tire_pipeline.thesis.pages.agent_figures import AGENT_FIGURES
from tire_pipeline.thesis.result_tables import Results, in_words

if TYPE_CHECKING:
    from matplotlib.figure import Figure as MplFigure

BIN_FIGURES = {
    "figure_5_5": "coefficients",
    "figure_5_6": "key_attributes",
    "figure_5_7": "latent",
    "figure_5_8": "power_series",
}


def all_drawings(results: Results) -> dict[str, Drawing]:
    """Draw every figure for which there are results."""
    names = track([*CLASSIFIER_FIGURES, *AGENT_FIGURES], "drawing figures of the thesis")
    return {name: drawn for name in names if (drawn := drawing(results, name)) is not None}


def drawing(results: Results, name: str) -> Drawing | None:
    """One figure; it is drawn once. None if there are no results for it.

    Parameters
    ----------
    results : Results
    name : str
        File name: ``figure_5_1`` ..., ``reliability``.
    """
    if name not in results.drawings:
        figure = {**CLASSIFIER_FIGURES, **AGENT_FIGURES}[name](results)
        results.drawings[name] = None if figure is None else Drawing.of(figure)
    return cast("Drawing | None", results.drawings[name])


def dataset_figure(results: Results) -> MplFigure:
    """All files of each category, before they are split (Figure 4.1)."""
    counts = results["class_counts"]
    part = counts[counts["split"] == SPLITS[0]]
    figure, axes = new_figure(width=9.0, height=3.0)
    one: Any = axes
    one.bar(np.arange(len(part)), part["all"], 0.8, color=colour_of(0))
    name_ticks(one.xaxis, part["category"])
    one.set_axisbelow(True)
    one.set_xlabel("category")
    one.set_ylabel("files")
    return figure


def training_figure(results: Results) -> MplFigure:
    """Training files of each category (Figure 4.2), side by side for the two splits."""
    counts, columns = results["class_counts"], {"training": "training set", "training_smote": "with SMOTE"}
    figure, axes = new_figure(1, 2, width=9.0, height=3.2, sharey=True)
    for one, split in zip(np.asarray(axes), SPLITS, strict=True):
        part = counts[counts["split"] == split]
        width = 0.8 / len(columns)
        for number, (column, label) in enumerate(columns.items()):
            places = np.arange(len(part)) + (number - (len(columns) - 1) / 2) * width
            one.bar(places, part[column], width, color=colour_of(number), label=label)
        name_ticks(one.xaxis, part["category"])
        one.set_axisbelow(True)
        one.set_xlabel("category")
        one.set_title(in_words(split))
    np.asarray(axes)[0].set_ylabel("files")
    handles, labels = np.asarray(axes)[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=2, fontsize=8)
    return figure


def score_figure(frame: pd.DataFrame, over: str, label: str, *, spread: bool = False) -> MplFigure:
    """Accuracy and F1 over one number, for both splits (Figures 5.1, 5.2, 5.4 to 5.8).

    Parameters
    ----------
    frame : DataFrame
        ``split, accuracy, f1`` and ``over``.
    over : str
        Column of the horizontal axis.
    label : str
        Its words.
    spread : bool
        Show one standard deviation, from ``accuracy_std``.
    """
    figure, axes = new_figure(width=9.0, height=3.3)
    one: Any = axes
    for number, split in enumerate(SPLITS):
        part = frame[frame["split"] == split].sort_values(over)
        colour = colour_of(number)
        one.plot(
            part[over], part["accuracy"], color=colour, marker=MARKERS[number], ms=3,
            label=f"accuracy, {in_words(split)}",
        )  # fmt: skip
        one.plot(part[over], part["f1"], color=colour, ls="--", lw=1, label=f"F1, {in_words(split)}")
        if spread:
            low, high = part["accuracy"] - part["accuracy_std"], part["accuracy"] + part["accuracy_std"]
            one.fill_between(part[over], low, high, color=colour, alpha=0.15, lw=0)
    one.set_xlabel(label)
    one.xaxis.get_major_locator().set_params(integer=True)
    one.set_ylabel("accuracy, weighted F1")
    one.legend(fontsize=8)
    return figure


def confusion_figure(results: Results) -> MplFigure:
    """Confusion matrices of the forest with SMOTE, as shares of all test files (Figure 5.3)."""
    frame = results["confusion"]
    frame = frame[(frame["classifier"] == "random_forest") & frame["smote"]]
    figure, axes = new_figure(1, 2, width=9.2, height=4.3)
    for one, split in zip(np.asarray(axes), SPLITS, strict=True):
        shares = frame[frame["split"] == split].pivot(index="true", columns="predicted", values="share")
        top = float(np.nanmax(shares.to_numpy()))
        one.imshow(shares, vmin=0, vmax=top, cmap="Blues")
        one.grid(False)
        name_ticks(one.xaxis, shares.columns)
        name_ticks(one.yaxis, shares.index)
        one.set_xlabel("predicted category")
        one.set_ylabel("true category")
        one.set_title(in_words(split))
        for (row, column), value in np.ndenumerate(shares.to_numpy()):
            ink = "white" if value > 0.6 * top else "black"
            one.text(column, row, f"{value:.3f}", ha="center", va="center", color=ink, fontsize=7)
    return figure


def reliability_figure(results: Results) -> MplFigure:
    """How often a classifier is right when it gives a probability; the diagonal is perfect."""
    frame = results["reliability"]
    figure, axes = new_figure(1, 2, width=9.2, height=3.9, sharey=True)
    for one, split in zip(np.asarray(axes), SPLITS, strict=True):
        one.plot([0, 1], [0, 1], color="black", lw=0.8, ls=":")
        names = list(dict.fromkeys(frame["classifier"]))
        for number, name in enumerate(names):
            part = frame[(frame["classifier"] == name) & (frame["split"] == split) & frame["smote"]]
            colour, marker = colour_of(number), MARKERS[number]
            one.plot(
                part["confidence"], part["accuracy"], color=colour, marker=marker, ms=4, label=in_words(name)
            )
        one.set_xlabel("probability of the most probable category")
        one.set_title(in_words(split))
        one.set_xlim(0.15, 1.0)
    np.asarray(axes)[0].set_ylabel("share that is right")
    handles, labels = np.asarray(axes)[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=5, fontsize=8)
    return figure


def _bins(representation: str) -> Callable[[Results], MplFigure]:
    def draw(results: Results) -> MplFigure:
        frame = results["bins"]
        part = frame[frame["representation"] == representation]
        return score_figure(part, "bins", f"bins a feature ({in_words(representation)})", spread=True)

    return draw


CLASSIFIER_FIGURES: dict[str, Callable[[Results], MplFigure | None]] = {
    "figure_4_1": dataset_figure,
    "figure_4_2": training_figure,
    "figure_5_1": lambda results: score_figure(results["forest_trees"], "trees", "trees, no limit on depth"),
    "figure_5_2": lambda results: score_figure(results["forest_depth"], "depth", "maximum depth of a tree"),
    "figure_5_3": confusion_figure,
    "figure_5_4": lambda results: score_figure(
        results["latent"], "features", "latent features (10 bins each)", spread=True
    ),
    **{name: _bins(representation) for name, representation in BIN_FIGURES.items()},
    "reliability": reliability_figure,
}
"""File name -> how it is drawn."""
