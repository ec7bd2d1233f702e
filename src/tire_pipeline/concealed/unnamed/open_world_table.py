"""The open-world proof as a table: goals, results, baselines, and every case."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

_STRONG_MISFITS, _CLEAR_MISFITS = 2.0, 1.0
_CASE_COLUMNS = (
    "case mechanism beside strength verdict names true_drivers drivers drivers_right equation_right removed "
    "worse seconds"
).split()


def table(rows: Sequence[dict[str, Any]], head: str) -> str:
    """Return the scores and the cases as Markdown."""
    cases = pd.DataFrame(list(rows))
    for column in ("removed", "removed_moment"):
        cases[column] = cases[column].astype(float)
    lines = [head, "", "| score | value | cases | goal |", "|---|---|---|---|"]
    for name, values, goal in _scores(cases):
        value = f"{values:.2f}" if np.isfinite(values) else "–"
        lines.append(f"| {name[0]} | {value} | {name[1]} | {goal} |")
    lines += ["", "| " + " | ".join(_CASE_COLUMNS) + " |", "|" + "---|" * len(_CASE_COLUMNS)]
    for _, row in cases.iterrows():
        lines.append("| " + " | ".join(_cell(row[c]) for c in _CASE_COLUMNS) + " |")
    return "\n".join([*lines, ""])


def _cell(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.2f}" if np.isfinite(value) else "–"
    return str(value)


def _scores(cases: pd.DataFrame) -> list[tuple[tuple[str, int], float, str]]:
    clear = cases[cases["strength"] >= _CLEAR_MISFITS]
    judged = cases[cases["removed"].notna()]
    strong = judged[judged["strength"] >= _STRONG_MISFITS]
    grammar = judged[judged["in_grammar"]]
    in_grammar = cases[cases["in_grammar"]]
    of_moment = cases[cases["removed_moment"].notna()]
    with_equation = cases[cases["equation"] != ""]

    def row(text: str, part: pd.DataFrame, values: Any, goal: str = "") -> tuple[tuple[str, int], float, str]:
        return (text, len(part)), float(values) if len(part) else float("nan"), goal

    out = [
        row("no false name, one misfit or more", clear, 1.0 - clear["false_name"].mean(), "0.95"),
        row("the right drivers and none more", cases, cases["drivers_right"].mean(), "0.85"),
        row("the same where an equation was kept", with_equation, with_equation["drivers_right"].mean()),
        row(
            "a true driver among them, where an equation was kept",
            with_equation,
            with_equation["driver_shared"].mean(),
        ),
        row("an equation was kept", cases, (cases["equation"] != "").mean()),
        row("held-out error removed, of the oracle's, median", judged, judged["removed"].median(), "0.6"),
        row("the same, two misfits or more, lowest tenth", strong, strong["removed"].quantile(0.1), "0.3"),
        row("the same, what the grammar can say, median", grammar, grammar["removed"].median(), "0.8"),
        row(
            "the true equation among the first three", in_grammar, in_grammar["equation_right"].mean(), "0.5"
        ),
        row("the aligning moment's error removed, median", of_moment, of_moment["removed_moment"].median()),
        row("the aligning moment made worse", cases, cases["worse_moment"].mean(), "0"),
        row("a force made worse", cases, cases["worse"].mean(), "0"),
        row("a force made worse by the true change itself", cases, cases["oracle_worse"].mean()),
    ]
    for name in ("pysindy", "gaussian_process", "gradient_boosting"):
        values = judged[f"removed_{name}"].astype(float)
        out.append(row(f"{name}: held-out error removed, median", judged, values.median()))
        out.append(row(f"{name}: a force made worse", cases, cases[f"worse_{name}"].mean()))
    out.append(row("processor seconds a case, median", cases, cases["seconds"].median()))
    out.append(row("the same, at most", cases, cases["seconds"].max(), "60"))
    return out
