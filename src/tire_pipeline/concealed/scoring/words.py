"""The scores in the field's words, and whether there are cases enough to judge a goal."""

from __future__ import annotations

import math
from typing import Any

_SCORE_WORDS = {
    "false physics, nothing missing": "False physics: nothing is missing from the model",
    "false physics, artefact only": "False physics: only a fault of the recording is there",
    "false physics": "False physics: nothing missing, or only a fault",
    "any name, nothing missing": "Any name: nothing is missing from the model",
    "artefact found": "Fault of the recording found, and nothing else named",
    "exact set, single": "One effect: named, and nothing else",
    "exact set, single above 0.6 noise": "One effect above 0.6 of the noise: named, and nothing else",
    "exact set, pair": "Two effects: both named, and nothing else",
    "exact set, pair above 0.6 noise": "Two effects above 0.6 of the noise: both named, and nothing else",
    "ambiguous covered": "Ambiguous by design: the truth is among the names",
    "ambiguous covered, first key": "Ambiguous by design, by the answer key of the first published proof",
    "ambiguous, names given": "Ambiguous by design: mean number of names given",
    "false names, outside the catalogue": "Effect outside the catalogue: a name is given anyway",
    "window IoU": "When: overlap of the stretches named and true",
    "regime IoU": "Where: overlap of the ranges named and true",
    "held-out share of the oracle's": "Error removed on held-out data, of what the true model removes",
    "calibration error": "Calibration error: stated confidence against the share that is right",
    "calibration error, by chance alone": "The same, by chance alone if each confidence were exact",
    "calibration error of the findings": "Calibration error of the findings: does one hold a true name",
    "calibration error of the findings, by chance alone": "The same of the findings, by chance alone",
    "right name first, twice the misfit": "Effect twice the misfit: the right name stands first",
    "the same, ambiguous ones too": "The same, including cases that are ambiguous by design",
    "truth among the names, twice the misfit": "Effect twice the misfit: the truth is among the names",
    "truth among the names, any strength": "Effect of any strength: the truth is among the names",
    "hidden physics named first, any strength": "Physics hidden from the model: the right name stands first",
    "hidden physics among the names, any strength": "Physics hidden from the model: among the names",
    "sets that hold nothing of the truth": "Findings of which no name is true",
    "names a set": "Mean number of names that a finding leaves open",
    "sets of more than three names": "Findings that leave more than three names open",
    "held-out error above the model's own": "Cases whose held-out error grew",
    "held-out error over the model's own, largest": "Largest held-out error, after over before",
    "refused": "Recordings that were refused",
}
_Z = 1.96
_LEAST_CASES = 20
"""Cases that a goal needs if it is no share that a perfect score could show."""


def in_words(name: str) -> str:
    """A score's name in the field's words; what has none stays as it is."""
    return _SCORE_WORDS.get(name, name)


def outcome(row: dict[str, Any]) -> str:
    """Say whether a goal is met; nothing where there is no goal.

    With too few cases not even a perfect score would show that the goal is met: the lower end of its 95%
    interval (Wilson), ``n / (n + 1.96**2)``, lies below the goal. A goal that lies outside of the score's own
    interval, on the far side, is missed by any number of cases.

    Parameters
    ----------
    row : dict
        ``target`` (such as ``">= 0.95"``), ``n``, ``met``; the interval ``low`` to ``high`` if there is one.

    Returns
    -------
    str

    Examples
    --------
    >>> outcome({"target": ">= 0.95", "n": 1, "met": True})
    'too few cases'
    >>> outcome({"target": ">= 0.95", "n": 80, "met": True})
    'met'
    >>> outcome({"target": ">= 0.95", "n": 18, "met": False, "low": 0.246, "high": 0.663})
    'missed'
    """
    if not isinstance(row["target"], str):
        return ""
    side, bound = row["target"].split()
    n = 0.0 if math.isnan(float(row["n"])) else float(row["n"])
    low, high = row.get("low", math.nan), row.get("high", math.nan)
    if n and (high < float(bound) if side == ">=" else low > float(bound)):
        return "missed"
    share = float(bound) if side == ">=" else 1.0 - float(bound)
    enough = n / (n + _Z**2) >= share if 0.0 < share < 1.0 else n >= _LEAST_CASES
    if not enough:
        return "too few cases"
    return "met" if str(row["met"]) == "True" else "missed"
