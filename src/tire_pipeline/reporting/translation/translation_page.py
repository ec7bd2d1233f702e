"""The page of translations: every translator on the same hidden tires, and what is learned about the data."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from tire_pipeline.pages.drawing import MARKERS, colour_of, new_figure
from tire_pipeline.reporting.page_parts import HOME, Figure, Part, Table, Text, render_page

if TYPE_CHECKING:
    from matplotlib.figure import Figure as MplFigure

RATIOS = {
    "ratio_forces": "forces",
    "ratio_cornering_stiffness": "cornering stiffness",
    "ratio_peak_friction": "peak friction",
}
MORE = {
    "ratio_forces_camber": "forces with camber",
    "ratio_fx": "Fx",
    "ratio_mz": "Mz",
}
IN_WORDS = {
    "no_change": "doing nothing",
    "greedy_forest": "greedy forest",
    "cycle_consistent": "cycle-consistent networks",
    "curious_agent": "curious agent",
    "likelihood_agent": "likelihood agent",
    "mixed_model": "mixed model",
    "batch_mixed_model": "mixed model with batch",
    "paired_mixed_model": "mixed model with pairs",
    "paired_batch_mixed_model": "mixed model with pairs and batch",
    "oracle": "oracle",
    "floor": "floor",
}
_TRANSLATOR_METHODS = {
    "greedy forest": "moves a file to where the classifier gives the target the highest probability",
    "cycle-consistent networks": "learn to translate there and back",
    "likelihood agent": "learns by reinforcement, rewarded for how likely the target's files are",
    "curious agent": "a likelihood agent that is also rewarded for exploring",
    "mixed model": "describes the bias of each organisation by size, mass and kind of tire",
    "with pairs": "also uses the tires that several organisations measured",
    "with batch": "also learns from the files to translate",
    "oracle": "is fitted on the hidden truth: what could be reached",
    "floor": "the target measures the tires a second time",
}
_KINDS = (
    "Kinds of fleet: additive (every tire reacts to a rig as the mean tire does), interacting (as its "
    "compound and carcass make it react), drifting (one organisation changes how it measures)."
)
MIXED = ("mixed_model", "batch_mixed_model", "paired_mixed_model", "paired_batch_mixed_model")
DRAWN = (
    "mixed_model",
    "paired_mixed_model",
    "paired_batch_mixed_model",
    "oracle",
    "floor",
    "greedy_forest",
)
GOALS = (
    ("likelihood_agent", ("additive",), 1.0, (0.30, 0.30, 0.30), 0.85, None),
    ("mixed_model", ("additive", "interacting", "drifting"), 1.0, None, 0.90, 3.0),
    ("batch_mixed_model", ("additive", "interacting", "drifting"), 1.0, None, 0.90, 3.0),
    ("paired_mixed_model", ("additive", "interacting", "drifting"), 1.0, None, 0.90, 1.5),
    ("paired_mixed_model", ("interacting",), 1.0, (0.30, 0.25, 0.30), None, None),
    ("paired_batch_mixed_model", ("additive", "interacting", "drifting"), 1.0, None, 0.90, 1.5),
    ("paired_batch_mixed_model", ("interacting",), 1.0, (0.30, 0.25, 0.30), None, None),
)

_LEAST_FLEETS = 3
"""Of fewer fleets, neither a goal met nor one missed says anything."""


def translation_page(
    grid: pd.DataFrame,
    *,
    bias: pd.DataFrame | None = None,
    beside_truth: pd.DataFrame | None = None,
    note: str = "",
) -> str:
    """Show how well every translator does.

    Parameters
    ----------
    grid : DataFrame
        As ``benchmarks/bench_translation.py`` writes it.
    bias : DataFrame, optional
        ``BiasReport.by_region`` of the user's or the demonstration data.
    beside_truth : DataFrame, optional
        The same beside the sealed truth (``evaluation.bias_truth.bias_beside_truth``).
    note : str
        For the page's foot.

    Returns
    -------
    str
        HTML.
    """
    hidden = grid[grid["set"] == "hidden"].reset_index(drop=True)
    parts = [*_compared(hidden), *_goals_and_refusals(hidden), *_learned(bias, beside_truth)]
    return render_page("How well the translators do", parts, pages=HOME, footer=note)


def _compared(hidden: pd.DataFrame) -> list[Part]:
    return [
        Text(_summary(hidden), emphasis=True),
        Figure(
            _by_size(hidden),
            "RMS error over that of the untranslated files: 1 is nothing gained, lower is better. Bias "
            f"size 1 is the calibrated bias; at 0 only the fits differ. {_KINDS}",
            "By size of the bias",
        ),
        Table(
            pd.DataFrame(list(_TRANSLATOR_METHODS.items()), columns=["translator", "what it does"]),
            heading="What is compared",
        ),
        Table(
            _at_calibrated(hidden),
            "RMS error over that of the untranslated files (1: nothing gained), over all seeds, "
            "100 hidden tires from five organisations each. Improved: share of the curves that came closer.",
            heading="Every translator at the calibrated bias",
            decimals=3,
        ),
    ]


def _goals_and_refusals(hidden: pd.DataFrame) -> list[Part]:
    return [
        Table(
            check_goals(hidden).assign(translator=lambda t: t["translator"].map(_words)),
            "The goals were fixed beforehand. They are ratios of squared errors, the squares of the ratios "
            "above. Three numbers are of forces / cornering stiffness / peak friction, over the floor's "
            "where the goal is a multiple of the floor. Improved: share of the curves that came closer.",
            heading="Goals, met and missed",
        ),
        Table(
            _bands_and_refusals(hidden),
            "Coverage: share of the target's own points inside the 90% band. A file is correctly left alone "
            "if its translation would have been worse: precision and recall are those of leaving alone.",
            heading="Bands and refusals",
            decimals=3,
        ),
    ]


def _learned(bias: pd.DataFrame | None, beside_truth: pd.DataFrame | None) -> list[Part]:
    """What the translators say of the data, beside the truth where it is known."""
    parts: list[Part] = []
    if beside_truth is not None and len(beside_truth):
        inside = beside_truth["inside"].mean()
        caption = (
            "Reported bias with its 90% interval against what the sealed tires, measured by both, show; "
            f"{inside:.0%} of {len(beside_truth)} lie inside."
        )
        parts.append(Figure(_truth_figure(beside_truth), caption, "What is learned about the data"))
    if bias is not None and len(bias):
        parts.append(
            Table(
                _largest(bias), "Largest first, 90% intervals.", heading="Bias between pairs of organisations"
            )
        )
    return parts


def _words(translator: str) -> str:
    """Return the name of a translator as it stands in a sentence."""
    return IN_WORDS.get(translator, translator.replace("_", " "))


def _summary(hidden: pd.DataFrame) -> list[str]:
    mixed = hidden[hidden["translator"].isin(MIXED)]
    largest = mixed[list(RATIOS)].max(axis=1)
    row = mixed.loc[largest.idxmax()]
    fleets = len(hidden[["kind", "bias_size", "seed"]].drop_duplicates())
    harm = "No mixed model does harm" if largest.max() <= 1.0 else "A mixed model does harm"
    where = f"{_words(row['translator'])}, {row['kind']}, bias size {row['bias_size']:g}, seed {row['seed']}"
    left = np.sqrt(hidden[hidden["bias_size"] == 1.0].groupby("translator")["ratio_forces"].mean())
    best = "paired_mixed_model" if "paired_mixed_model" in left else MIXED[0]
    name = _words(best)
    floor = (
        f", where the target's second measurement differs by {left['floor']:.0%}" if "floor" in left else ""
    )
    return [
        f"At the calibrated bias the {name} leaves {left.get(best, float('nan')):.0%} of the RMS error "
        f"of the forces{floor}.",
        f"{harm}: the largest ratio of RMS errors, translated over unchanged, is "
        f"{largest.max() ** 0.5:.2f} ({where}).",
        f"Measured on {fleets} generated fleets of 100 hidden tires each, without the compound in the "
        "metadata. No translator has seen a file of the target of these tires.",
        "These results were measured once and are part of the project. This pipeline draws them; it trains "
        "nothing.",
    ]


def _at_calibrated(hidden: pd.DataFrame) -> pd.DataFrame:
    ratios = [*RATIOS, *MORE]
    calibrated = hidden[hidden["bias_size"] == 1.0]
    rows = calibrated.groupby(["kind", "translator"])[[*ratios, "improved"]].mean().reset_index()
    rows[ratios] = np.sqrt(rows[ratios])
    order = {name: k for k, name in enumerate(IN_WORDS)}
    rows = rows.sort_values(
        ["kind", "translator"], key=lambda c: c.map(order) if c.name == "translator" else c
    )
    rows = rows.assign(translator=rows["translator"].map(IN_WORDS))
    return rows.rename(columns={**RATIOS, **MORE})


def check_goals(hidden: pd.DataFrame) -> pd.DataFrame:
    """Put each goal beside what was measured.

    Parameters
    ----------
    hidden : DataFrame
        Rows of the grid with ``set == "hidden"``.

    Returns
    -------
    DataFrame
        ``translator``, ``fleet``, ``goal``, ``measured``, ``oracle`` (the same of the oracle), ``met``: yes,
        no, or too few fleets.
    """
    rows: list[tuple[str, str, str, str, str, bool, int]] = []
    for name, kinds, size, most, improved, floors in GOALS:
        for kind in kinds:
            own = hidden[(hidden["kind"] == kind) & (hidden["bias_size"] == size)]
            mine = own[own["translator"] == name]
            if mine.empty:
                continue
            means = own.groupby("translator")[[*RATIOS, "improved"]].mean().reindex([name, "floor", "oracle"])
            ratios, floor, oracle = (means.loc[n, list(RATIOS)] for n in (name, "floor", "oracle"))
            if most is not None:
                goal = f"ratios at most {_slashed(most)}"
                met = (ratios <= list(most)).all()
                rows.append((name, kind, goal, _slashed(ratios), _slashed(oracle), bool(met), len(mine)))
            if floors is not None:
                goal, share = f"at most {floors:g} x floor", ratios / floor
                best = _slashed(oracle / floor)
                rows.append(
                    (name, kind, goal, _slashed(share), best, bool((share <= floors).all()), len(mine))
                )
            if improved is not None:
                goal, got = f"improved at least {improved:.2f}", float(means.loc[name, "improved"])
                best = f"{means.loc['oracle', 'improved']:.2f}"
                rows.append((name, kind, goal, f"{got:.2f}", best, got >= improved, len(mine)))
    for name in MIXED:
        mine = hidden[hidden["translator"] == name]
        if mine.empty:
            continue
        largest = float(mine[list(RATIOS)].max(axis=None))
        told = f"largest {largest:.2f}"
        rows.append((name, "all kinds and sizes", "no ratio above 1", told, "", largest <= 1.0, len(mine)))
    columns = ["translator", "fleet", "goal", "measured", "oracle", "met", "fleets"]
    table = pd.DataFrame(rows, columns=columns)
    met = np.where(table["met"].astype(bool), "yes", "no")
    return table.assign(met=np.where(table["fleets"] < _LEAST_FLEETS, "too few fleets", met))


def _slashed(values: pd.Series | tuple[float, ...]) -> str:
    return " / ".join(f"{value:.2f}" for value in values)


def _bands_and_refusals(hidden: pd.DataFrame) -> pd.DataFrame:
    names = {
        "coverage_fy": "coverage, Fy",
        "coverage_fx": "coverage, Fx",
        "coverage_mz": "coverage, Mz",
        "left_alone": "left alone",
        "harmful": "would be worse",
        "refusal_precision": "precision",
        "refusal_recall": "recall",
    }
    own = hidden[hidden["translator"].isin(MIXED)]
    rows = own.groupby(["kind", "bias_size", "translator"])[list(names)].mean().reset_index()
    rows["translator"] = rows["translator"].map(_words)
    rows["bias_size"] = rows["bias_size"].map("{:g}".format)
    return rows.rename(columns={**names, "bias_size": "bias size"})


def _by_size(hidden: pd.DataFrame) -> MplFigure:
    kinds = [kind for kind in ("additive", "interacting", "drifting") if kind in set(hidden["kind"])]
    figure, axes = new_figure(len(kinds), 3, width=9.0, height=2.7 * len(kinds), squeeze=False, sharex=True)
    for row, kind in zip(np.asarray(axes), kinds, strict=True):
        for axis, (column, what) in zip(row, RATIOS.items(), strict=True):
            for k, name in enumerate(DRAWN):
                own = hidden[(hidden["kind"] == kind) & (hidden["translator"] == name)]
                line = np.sqrt(own.groupby("bias_size")[column].mean())
                axis.plot(line.index, line, marker=MARKERS[k], color=colour_of(k), label=_words(name))
            axis.axhline(1.0, color="black", linewidth=0.8)
            axis.set_yscale("log")
            axis.set_ylim(0.1, 6.0)
            axis.set_yticks((0.1, 0.2, 0.5, 1.0, 2.0, 5.0), minor=False)
            axis.set_yticks((), minor=True)
            axis.yaxis.set_major_formatter("{x:g}")
            axis.set_title(f"{kind}: {what}", fontsize=9)
            axis.set_xlabel("bias size")
            axis.set_ylabel("RMS error ratio")
    figure.legend(
        *np.asarray(axes)[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=6, fontsize=8
    )
    return figure


def _truth_figure(both: pd.DataFrame) -> MplFigure:
    figure, axis = new_figure(width=9.0, height=4.2)
    for k, (what, own) in enumerate(both.groupby(both["region"].str.split(",").str[0])):
        bias = 100 * own["bias"]
        ends = np.stack([bias - 100 * own["low"], 100 * own["high"] - bias])
        axis.errorbar(
            100 * own["true_bias"],
            bias,
            yerr=ends,
            fmt=MARKERS[k],
            color=colour_of(k),
            markersize=4,
            label=what,
            alpha=0.7,
        )
    low, high = 100 * both["true_bias"].min(), 100 * both["true_bias"].max()
    axis.plot([low, high], [low, high], color="black", linewidth=0.8)
    axis.set_xlabel("true bias (%)")
    axis.set_ylabel("reported bias (%)")
    axis.legend()
    return figure


def _largest(bias: pd.DataFrame) -> pd.DataFrame:
    wanted = ("cornering stiffness, 4000 N", "friction level, 4000 N", "slip stiffness, 4000 N")
    own = bias[bias["region"].isin(wanted)].copy()
    own = own.reindex(own["bias"].abs().sort_values(ascending=False).index).head(45)
    for name in ("bias", "low", "high"):
        own[name] = (100 * own[name]).map("{:+.1f}%".format)
    return own[["organisation", "reference", "output", "region", "bias", "low", "high"]]
