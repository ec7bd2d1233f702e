"""Doubts: whether an unnamed form explains the recording as well as a named effect."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tire_pipeline.mismatch import settings
from tire_pipeline.mismatch.discrepancy.form import Form
from tire_pipeline.mismatch.discrepancy.gram import System
from tire_pipeline.mismatch.discrepancy.unnamed import constant_form, forms
from tire_pipeline.mismatch.inference.refit import Fit
from tire_pipeline.mismatch.inference.screening import best_gain, without
from tire_pipeline.mismatch.inference.search_state import Search
from tire_pipeline.mismatch.inference.shapes import with_shapes
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray


@dataclass(frozen=True)
class Doubt:
    """The best unnamed form beside one accepted effect: in its place, and on top of it.

    Parameters
    ----------
    index : int
        Of the effect.
    label : str
        Of the form.
    size : float
        Log evidence beyond what a proven name allows.
    on_top : float
        Log evidence that the best form adds to all accepted effects.
    part : float
        The larger of what a form explains in the effect's place and on top, over the effect's evidence.
    """

    index: int
    label: str
    size: float
    on_top: float
    part: float


def doubts(search: Search) -> list[Doubt]:
    """Compare each accepted effect with all unnamed forms.

    A form that holds a constant has to beat the constant clearly: what is no likelier with a memory has none.
    What the misfit may do anyway (rates, memories) speaks against a name only in its place, not on top of it.
    """
    fit = search.fit
    on_top = _gains(search, with_shapes(search, search.system, fit.changes), fit)
    beside = [
        gain for gain, form in zip(on_top, forms(search.data, fit.changes), strict=True) if not form.in_misfit
    ]
    top, top_label = max(beside, default=(-np.inf, ""))
    most = max(g.gain for g in search.gates)
    out = []
    for i, name in enumerate(fit.names):
        reduced = without(search, fit, i)
        gain = search.gates[i].gain
        alone = with_shapes(search, search.system, fit.changes, i)
        in_place = _gains(search, alone, reduced)
        other = [not form.in_misfit for form in forms(search.data, reduced.changes)]
        place, label = max(in_place, default=(-np.inf, ""))
        constant = constant_form(search.data, reduced.changes)
        plain = _gain(search, alone, reduced, residual(search.data, reduced.changes), constant)
        instead = _instead(gain, max(gain, plain + settings.TIE), in_place, on_top)
        if any(other):
            joints = [[g for g, o in zip(gains, other, strict=True) if o] for gains in (in_place, on_top)]
            as_likely, label = _instead(gain, gain - settings.ODDS, *joints)
            instead = max(instead, (as_likely, label))
        search.log.append(
            f"unnamed for {name} gain {gain:.1f}: {place:.1f} {label} (constant {plain:.1f}, instead "
            f"{instead[0]:.1f}); on top {top:.1f} {top_label}"
        )
        allowed = (settings.UNNAMED_PART * gain, settings.UNNAMED_LEAST, settings.UNNAMED_OF_ALL * most)
        beyond = top - max(allowed)
        part = max(place, top, 0.0) / max(gain, 1.0)
        size, which = instead if instead[0] > beyond else (beyond, top_label)
        out.append(Doubt(i, which, size, top, part))
    return out


Gain = tuple[float, str]
"""Log evidence, and the label of the form that gains them."""


def _instead(gain: float, least: float, in_place: list[Gain], on_top: list[Gain]) -> Gain:
    """Return by how much the best form that can stand in for an effect beats it, and the form's label.

    A form stands in for the effect if beside it the effect would not pay for itself, or not for more than the
    form's own error; else both are there.
    """
    best = (-np.inf, "")
    for (place, label), (top, _) in zip(in_place, on_top, strict=True):
        if gain + top - place < max(settings.LEAST_GAIN, settings.SHAPE_SHARE**2 * gain):
            best = max(best, (place - least, label))
    return best


def _gains(search: Search, system: System, fit: Fit) -> list[Gain]:
    """Return what each unnamed form gains on top of a fit."""
    rest = residual(search.data, fit.changes)
    return [(_gain(search, system, fit, rest, f), f.label) for f in forms(search.data, fit.changes)]


def _gain(search: Search, system: System, fit: Fit, rest: dict[str, Array], form: Form) -> float:
    """Return what one form gains on top of a fit that leaves ``rest``."""
    columns = form.columns
    if fit.labels:
        columns = {o: np.hstack([fit.columns[o], c]) for o, c in columns.items()}
    info, score, _ = system.reduce(system.sums(rest, columns))
    return best_gain(info, score, len(fit.labels), search) - form.less
