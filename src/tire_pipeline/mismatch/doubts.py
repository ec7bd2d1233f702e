"""Doubts: whether a form without a name explains the recording as well as a named effect."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tire_pipeline.mismatch import settings
from tire_pipeline.mismatch.gram import System
from tire_pipeline.mismatch.refit import Fit, residual
from tire_pipeline.mismatch.screening import best_gain, without
from tire_pipeline.mismatch.shapes import with_shapes
from tire_pipeline.mismatch.state import Search
from tire_pipeline.mismatch.unnamed import forms

Array = np.ndarray


@dataclass(frozen=True)
class Doubt:
    """The best form without a name beside one accepted effect: in its place, and on top of it.

    Parameters
    ----------
    index : int
        Of the effect.
    label : str
        Of the form.
    size : float
        Nats beyond what a proven name allows.
    on_top : float
        Nats that the best form adds to all accepted effects.
    part : float
        The larger of what a form explains in the effect's place and on top, over the effect's evidence.
    """

    index: int
    label: str
    size: float
    on_top: float
    part: float


def doubts(search: Search) -> list[Doubt]:
    """Compare each accepted effect with all forms without a name."""
    fit = search.fit
    system = with_shapes(search, search.system, fit.changes)
    top, top_label = _best_form(search, system, fit)
    most = max(g.gain for g in search.gates)
    out = []
    for i, name in enumerate(fit.names):
        reduced = without(search, fit, i)
        gain = search.gates[i].gain
        place, label = _best_form(search, with_shapes(search, search.system, fit.changes, i), reduced)
        search.log.append(
            f"unnamed for {name} gain {gain:.1f}: {place:.1f} {label}; on top {top:.1f} {top_label}"
        )
        instead = place - gain
        allowed = (settings.UNNAMED_PART * gain, settings.UNNAMED_LEAST, settings.UNNAMED_OF_ALL * most)
        beyond = top - max(allowed)
        part = max(place, top, 0.0) / max(gain, 1.0)
        size, which = (instead, label) if instead > beyond else (beyond, top_label)
        out.append(Doubt(i, which, size, top, part))
    return out


def _best_form(search: Search, system: System, fit: Fit) -> tuple[float, str]:
    """Return the largest gain of a form without a name on top of a fit, and its label."""
    rest = residual(search.data, fit.changes)
    best = (-np.inf, "")
    for form in forms(search.data, fit.changes):
        columns = form.columns
        if fit.labels:
            columns = {o: np.hstack([fit.columns[o], c]) for o, c in columns.items()}
        info, score, _ = system.reduce(system.sums(rest, columns))
        best = max(best, (best_gain(info, score, len(fit.labels), search), form.label))
    return best
