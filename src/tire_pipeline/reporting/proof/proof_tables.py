"""Tables of the proof's page: methods, strengths, effects and misses by names that engineers use."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from tire_pipeline.reporting.page_parts import Table, without_empty_columns

METHODS = {
    "explain_mismatch": "ours",
    "bic_stepwise": "stepwise regression",
    "pysindy": "sparse regression",
    "gaussian_process": "Gaussian process",
    "refitted_formula": "refitted formula",
}
"""Methods as they are called on the page; others keep their names."""

_KIND_WORDS = {
    "single": "one effect",
    "pair": "two effects",
    "artefact": "fault of the recording",
    "ambiguous": "ambiguous by design",
    "nothing": "nothing missing",
    "unknown": "outside the catalogue",
}
_COLUMN_TITLES = {
    "above": "strength above",
    "up_to": "up to",
    "name": "score",
    "value": "share",
    "low": "95% from",
    "high": "to",
    "n": "cases",
    "n_strong": "strong cases",
    "first_strong": "strong: first",
    "among_strong": "strong: among",
    "first": "named first",
    "among": "among the names",
    "true": "true effects",
    "missing_channels": "missing channels",
    "sets": "found, with confidence",
    "held_out_ratio": "held-out ratio",
}
_SCORES = {"right": "all named, nothing else", "first": "named first", "among": "among the names"}


def groups(details: dict[str, Any], before: str, strength: str) -> list[Table]:
    """Shares by strength of the effect and by effect.

    Parameters
    ----------
    details : dict
        ``by_strength`` and ``by_effect``, lists of rows.
    before : str
        Stands before the headings.
    strength : str
        What strengths are multiples of.

    Returns
    -------
    list of Table
    """
    captions = {
        "by_strength": "Share of the cases that were answered correctly. Strength: RMS of the effect's "
        f"force, as a multiple of {strength}.",
        "by_effect": "How often each effect was named where it was the truth.",
    }
    out = []
    for key, words in (("by_strength", "By strength of the effect"), ("by_effect", "By effect")):
        table = pd.DataFrame(details.get(key, [])).dropna(axis="columns", how="all")
        if len(table):
            heading = before + (words.lower() if before else words)
            out.append(Table(_plain(table), captions[key], heading=heading, decimals=2))
    return out


_FOLLOW = ("missed", "invented", "not_first", "false")
"""Columns that follow from the truth and the names."""


def misses_table(misses: pd.DataFrame, caption: str, heading: str) -> Table:
    """Every case with a wrong answer.

    Columns in which nothing stands are left out, and those that follow from the truth and the names. What
    belongs together stands in one column, so that a table fits the page.
    """
    rows = misses.to_dict("records")
    table = misses.drop(columns=list(_FOLLOW), errors="ignore")
    table["case"] = [str(row["case"]).rpartition("_")[2] for row in rows]
    strengths = [name for name in ("over_noise", "over_misfit") if name in table]
    table["true"] = [_truth(row, strengths) for row in rows]
    if "rate" in table:
        table["source"] = [_source(row) for row in rows]
    if "held_out_ratio" in table:
        table["held_out_ratio"] = table["held_out_ratio"].map(
            lambda ratio: f"{ratio:.2f}", na_action="ignore"
        )
    table = _plain(table.drop(columns=[*strengths, "rate", "hidden"], errors="ignore").astype(str))
    return Table(without_empty_columns(table), caption, heading=heading, most_rows=400)


def _truth(row: Mapping[str, Any], strengths: Sequence[str]) -> str:
    """The true effects, each with its strength, and whether it was hidden from the model.

    Examples
    --------
    >>> row = {"true": "['wear', 'camber']", "over_misfit": "[0.7, 2.9]", "hidden": "['camber']"}
    >>> _truth(row, ["over_misfit"])
    'wear (0.7), camber (2.9, hidden)'
    """
    effects, hidden = _items(row["true"]), _items(row.get("hidden", "[]"))
    sizes = [size for name in strengths for size in _items(row[name])] or [None] * len(effects)
    notes = [
        ", ".join([*([] if size is None else [str(size)]), *(["hidden"] if effect in hidden else [])])
        for effect, size in zip(effects, sizes, strict=True)
    ]
    both = zip(effects, notes, strict=True)
    return ", ".join(f"{effect} ({note})" if note else str(effect) for effect, note in both)


def _source(row: Mapping[str, Any]) -> str:
    return f"{row['source']} at {row['rate']:g} Hz" if row["rate"] == row["rate"] else str(row["source"])


def _items(value: Any) -> list[Any]:
    """A list, also one that a CSV holds as text."""
    if isinstance(value, str):
        return list(ast.literal_eval(value)) if value.startswith("[") else []
    return list(value) if isinstance(value, (list, tuple)) else []


def _plain(table: pd.DataFrame) -> pd.DataFrame:
    shown = table.copy()
    if "kind" in shown:
        shown["kind"] = shown["kind"].map(lambda kind: _KIND_WORDS.get(kind, kind))
    if "name" in shown:
        shown["name"] = shown["name"].map(lambda name: _SCORES.get(name, name))
    for name in shown.columns:
        if not pd.api.types.is_numeric_dtype(shown[name]) and name not in ("case", "kind"):
            shown[name] = shown[name].map(_listed)
    return shown.rename(columns=_COLUMN_TITLES)


def _listed(value: Any) -> Any:
    """A list as its items, a set with its confidence as ``a or b (57%)``; names without underscores.

    Examples
    --------
    >>> _listed("['wear', 'force_offset']"), _listed("[]"), _listed("[[['wear', 'force_gain'], 0.568]]")
    ('wear, force offset', '', 'wear or force gain (57%)')
    """
    if not isinstance(value, str):
        return value
    try:
        found = ast.literal_eval(value) if value.startswith("[") else value
    except (SyntaxError, ValueError):
        found = value
    if isinstance(found, str):
        return "" if found in ("nan", "None") else found.replace("_", " ")
    return ", ".join(_item(item) for item in found)


def _item(item: Any) -> str:
    if isinstance(item, list) and len(item) == 2 and isinstance(item[0], list):
        return f"{' or '.join(str(name) for name in item[0])} ({item[1]:.0%})".replace("_", " ")
    return str(item).replace("_", " ")
