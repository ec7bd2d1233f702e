"""What the thesis prints, as data: ``published.json`` holds its tables and the words on its figures."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

import pandas as pd

from tire_pipeline.errors import DomainError

PUBLISHED_METRICS = {
    "Forces": "forces",
    "Slope": "cornering_stiffness",
    "Peak Friction Coeff.": "peak_friction",
    "Average": "mean",
}
"""Columns of Tables 5.10 to 5.21 -> our names of the metrics."""

_PUBLISHED_REPRESENTATIONS = {
    "MF Coefficients": "coefficients",
    "Latent": "latent",
    "Power Series": "power_series",
    "Key Attributes": "key_attributes",
}
AGENT_TABLES = tuple(f"5.{number}" for number in range(10, 22))


@dataclass(frozen=True)
class PublishedTable:
    """A table of the thesis, numbers as printed."""

    number: str
    caption: str
    frame: pd.DataFrame


@dataclass(frozen=True)
class PublishedFigure:
    """A figure of the thesis: its caption, and what the text says that it shows."""

    number: str
    caption: str
    says: str


@cache
def _content() -> dict[str, Any]:
    text = files("tire_pipeline.thesis").joinpath("published.json").read_text(encoding="utf-8")
    content: dict[str, Any] = json.loads(text)
    return content


def _entry(kind: str, number: str) -> dict[str, Any]:
    entries = _content()[kind]
    if number not in entries:
        raise DomainError(
            f"the thesis' {kind} hold no {number}", todo=f"choose one of {', '.join(sorted(entries))}"
        )
    entry: dict[str, Any] = entries[number]
    return entry


def published_table(number: str) -> PublishedTable:
    """Return a table of the thesis.

    Parameters
    ----------
    number : str
        For example ``"5.6"``.

    Raises
    ------
    DomainError
        If it is not held here.

    Examples
    --------
    >>> published_table("5.6").frame["Test Accuracy"].max()
    np.float64(0.97)
    """
    entry = _entry("tables", number)
    return PublishedTable(number, entry["caption"], pd.DataFrame(entry["rows"], columns=entry["columns"]))


def published_figure(number: str) -> PublishedFigure:
    """Return a figure's caption and what the thesis' text says about it.

    Raises
    ------
    DomainError
        If it is not held here.
    """
    entry = _entry("figures", number)
    return PublishedFigure(number, entry["caption"], entry["says"])


def published_agents() -> pd.DataFrame:
    """Return Tables 5.10 to 5.21 in one.

    Returns
    -------
    DataFrame
        ``table, quantity`` (ratio: MSE over that of the untranslated files; improved: share of files),
        ``algorithm, reward, representation, n_bins, metric, value``.
    """
    rows = []
    for number in AGENT_TABLES:
        entry = _entry("tables", number)
        for name, *values in entry["rows"]:
            representation, _, algorithm = name.rpartition(" ")
            if representation not in _PUBLISHED_REPRESENTATIONS:
                continue  # the row of the untranslated files, 1 by definition
            for column, value in zip(entry["columns"][1:], values, strict=True):
                rows.append(
                    {
                        "table": number,
                        "quantity": entry["quantity"],
                        "algorithm": algorithm,
                        "reward": entry["reward"],
                        "representation": _PUBLISHED_REPRESENTATIONS[representation],
                        "n_bins": entry["bins"],
                        "metric": PUBLISHED_METRICS[column],
                        "value": float(value),
                    }
                )
    return pd.DataFrame(rows)
