"""Tables of the proof's page: methods, strengths, effects and misses by names that engineers use."""

from __future__ import annotations

import ast
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
    "over_noise": "strength over noise",
    "over_misfit": "strength over misfit",
    "missing_channels": "missing channels",
    "hidden": "hidden from the model",
    "sets": "found, with confidence",
    "not_first": "found, but not first",
    "false": "sets without the truth",
    "held_out_ratio": "held-out error, of before",
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
            out.append(Table(_plain(table), captions[key], heading=heading))
    return out


def misses_table(misses: pd.DataFrame, caption: str, heading: str) -> Table:
    """Every case with a wrong answer.

    Columns in which nothing stands are left out, and those that follow from the truth and the names.
    """
    table = _plain(misses.drop(columns=["missed", "invented"], errors="ignore").astype(str))
    return Table(without_empty_columns(table), caption, heading=heading, most_rows=400)


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
