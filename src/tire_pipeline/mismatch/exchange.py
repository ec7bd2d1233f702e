"""Exchange: one effect, or two, of a set for another one, where that is likelier."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

from tire_pipeline.mismatch import settings
from tire_pipeline.mismatch.candidates import Variant
from tire_pipeline.mismatch.gates import mismatch_of
from tire_pipeline.mismatch.refit import Fit, objective, refit, residual
from tire_pipeline.mismatch.screening import gain_of, prune, rank, screen
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
    empty = objective(search.system, [])
    found = gain_of(search, search.fit, empty)
    out = []
    for group in _groups(len(search.fit.names)):
        for fit in _in_place_of(search, group):
            simpler = len(group) > 1 or rank(search, fit) < rank(search, search.fit)
            least = -0.5 * settings.TIE if simpler else settings.TIE
            poorer = settings.PLAINLY_LESS * _left(search, fit) > _left(search, search.fit)
            if gain_of(search, fit, empty) > found + least and not poorer:
                out.append(fit)
    return sorted(out, key=lambda f: -gain_of(search, f, empty))


def _left(search: Search, fit: Fit) -> float:
    """Mismatch beyond the noise that a set leaves."""
    return mismatch_of(search, residual(search.data, fit.changes)) - len(search.data.outputs)


def _groups(count: int) -> Iterator[tuple[int, ...]]:
    for size in (1, 2):
        yield from combinations(range(count), size)


def _in_place_of(search: Search, group: tuple[int, ...]) -> Iterator[Fit]:
    """Refit the set with the likeliest effects in place of a group.

    One of two may stand in for both: in another form, or with parameters that were dropped beside the other.
    """
    stay = [i for i in range(len(search.fit.names)) if i not in group]
    forms = [Variant(*search.fit.changes[i], search.fit.free[i]) for i in stay]
    start = [search.fit.changes[i] for i in stay]
    rest = refit(search.system, forms, steps=3, start=start) if forms else Fit([], [])
    trial = replace(search, fit=rest, screened={})
    ranked = screen(trial, with_shapes(trial, trial.system, rest.changes) if rest.changes else None)
    out = search.fit.names[group[0]] if len(group) == 1 else ""
    tried = {*rest.names, out}
    for gain, variant in ranked:
        if gain < settings.LEAST_GAIN or len(tried) > len(rest.names) + _FORMS:
            return
        if variant.name in tried:
            continue
        tried.add(variant.name)
        now = [Variant(n, p, f) for (n, p), f in zip(rest.changes, rest.free, strict=True)]
        yield prune(
            trial, refit(search.system, [*now, variant], start=[*rest.changes, (variant.name, variant.start)])
        )
