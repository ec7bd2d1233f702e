"""What the files became, in one plain sentence each."""

from __future__ import annotations

from typing import Any

import pandas as pd

from tire_pipeline.evaluation.all_translators import NO_CHANGE, OUR_AGENT, UNJUDGED
from tire_pipeline.evaluation.compare_with_target import FLOOR
from tire_pipeline.translation.result import TRANSLATED

METRIC = "forces"
_FEW_TIRES = 20
"""Tires below which an error and its floor are called uncertain."""


def say_outcome(
    translated_table: pd.DataFrame,
    evaluation_summary: pd.DataFrame,
    best: dict[str, Any],
    target_category: str,
) -> list[str]:
    """Sum up the best translator's result beside the floor, then that of the others.

    Parameters
    ----------
    translated_table, evaluation_summary : DataFrame
    best : dict
        From :func:`.best_translator.choose_best`.
    target_category : str

    Returns
    -------
    list of str
        The first sentences of the report, and the last lines of a run.
    """
    lines = []
    forces = evaluation_summary[evaluation_summary["metric"] == METRIC]
    for name in sorted(forces["set"].unique(), key=_most_tires(translated_table)):
        lines += _judged(str(name), forces[forces["set"] == name], translated_table, best, target_category)
    if UNJUDGED in set(translated_table["set"]):
        lines.append(_unjudged(translated_table, best, target_category))
    lines.append(_whose_files(best))
    return lines


def _most_tires(table: pd.DataFrame) -> Any:
    tires = table.groupby("set")["tire"].nunique()
    return lambda name: -int(tires[name])


def _judged(
    name: str, forces: pd.DataFrame, table: pd.DataFrame, best: dict[str, Any], target: str
) -> list[str]:
    rms = forces.set_index("translator")["rms"]
    before = rms[NO_CHANGE]
    part = table[(table["set"] == name) & (table["translator"] == best["name"])]
    acted = int((part["verdict"] == TRANSLATED).sum())
    acted_on = f"It translated {acted} of these {len(part)} files{_unchanged(len(part) - acted)}."
    others = [who for who in table["translator"].unique() if who not in (best["name"], NO_CHANGE)]
    left = [
        f"{_subject(who)} leaves {rms[who]:,.0f} N ({rms[who] / before:.0%})." for who in others if who in rms
    ]
    tires = part["tire"].nunique()
    uncertain = f" With {tires} tires, both figures are uncertain." if tires < _FEW_TIRES else ""
    return [
        f"{_subject(str(best['name']))}, the best translator, brings the RMS error of lateral force from "
        f"{before:,.0f} N to {rms[best['name']]:,.0f} N ({rms[best['name']] / before:.0%}) on the "
        f"{tires} tires of the set '{name}', which no translator has seen. The floor is "
        f"{rms[FLOOR]:,.0f} N ({rms[FLOOR] / before:.0%}): what {target}, the target, gets by "
        f"measuring the same tires again."
        f"{uncertain}",
        " ".join([acted_on, *left]),
    ]


def _unchanged(count: int) -> str:
    if not count:
        return ""
    said = "one was left unchanged and counts" if count == 1 else f"{count} were left unchanged and count"
    return f"; the other {said} as such"


def _subject(name: str) -> str:
    return name.capitalize() if name == OUR_AGENT else f"The {name}"


def _object(best: dict[str, Any]) -> str:
    return _article(str(best["name"]))


def _article(name: str) -> str:
    return name if name == OUR_AGENT else f"the {name}"


def _unjudged(table: pd.DataFrame, best: dict[str, Any], target: str) -> str:
    chosen = table[table["translator"] == best["name"]]
    part, count = chosen[chosen["verdict"] == TRANSLATED], len(chosen)
    rest = (
        f"No evaluation tires measured by {target} were given, so these files show neither the true error "
        "nor the floor. `kedro run --pipeline translate`, with the same --params, translates all of your "
        "files."
    )
    if part.empty:
        verdicts = ", ".join(f"{n} {what}" for what, n in chosen["verdict"].value_counts().items())
        return f"Of your files in the test split ({count}), none was translated ({verdicts}). {rest}"
    middle = part["expected_rms_ratio"].median()
    estimate = (
        f"their RMS error is expected to shrink to {middle:.0%} (median, the translator's own estimate)"
        if middle == middle
        else "the translator gives no estimate of its error"
    )
    return (
        f"Of your files in the test split ({count}), {len(part)} {'was' if len(part) == 1 else 'were'} "
        f"translated to {target} by {_object(best)}: {estimate}. {rest}"
    )


def _whose_files(best: dict[str, Any]) -> str:
    if not best["tires"]:
        return (
            f"The .tir files are those of {_object(best)}; there were no tuning tires to choose the best "
            "translator by."
        )
    ratios = ", ".join(f"{ratio:.0%} by {_article(who)}" for who, ratio in best["rms_ratio"].items())
    return (
        f"The .tir files are those of {_object(best)}. It was chosen on {best['tires']} tuning tires, "
        "which are used for nothing else, by the mean RMS error of lateral force, cornering stiffness and "
        f"peak friction as a share of doing nothing: {ratios}."
    )
