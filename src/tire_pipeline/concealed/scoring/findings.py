"""Findings of a report: sets of names, each with its confidence."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from tire_pipeline.concealed.effect_names import ARTEFACTS, PHYSICS

NameSet = tuple[tuple[str, ...], float]


def name_sets(report: Mapping[str, Any]) -> list[NameSet]:
    """Sets of names of a report with their confidence: its ``sets``, or each effect with its alternatives.

    Parameters
    ----------
    report : mapping
        ``report.to_dict()``.

    Returns
    -------
    list of (names, confidence)
        The name put first comes first. *unexplained* is no name.
    """
    given = report.get("sets")
    if given is None:
        given = [
            ((e["name"], *e.get("alternatives", ())), e.get("confidence", 1.0))
            for e in report.get("effects", ())
        ]
    else:
        given = [(s["names"], s["confidence"]) if isinstance(s, Mapping) else s for s in given]
    known = {*PHYSICS, *ARTEFACTS}
    sets = [(tuple(str(n) for n in names if n in known), float(p)) for names, p in given]
    return [(names, p) for names, p in sets if names]
