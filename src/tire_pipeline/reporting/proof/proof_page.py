"""The page of the proof: simulated cases and cases from real recordings."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.concealed.scoring.words import in_words, outcome
from tire_pipeline.pages.drawing import MARKERS, colour_of, new_figure
from tire_pipeline.pages.numbers_in_words import how_many
from tire_pipeline.reporting import HOME, Figure, Part, Table, Text, render_page
from tire_pipeline.reporting.proof.proof_tables import METHODS, groups, misses_table

OWN = "explain_mismatch"


def proof_page(
    scores: pd.DataFrame,
    misses: pd.DataFrame,
    details: dict[str, Any],
    real_scores: pd.DataFrame,
    real_misses: pd.DataFrame,
    real_details: dict[str, Any],
) -> str:
    """Both halves: scores with intervals beside the baselines, by strength, and every miss."""
    simulated = _simulated(scores, misses, details, _real_in_short(real_scores, real_details["made"]))
    real = _real(real_scores, real_misses, real_details)
    return render_page("Proof on concealed effects", [*simulated, *real], pages=HOME)


def _real_in_short(scores: pd.DataFrame, made: dict[str, Any]) -> list[str]:
    """The outcome on real recordings in a sentence, for the top of the page."""
    if not len(scores):
        return []
    own = scores[(scores["method"] == OWN) & (scores["source"] == "all")]
    return [f"{_cases(made)} made from real recordings: {_goals(own)}"]


def _simulated(
    scores: pd.DataFrame, misses: pd.DataFrame, details: dict[str, Any], real: list[str]
) -> list[Part]:
    own = scores[scores["method"] == OWN]
    lines = [
        f"{details[OWN]['n']} recordings by a rig simulator that is no Magic Formula, with an "
        f"effect concealed in most. {_goals(own)}",
        *real,
        f"The answers were sealed before anything was explained: SHA-256 {details['sha256']}.",
    ]
    parts: list[Part] = [Text(lines, emphasis=True), *_drawn(scores, "Simulated recordings")]
    parts += [_table(own, "All scores"), _beside(scores, "Beside the baselines")]
    parts += groups(details[OWN], "", "the noise")
    if len(misses):
        said = (
            "Cases with a wrong answer. After each true effect: its strength as a multiple of the noise. "
            "Alternatives: what the recording cannot tell from the names before."
        )
        parts.append(misses_table(misses, said, "Every miss"))
    return parts


def _real(scores: pd.DataFrame, misses: pd.DataFrame, details: dict[str, Any]) -> list[Part]:
    heading, made = "On real recordings", details["made"]
    if not len(scores):
        missing = "The real recordings are not available, and no proof on them has been published yet."
        return [Text([missing], heading=heading)]
    own = scores[scores["method"] == OWN]
    lines = []
    if details["published"]:
        lines.append(
            "The real recordings are not available: this is the committed table, not a result of this run."
        )
    by_source = ", ".join(
        f"{n} of {_SOURCE_WORDS.get(source, source)}" for source, n in made["by_source"].items()
    )
    lines += [
        f"{_cases(made)} made from real recordings ({by_source}): physics hidden from the model by "
        f"what it was fitted to, known effects added by their mechanism, or nothing. "
        f"{_goals(own[own['source'] == 'all'])}",
        f"Seed {made['seed']}, code {made['code']}, {made['date']}. The answers were sealed before anything "
        f"was explained: SHA-256 {made['sha256']}. They are made from {made['sealed_sweeps']} sweeps. None "
        f"is of the {made['development_sweeps']} others, of the same tires, that thresholds may be set with.",
    ]
    parts: list[Part] = [
        Text(lines, heading=heading),
        *_drawn(scores[scores["source"] == "all"], "Real recordings"),
    ]
    for source in own["source"].unique():
        words = _SOURCE_WORDS.get(source, source)
        parts.append(_table(own[own["source"] == source], f"Real recordings: {words}"))
    parts.append(_beside(scores[scores["source"] == "all"], "Real recordings: beside the baselines"))
    parts += groups(details, "Real recordings: ", "the misfit")
    if len(misses):
        said = (
            "Cases with a wrong answer, or with a larger error on held-out sweeps. After each true effect: "
            "its strength as a multiple of the misfit, and whether it was hidden from the model's fit. "
            "Between slashes: names of which the recording cannot tell one. "
            "Held-out ratio: RMS error on held-out sweeps with the findings over that without them."
        )
        parts.append(misses_table(misses, said, "Real recordings: every miss"))
    return parts


_SOURCE_WORDS = {
    "all": "all sources",
    "calspan": "a flat belt (calspan)",
    "dart": "a driven car (dart)",
    "tydex": "steady points (tydex)",
}


def _cases(made: dict[str, Any]) -> str:
    return how_many(made["cases"], "case")


def _goals(own: pd.DataFrame) -> str:
    results = [outcome(row) for row in own.to_dict("records") if "target" in row]
    met, few = results.count("met"), results.count("too few cases")
    aimed = len([result for result in results if result])
    told = f"{met} of {aimed} goals are met"
    return f"{told}; {few} {'has' if few == 1 else 'have'} too few cases to tell." if few else f"{told}."


def _table(own: pd.DataFrame, heading: str) -> Table:
    """All scores of the explanation; a value without cases is a dash."""
    table = pd.DataFrame(
        {
            "score": own["name"].map(in_words),
            **{name: own[name] for name in ("value", "low", "high", "n", "target") if name in own},
            "result": [outcome(row) if "target" in row else "" for row in own.to_dict("records")],
        }
    )
    names = {"low": "95% from", "high": "to", "n": "cases", "target": "goal"}
    table["target"] = [_sign(goal) if isinstance(goal, str) else "" for goal in own["target"]]
    if "low" in table:
        table.loc[(table["n"] == 1) & (table["low"] == table["high"]), ["low", "high"]] = float("nan")
    return Table(
        table.rename(columns=names),
        "Shares, unless the score says otherwise. Too few cases: not even a perfect score would show that "
        "the goal is met (95%).",
        heading=heading,
        decimals=3,
    )


def _drawn(scores: pd.DataFrame, what: str) -> list[Part]:
    """Every share that has a goal: ours with its interval, the baselines, and the goal."""
    aimed = scores[scores["target"].map(_is_share)]
    own = aimed[aimed["method"] == OWN].set_index("name")
    names = list(own.index)
    if not names:
        return []
    y = np.arange(len(names))
    figure, axis = new_figure(width=9.0, height=1.3 + 0.42 * len(names))
    others = [method for method in dict.fromkeys(aimed["method"]) if method != OWN]
    for k, method in enumerate(others, start=1):
        values = aimed[aimed["method"] == method].set_index("name")["value"].reindex(names)
        look: dict[str, Any] = {"color": colour_of(k), "markerfacecolor": "none", "markersize": 5, "lw": 0}
        axis.plot(values, y, marker=MARKERS[k], label=METHODS.get(method, method), **look)
    ends = np.clip([own["value"] - own["low"], own["high"] - own["value"]], 0.0, None)
    axis.errorbar(own["value"], y, xerr=ends, fmt="o", color=colour_of(0), label="ours, 95% interval")
    bounds = [float(goal.split()[1]) for goal in own["target"]]
    axis.plot(bounds, y, marker="|", markersize=20, color="black", lw=0, label="goal")
    labels = [f"{in_words(name)} ({_sign(own.loc[name, 'target'])})" for name in names]
    axis.set_yticks(y, labels, fontsize=8)
    axis.invert_yaxis()
    axis.set_xlim(-0.03, 1.03)
    axis.set_xlabel("share of the cases, or overlap")
    figure.legend(loc="outside upper center", ncols=5, fontsize=8)
    caption = (
        f"{what}: our score beside the baselines. The upright bar is the goal: ours should lie left of it "
        "where the goal is an upper bound (≤), and right of it where it is a lower one (≥)."
    )
    return [Figure(figure, caption)]


def _is_share(goal: object) -> bool:
    """Whether there is a goal, and it is a share or an overlap: a mean number of names is neither."""
    return isinstance(goal, str) and float(goal.split()[1]) <= 1.0


def _sign(goal: str) -> str:
    """The goal with signs as in print."""
    side, bound = goal.split()
    return f"{'≥' if side == '>=' else '≤'}\N{NO-BREAK SPACE}{float(bound):g}"


def _beside(scores: pd.DataFrame, heading: str) -> Table:
    wide = scores.pivot_table(index="name", columns="method", values="value", sort=False).reset_index()
    wide["name"] = wide["name"].map(in_words)
    wide = wide.rename(columns=METHODS)
    caption = "All methods on the same cases, scored alike. A dash: the method gives no such answer."
    return Table(wide.rename(columns={"name": "score"}), caption, heading=heading, decimals=3)
