"""Exchange: one effect, or two, of a set for another one, where that is likelier."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

from tire_pipeline.mismatch import settings
from tire_pipeline.mismatch.discrepancy.gram import System
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.base import Effect
from tire_pipeline.mismatch.inference.gates import leaving_less, left_by
from tire_pipeline.mismatch.inference.refit import Fit, objective, refit
from tire_pipeline.mismatch.inference.screening import (
    frozen_cost,
    gain_of,
    likeliest,
    prune,
    rank,
    screen,
    without,
)
from tire_pipeline.mismatch.inference.search_state import Search
from tire_pipeline.mismatch.inference.shapes import with_shapes
from tire_pipeline.mismatch.model.candidates import Variant

_FORMS = 3
"""How many other effects are tried in each place."""


def exchanged(search: Search) -> list[Fit]:
    """Return the sets with something exchanged that are better than the one found, likeliest first.

    Wear and temperature together look like a surface that changed: once both are in, adding and dropping
    one effect at a time never leads there. A set with as many effects has to be likelier by ``TIE``; one
    with fewer, or with a more usual one of two that look the same, only about as likely. None may leave
    plainly more of the mismatch. Of two effects that scale the force, one that leaves plainly less may be
    less likely; and a single one gives way to two others (friction and compliance look like a gain). Of two
    that change the slope alone frozen coefficients decide, by as much log evidence.

    Parameters
    ----------
    search : Search
        With at least one effect found; not changed.
    """
    if len(search.fit.names) == 1:
        return _divided(search)
    empty, usual = objective(search.system, []), rank(search, search.fit)
    most = left_by(search, search.fit) / settings.PLAINLY_LESS
    out = []
    for group in _groups(len(search.fit.names)):
        rest = without(search, search.fit, *group)
        shaped = with_shapes(search, search.system, rest.changes)
        found = gain_of(search, search.fit.judged_by(shaped), empty)
        own = found - gain_of(search, rest.judged_by(shaped), empty)
        near = []
        for fit in _in_place_of(search, group, rest, shaped):
            pair = _one_for_one(search, group, fit)
            if pair and all(effect.steepens for effect in pair):
                if frozen_cost(search, fit) < frozen_cost(search, search.fit) - settings.TIE:
                    out.append(fit)
                continue
            gain = gain_of(search, fit, empty)
            simpler = len(group) > 1 or rank(search, fit) < usual
            less = _less(search, group, fit) if simpler else -settings.TIE
            scaling = bool(pair) and all(effect.scales for effect in pair)
            if gain > found - less and left_by(search, fit) <= most:
                if not (scaling and leaving_less(search, [search.fit], fit)):
                    out.append(fit)
            elif scaling and gain > found - (1.0 - settings.LESS_LIKELY) * own:
                near.append(fit)
        out += leaving_less(search, near, search.fit)
    return likeliest(search, out)


def _divided(search: Search) -> list[Fit]:
    """Return the sets of two effects of the tire that scale the force, for the single one found.

    Those that are likelier and leave plainly less. Of the tire, because a gain of the channels and friction
    are a stiffness with more parameters.
    """
    if not catalogue()[search.fit.names[0]].scales:
        return []
    trial = replace(search, fit=Fit([], []), screened={})
    best: dict[str, Variant] = {}
    for _, variant in screen(trial):
        effect = catalogue()[variant.name]
        if effect.scales and effect.kind == "physics" and variant.name not in search.fit.names:
            best.setdefault(variant.name, variant)
    empty = objective(search.system, [])
    least = gain_of(search, search.fit.judged_by(search.system), empty) + settings.TIE
    pairs = combinations(list(best.values())[: _FORMS + 1], 2)
    fits = [prune(trial, refit(search.system, list(pair))) for pair in pairs]
    likelier = [fit for fit in fits if gain_of(search, fit, empty) > least]
    return likeliest(search, leaving_less(search, likelier, search.fit))


def _one_for_one(search: Search, group: tuple[int, ...], fit: Fit) -> tuple[Effect, ...]:
    """Return the effect that goes and the one that comes, or nothing if two go."""
    if len(group) > 1:
        return ()
    return catalogue()[search.fit.names[group[0]]], catalogue()[fit.names[-1]]


def _less(search: Search, group: tuple[int, ...], fit: Fit) -> float:
    """Log evidence by which a simpler or more usual set may be less likely.

    Of two lags as much as their forms may get wrong: a short filter and a delay are the same but for it.
    """
    least = settings.USUAL_FIRST
    if len(group) > 1 or not catalogue()[fit.names[-1]].dynamic:
        return least
    return max(least, settings.SHAPE_SHARE**2 * search.gates[group[0]].gain)


def _groups(count: int) -> Iterator[tuple[int, ...]]:
    for size in (1, 2):
        yield from combinations(range(count), size)


def _in_place_of(search: Search, group: tuple[int, ...], rest: Fit, shaped: System) -> Iterator[Fit]:
    """Refit the set with the likeliest effects in place of a group, beside the rest and its shapes.

    One of the group may stand in for it: in another form, or with parameters that were dropped beside the
    other.
    """
    trial = replace(search, fit=rest, screened={})
    ranked = screen(trial, shaped)
    tried = set(rest.names)
    for gain, variant in ranked:
        if gain < settings.LEAST_GAIN or len(tried) > len(rest.names) + _FORMS:
            return
        if variant.name in tried:
            continue
        tried.add(variant.name)
        yield prune(trial, refit(search.system, [*rest.variants, variant])).judged_by(shaped)
