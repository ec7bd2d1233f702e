"""What the proof missed, by effect, and what was said instead; for docs/explanation/concealed_results.md."""

from __future__ import annotations

import ast
from collections import Counter, defaultdict

import pandas as pd
from doc_tables import markdown

OUTCOMES = (
    "named, not first",
    "another name",
    "only the other effect",
    "agrees",
    "can't tell",
    "another verdict",
)
CANNOT_TELL = ("undecided", "unexplained")


def missed_effects(real: pd.DataFrame, simulated: pd.DataFrame) -> str:
    """Missed effects of both halves, the most frequent first, by what was said instead.

    Parameters
    ----------
    real : pandas.DataFrame
        ``verdict``; ``sets``, ``missed``, ``not_first``, ``false``: lists as text.
    simulated : pandas.DataFrame
        ``verdict``; ``named``, ``alternatives``, ``missed``, ``invented``: lists as text.
    """
    counts: dict[str, Counter[str]] = defaultdict(Counter)
    for row in real.itertuples():
        for effect in ast.literal_eval(row.not_first):
            counts[effect][OUTCOMES[0]] += 1
        said = _instead(row.verdict, ast.literal_eval(row.false), ast.literal_eval(row.sets))
        for effect in ast.literal_eval(row.missed):
            counts[effect][said] += 1
    for row in simulated.itertuples():
        names = ast.literal_eval(row.named)
        said = _instead(row.verdict, ast.literal_eval(row.invented), names)
        open_too = ast.literal_eval(row.alternatives)
        for effect in ast.literal_eval(row.missed):
            counts[effect][OUTCOMES[0] if effect in open_too else said] += 1
    rows = [(effect.replace("_", " "), found) for effect, found in counts.items()]
    rows.sort(key=lambda row: (-row[1].total(), row[0]))
    rows.append(("all", sum(counts.values(), Counter())))
    cells = [
        [name, str(found.total()), *(str(found[each] or "") for each in OUTCOMES)] for name, found in rows
    ]
    return markdown(["effect", "missed", *OUTCOMES], cells)


def _instead(verdict: str, false: list, true: list) -> str:
    """What was said where an effect's name is missing."""
    if false:
        return "another name"
    if true:
        return "only the other effect"
    if verdict in CANNOT_TELL:
        return "can't tell"
    return "agrees" if verdict == "agrees" else "another verdict"
