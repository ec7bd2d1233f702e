"""The committed table of the proof on real recordings, shown where the recordings are not there."""

from __future__ import annotations

import json
from importlib import resources
from io import StringIO
from typing import Any

import pandas as pd

TABLE = "published.csv"


def published() -> tuple[pd.DataFrame, dict[str, Any]]:
    """Scores of the last published proof, and what it was made with.

    Returns
    -------
    scores : pandas.DataFrame
        ``method, source, name, value, low, high, n, target, met``; empty before the first proof.
    made : dict
        ``seed``, ``cases``, ``code`` (hash of what was judged), ``date``, ``sha256`` (of the answers); empty
        before the first proof.
    """
    file = resources.files("tire_pipeline.concealed.real").joinpath(TABLE)
    if not file.is_file():
        return pd.DataFrame(columns=["method", "source", "name", "value"]), {}
    first, _, rest = file.read_text(encoding="utf-8").partition("\n")
    return pd.read_csv(StringIO(rest)), json.loads(first.removeprefix("# "))


def published_text(scores: pd.DataFrame, made: dict[str, Any]) -> str:
    """The file that :func:`published` reads: what it was made with in the first line, then the table."""
    return f"# {json.dumps(made, sort_keys=True)}\n{scores.to_csv(index=False)}"
