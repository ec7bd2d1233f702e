"""The page of the proof: simulated cases and cases from real recordings."""

from __future__ import annotations

from typing import Any

import pandas as pd

from tire_pipeline.reporting import Table, Text, render_page

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
    simulated = _simulated(scores, misses, details)
    real = _real(real_scores, real_misses, real_details)
    return render_page("Proof on concealed effects", [*simulated, *real])


def _simulated(scores: pd.DataFrame, misses: pd.DataFrame, details: dict[str, Any]) -> list[Text | Table]:
    own = scores[scores["method"] == OWN]
    lines = [
        f"{details[OWN]['n']} recordings by a rig simulator that is no Magic Formula, with an "
        f"effect concealed in most. {_goals(own)}",
        f"The answers were sealed before anything was explained: SHA-256 {details['sha256']}.",
    ]
    parts: list[Text | Table] = [
        Text(lines, emphasis=True),
        Table(own.drop(columns="method"), "With 95% intervals.", heading=OWN),
        _beside(scores, "Beside the baselines"),
    ]
    parts += _groups(details[OWN], "")
    if len(misses):
        parts.append(
            Table(misses.astype(str), "What was not answered rightly.", heading="Every miss", most_rows=400)
        )
    return parts


def _real(scores: pd.DataFrame, misses: pd.DataFrame, details: dict[str, Any]) -> list[Text | Table]:
    heading, made = "On real recordings", details["made"]
    if not len(scores):
        missing = "The real recordings are not there, and no proof on them has been published yet."
        return [Text([missing], heading=heading)]
    own = scores[scores["method"] == OWN]
    lines = []
    if details["published"]:
        lines.append(
            "The real recordings are not there: this is the committed table, not a result of this run."
        )
    by_source = ", ".join(f"{n} from {source}" for source, n in made["by_source"].items())
    lines += [
        f"{made['cases']} cases made from real recordings ({by_source}): physics hidden from the model by "
        f"what it was fitted to, known effects put in by their mechanism, or nothing. "
        f"{_goals(own[own['source'] == 'all'])}",
        f"Seed {made['seed']}, code {made['code']}, {made['date']}. The answers were sealed before anything "
        f"was explained: SHA-256 {made['sha256']}. They are made from {made['sealed_sweeps']} sweeps. None "
        f"is of the {made['development_sweeps']} others, of the same tires, that thresholds may be set with.",
    ]
    parts: list[Text | Table] = [Text(lines, heading=heading)]
    for source in own["source"].unique():
        table = own[own["source"] == source].drop(columns=["method", "source"])
        parts.append(
            Table(table, "With 95% intervals.", heading=f"Real recordings: {_SOURCES.get(source, source)}")
        )
    parts.append(_beside(scores[scores["source"] == "all"], "Real recordings: beside the baselines"))
    parts += _groups(details, "Real recordings: ")
    if len(misses):
        parts.append(
            Table(
                misses.astype(str),
                "What was not answered rightly, or made held-out sweeps worse.",
                heading="Real recordings: every miss",
                most_rows=400,
            )
        )
    return parts


_SOURCES = {
    "all": "all sources",
    "calspan": "flat belt (calspan)",
    "dart": "driven car (dart)",
    "tydex": "steady points (tydex)",
}


def _goals(own: pd.DataFrame) -> str:
    aimed = own[own["target"].notna()] if "target" in own else own.head(0)
    met = int(aimed["met"].fillna(False).astype(bool).sum())
    return f"{met} of {len(aimed)} goals are met."


def _beside(scores: pd.DataFrame, heading: str) -> Table:
    wide = scores.pivot_table(index="name", columns="method", values="value", sort=False).reset_index()
    return Table(wide, "The same cases, the same scorer.", heading=heading)


def _groups(details: dict[str, Any], before: str) -> list[Table]:
    out = []
    for key, words in (("by_strength", "By strength of the effect"), ("by_effect", "By effect")):
        table = pd.DataFrame(details.get(key, [])).dropna(axis="columns", how="all")
        if len(table):
            out.append(Table(table, heading=before + (words.lower() if before else words)))
    return out
