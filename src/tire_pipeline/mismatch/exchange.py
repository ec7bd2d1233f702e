"""Exchange: one effect, or two, of a set for another one, where that is likelier."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

from tire_pipeline.mismatch import settings
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.gates import left_by
from tire_pipeline.mismatch.gram import System
from tire_pipeline.mismatch.refit import Fit, objective, refit
from tire_pipeline.mismatch.screening import gain_of, likeliest, prune, rank, screen, without
from tire_pipeline.mismatch.shapes import with_shapes
from tire_pipeline.mismatch.state import Search

_FORMS = 3
"""How many other effects are tried in each place."""


def exchanged(search: Search) -> list[Fit]:
    """Return the sets with something exchanged that are likelier than the one found, likeliest first.

    Wear and temperature together look like a surface that changed: once both are in, adding and dropping
    one effect at a time never leads there. A set with as many effects has to be likelier by ``TIE``; one
    with fewer, or with a more usual one of two that look the same, only about as likely. None may leave
    plainly more of the mismatch.

    Parameters
    ----------
    search : Search
        With at least two effects found; not changed.
    """
    empty, usual = objective(search.system, []), rank(search, search.fit)
    most = left_by(search, search.fit) / settings.PLAINLY_LESS
    out = []
    for group in _groups(len(search.fit.names)):
        rest = without(search, search.fit, *group)
        shaped = with_shapes(search, search.system, rest.changes)
        found = gain_of(search, search.fit.judged_by(shaped), empty)
        for fit in _in_place_of(search, group, rest, shaped):
            simpler = len(group) > 1 or rank(search, fit) < usual
            less = _less(search, group, fit) if simpler else -settings.TIE
            if gain_of(search, fit, empty) > found - less and left_by(search, fit) <= most:
                out.append(fit)
    return likeliest(search, out)


def _less(search: Search, group: tuple[int, ...], fit: Fit) -> float:
    """Nats by which a simpler or more usual set may be less likely.

    Of two lags as much as their forms may get wrong: a short filter and a delay are the same but for it.
    """
    least = 0.5 * settings.TIE
    if len(group) > 1 or not catalogue()[fit.names[-1]].dynamic:
        return least
    return max(least, settings.SHAPE_SHARE**2 * search.gates[group[0]].gain)


def _groups(count: int) -> Iterator[tuple[int, ...]]:
    for size in (1, 2):
        yield from combinations(range(count), size)


def _in_place_of(search: Search, group: tuple[int, ...], rest: Fit, shaped: System) -> Iterator[Fit]:
    """Refit the set with the likeliest effects in place of a group, beside the rest and its shapes.

    One of two may stand in for both: in another form, or with parameters that were dropped beside the other.
    """
    trial = replace(search, fit=rest, screened={})
    ranked = screen(trial, shaped)
    out = search.fit.names[group[0]] if len(group) == 1 else ""
    tried = {*rest.names, out}
    for gain, variant in ranked:
        if gain < settings.LEAST_GAIN or len(tried) > len(rest.names) + _FORMS:
            return
        if variant.name in tried:
            continue
        tried.add(variant.name)
        yield prune(trial, refit(search.system, [*rest.variants, variant])).judged_by(shaped)
