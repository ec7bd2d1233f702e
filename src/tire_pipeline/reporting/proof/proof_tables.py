"""Tables of the proof's page: methods, strengths, effects and misses by names that engineers use."""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from tire_pipeline.concealed.effect_names import UNKNOWN_EFFECTS
from tire_pipeline.mismatch.effects import catalogue
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
_UNKNOWN_WORDS = {
    "backlash": "backlash of the steering",
    "stick_slip": "stick-slip",
    "load_rate": "rate of the load",
    "slip_rate": "rate of the slip angle",
    "drum_seam": "seam of the drum",
    "rig_resonance": "resonance of the rig",
    "friction_memory": "friction that lags behind the slip",
    "quantisation": "coarse resolution of a channel",
}
_EFFECT_COLUMNS = ("true", "named", "alternatives", "sets", "effect")
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
        "by_effect": "How often each effect of the catalogue was named where it was the truth.",
    }
    out = []
    for key, words in (("by_strength", "By strength of the effect"), ("by_effect", "By effect")):
        table = pd.DataFrame(details.get(key, [])).dropna(axis="columns", how="all")
        if "effect" in table:
            table = table[~table["effect"].isin(UNKNOWN_EFFECTS)]
        if len(table):
            heading = before + (words.lower() if before else words)
            table, counted = _without_one_score(table)
            out.append(Table(_plain(table), captions[key] + counted, heading=heading, decimals=2))
    return out


def _without_one_score(table: pd.DataFrame) -> tuple[pd.DataFrame, str]:
    """A table without its column of scores if all rows have the same, and a sentence on that score."""
    if "name" not in table or table["name"].nunique() > 1:
        return table, ""
    said = {"right": " Answered correctly: all effects are named, and nothing else."}
    return table.drop(columns="name"), said.get(table["name"].iloc[0], "")


_FOLLOW = ("missed", "invented", "not_first", "false")
"""Columns that follow from the truth and the names."""


def misses_table(misses: pd.DataFrame, caption: str, heading: str) -> Table:
    """Every case with a wrong answer, with effects as the page of a recording names them.

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
    table = _joined(_joined(table, "alternatives", " (alternatives: {})"), "missing channels", ", without {}")
    return Table(without_empty_columns(table), caption, heading=heading, most_rows=400)


_STAND_BEHIND = {"alternatives": "named", "missing channels": "kind"}


def _joined(table: pd.DataFrame, name: str, said: str) -> pd.DataFrame:
    """A table in which a column stands behind another one, so that it is narrow enough for a page."""
    before = _STAND_BEHIND[name]
    if name not in table or before not in table:
        return table
    both = [
        text + said.format(further) if text and further else text
        for text, further in zip(table[before], table[name], strict=True)
    ]
    return table.assign(**{before: both}).drop(columns=name)


def _truth(row: Mapping[str, Any], strengths: Sequence[str]) -> str:
    """The true effects, each with its strength, and whether it was hidden from the model.

    Examples
    --------
    >>> row = {"true": "['wear', 'camber']", "over_misfit": "[0.7, 2.9]", "hidden": "['camber']"}
    >>> _truth(row, ["over_misfit"])
    'wear (0.70); camber (2.90, hidden)'
    """
    effects, hidden = _items(row["true"]), _items(row.get("hidden", "[]"))
    sizes = [size for name in strengths for size in _items(row[name])] or [None] * len(effects)
    notes = [
        ", ".join([*([] if size is None else [f"{size:.2f}"]), *(["hidden"] if effect in hidden else [])])
        for effect, size in zip(effects, sizes, strict=True)
    ]
    both = zip(effects, notes, strict=True)
    return _BETWEEN_EFFECTS.join(
        f"{_effect(effect)} ({note})" if note else _effect(effect) for effect, note in both
    )


def _source(row: Mapping[str, Any]) -> str:
    return f"{row['source']} at {row['rate']:g} Hz" if row["rate"] == row["rate"] else str(row["source"])


def _items(value: Any) -> list[Any]:
    """A list, also one that a CSV holds as text."""
    if isinstance(value, str):
        try:
            return list(ast.literal_eval(value)) if value.startswith("[") else []
        except (SyntaxError, ValueError):
            return [value]
    return list(value) if isinstance(value, (list, tuple)) else []


def _plain(table: pd.DataFrame) -> pd.DataFrame:
    shown = table.copy()
    if "kind" in shown:
        shown["kind"] = shown["kind"].map(lambda kind: _KIND_WORDS.get(kind, kind))
    if "name" in shown:
        shown["name"] = shown["name"].map(lambda name: _SCORES.get(name, name))
    for name in shown.columns:
        if not pd.api.types.is_numeric_dtype(shown[name]) and name not in ("case", "kind"):
            shown[name] = shown[name].map(_effects if name in _EFFECT_COLUMNS else _listed)
    return shown.rename(columns=_COLUMN_TITLES)


_NO_TEXT = ("nan", "None")
_BETWEEN_EFFECTS = "; "
"""Between effects: a title may hold a comma, or an *or*."""


def _effect(name: object) -> str:
    """An effect as the page of a recording names it, without the article; others in plain words."""
    text = str(name)
    known = catalogue().get(text)
    words = known.title if known else _UNKNOWN_WORDS.get(text, text.replace("_", " "))
    return re.sub("^an? ", "", words)


def _effects(value: Any) -> Any:
    """Effects by their titles; names of which one is the cause stand between slashes, with their confidence.

    Examples
    --------
    >>> _effects("['wear', 'force_offset']"), _effects("low_pass"), _effects("[[['wear', 'camber'], 0.568]]")
    ('wear; offset of a force channel', 'low-pass filter on the force channels', 'wear / camber (57%)')
    """
    if not isinstance(value, str):
        return value
    if value.startswith("["):
        return _BETWEEN_EFFECTS.join(_item(item) for item in _items(value))
    return "" if value in _NO_TEXT else _effect(value)


def _listed(value: Any) -> Any:
    """A list as its items, names without underscores.

    Examples
    --------
    >>> _listed("['tread_temperature', 'speed']"), _listed("[]"), _listed("agrees")
    ('tread temperature, speed', '', 'agrees')
    """
    if not isinstance(value, str):
        return value
    if value.startswith("["):
        return ", ".join(str(item) for item in _items(value)).replace("_", " ")
    return "" if value in _NO_TEXT else value.replace("_", " ")


def _item(item: Any) -> str:
    if isinstance(item, list) and len(item) == 2 and isinstance(item[0], list):
        return f"{' / '.join(map(_effect, item[0]))} ({item[1]:.0%})"
    return _effect(item)
