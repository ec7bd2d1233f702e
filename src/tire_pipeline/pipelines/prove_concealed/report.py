"""The page of the proof."""

from __future__ import annotations

from typing import Any

import pandas as pd

from tire_pipeline.reporting import Table, Text, render_page


def proof_page(scores: pd.DataFrame, misses: pd.DataFrame, details: dict[str, Any]) -> str:
    """Scores with intervals beside the baselines, by strength, and every miss."""
    own = scores[scores["method"] == "explain_mismatch"]
    aimed = own[own["target"].notna()] if "target" in own else own.head(0)
    met = int(aimed["met"].fillna(False).astype(bool).sum())
    lines = [
        f"{details['explain_mismatch']['n']} recordings by a rig simulator that is no Magic Formula, with an "
        f"effect concealed in most. {met} of {len(aimed)} goals are met.",
        f"The answers were sealed before anything was explained: SHA-256 {details['sha256']}.",
    ]
    parts: list[Text | Table] = [
        Text(lines, emphasis=True),
        Table(own.drop(columns="method"), "With 95% intervals.", heading="explain_mismatch"),
    ]
    wide = scores.pivot_table(index="name", columns="method", values="value", sort=False).reset_index()
    parts.append(Table(wide, "The same cases, the same scorer.", heading="Beside the baselines"))
    for key, words in (("by_strength", "By strength of the effect"), ("by_effect", "By effect")):
        table = pd.DataFrame(details["explain_mismatch"][key]).dropna(axis="columns", how="all")
        if len(table):
            parts.append(Table(table, heading=words))
    if len(misses):
        parts.append(
            Table(misses.astype(str), "What was not answered rightly.", heading="Every miss", most_rows=400)
        )
    return render_page("Proof on concealed effects", parts)
