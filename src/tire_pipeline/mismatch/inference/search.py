"""The search: screen all effects, refit the best sets jointly, accept only what passes every gate."""

from __future__ import annotations

from collections.abc import Set
from dataclasses import replace
from itertools import combinations
from typing import Any

import numpy as np

from tire_pipeline.mismatch import settings
from tire_pipeline.mismatch.discrepancy.gram import System
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.doubts import doubts
from tire_pipeline.mismatch.inference.exchange import exchanged
from tire_pipeline.mismatch.inference.gates import (
    accepted,
    floors_of,
    least_share,
    leaving_less,
    mismatch_of,
    of_coefficients,
    open_but_loose,
    reasons,
    share_of_sweeps,
)
from tire_pipeline.mismatch.inference.left_out import groups, left_out_error, removed_unseen
from tire_pipeline.mismatch.inference.refit import Fit, objective, refit
from tire_pipeline.mismatch.inference.screening import (
    frozen_cost,
    gain_of,
    hollow,
    likeliest,
    prune,
    rank,
    screen,
    without,
)
from tire_pipeline.mismatch.inference.search_state import Search, begin, beside, log_likelihood, renoise
from tire_pipeline.mismatch.inference.shapes import with_shapes
from tire_pipeline.mismatch.model.candidates import Variant
from tire_pipeline.mismatch.model.residual import residual

__all__ = ["Search", "begin", "gain_of", "objective", "prune", "run", "with_shapes"]

_NO_BETTER = "sweeps that its fit has not seen are predicted no better with it"
_SLIGHT = "removes next to nothing of what is left on sweeps that its fit has not seen"
_OF_SOME_LOADS = "loads that its fit has not seen are predicted no better with it"


def run(search: Search) -> None:
    """Find the effects beside those that are in; the result is in ``search.fit`` and ``search.gates``."""
    search.doubted, search.likelier = {}, frozenset()
    _grow(search)
    _eliminate(search)
    if _prefer(search):
        _grow(search)
        _eliminate(search)
    barred: set[str] = set()
    for _ in range(2):
        before = set(search.fit.names)
        if not _take(search, [fit for fit in exchanged(search) if not barred & set(fit.names)]):
            break
        search.log.append(f"exchanged: {'+'.join(search.fit.names)}")
        renoise(search)
        search.fit = _again(search, search.fit)
        barred |= before - set(search.fit.names)
        _grow(search, barred)
        _eliminate(search)
    _withdraw(search)


def _grow(search: Search, barred: Set[str] = frozenset()) -> None:
    """Put in effects until none passes, none of the barred ones."""
    for _ in range(settings.MOST_EFFECTS - len(search.fit.names)):
        shaped = with_shapes(search, search.system, search.fit.changes)
        ranked = screen(search, shaped)
        search.log.append("screen: " + ", ".join(f"{v.name} {g:.0f}" for g, v in ranked[:8]))
        ranked = [(g, v) for g, v in ranked if g > 2.0 and v.name not in barred]
        if not search.fit.names:
            search.first = ranked
        if not _one_more(search, ranked, shaped):
            break
        renoise(search)
        search.fit = _again(search, search.fit)


def _one_more(search: Search, ranked: list[tuple[float, Variant]], shaped: System) -> bool:
    """Accept one more effect, or two at once.

    Sets are compared by the system with the shapes of the effects that are in: what the form of turn slip
    gets wrong must not choose between friction and a gain. What is likely, also when fitted, but removes
    next to nothing of the mismatch is set aside, so that it does not bar the way.
    """
    empty = objective(search.system, [])
    while ranked:
        fits = likeliest(search, [_judged(search, f, shaped) for f in _refined(search, ranked)])
        search.log.append(
            "refit: " + ", ".join(f"{'+'.join(f.names)} {gain_of(search, f, empty):.0f}" for f in fits[:6])
        )
        likely = [f for f in fits if gain_of(search, f, empty) > settings.LEAST_GAIN]
        if not search.fit.names:  # what a straight line promised, and the refit did not keep, begins nothing
            kept = {f.names[-1] for f in likely} | {v.name for _, v in ranked} - {f.names[-1] for f in fits}
            search.first = [(gain, v) for gain, v in search.first if v.name in kept]
        hidden = [f for f in likely if not _visible(search, f)]
        plainer = [_judged(search, f, shaped) for f in _plainer(search, hidden)]
        if _take(search, likeliest(search, [*fits, *plainer])):
            return True
        if _take(search, _pairs(search, fits, shaped)):
            return True
        if not hidden:
            return False
        names = {f.names[-1] for f in hidden}
        ranked = [(gain, v) for gain, v in ranked if v.name not in names]
    return False


def _judged(search: Search, fit: Fit, shaped: System) -> Fit:
    """Return a set with the objective by which it is compared with nothing.

    The first effects are compared with the sizes of the misfit that each set leaves, against the sizes that
    nothing leaves. Two beginnings: with the sizes that nothing leaves, and with coefficients that do not
    move, because a misfit of that size takes up what the effect does. Beside accepted effects the sizes are
    known, and what their forms get wrong counts.
    """
    if search.fit.names:
        return fit.judged_by(shaped)
    nothing, empty = search.system, objective(search.system, [])
    best, most = fit, -np.inf
    for begun in (fit, refit(search.frozen, fit.variants, steps=3)):
        at = beside(search, begun)
        found = refit(at.system, begun.variants, steps=3)
        at = beside(search, found)
        gain = log_likelihood(at, found.changes, at.inflation)
        if gain > most:
            empty_gain = -0.5 * empty / at.inflation - 0.5 * nothing.log_determinant()
            best, most = replace(found, objective=empty - 2.0 * search.inflation * (gain - empty_gain)), gain
    return best


def _plainer(search: Search, fits: list[Fit]) -> list[Fit]:
    """Refit the last effect of some sets with one parameter each.

    Several parameters and the flexible form can take up what each other leave, and nothing is gone.
    """
    found = {}
    for fit in fits:
        *others, last = fit.variants
        if not of_coefficients(last.name) or last.effect.needed:
            continue
        for name in last.effect.free(search.data, last.start):
            plain = Variant(last.name, last.effect.zeros(search.data), (name,))
            found[last.name, name] = refit(search.system, [*others, plain])
    return list(found.values())


def _again(search: Search, fit: Fit) -> Fit:
    return prune(search, refit(search.system, fit.variants, steps=3))


def _refined(search: Search, ranked: list[tuple[float, Variant]]) -> list[Fit]:
    """Refit the best forms jointly with the accepted effects; the best pairs too."""
    now = search.fit.variants
    seen: dict[str, int] = {}
    chosen: list[Any] = []
    for most in (1, 2):  # the best form of each effect first, then second forms
        for _, v in ranked:
            if seen.get(v.name, 0) < most and v not in chosen and len(chosen) < settings.KEPT:
                seen[v.name] = seen.get(v.name, 0) + 1
                chosen.append(v)
    fits = []
    for v in chosen:
        fit = refit(search.system, [*now, v], start=[*search.fit.changes, (v.name, v.start)])
        fits.append(prune(search, fit))
    return fits


def _pairs(search: Search, fits: list[Fit], shaped: System) -> list[Fit]:
    """Refit pairs of the most promising effects: two can mask each other."""
    if len(search.fit.names) + 2 > settings.MOST_EFFECTS:
        return []
    now = search.fit.variants
    best: dict[str, Fit] = {}
    for fit in fits:
        best.setdefault(fit.names[-1], fit)
    out = []
    for first, second in combinations(list(best)[:4], 2):
        forms = [Variant(name, best[name].changes[-1][1], best[name].free[-1]) for name in (first, second)]
        start = [*search.fit.changes, *(best[name].changes[-1] for name in (first, second))]
        pair = prune(search, refit(search.system, [*now, *forms], start=start))
        out.append(_judged(search, pair, shaped))
    out, empty = likeliest(search, out), objective(search.system, [])
    search.log.append(
        "pairs: " + ", ".join(f"{'+'.join(f.names)} {gain_of(search, f, empty):.0f}" for f in out[:4])
    )
    return out


def _take(search: Search, fits: list[Fit]) -> bool:
    """Accept the likeliest set that passes all gates.

    Of nearly equal ones the more usual comes first, then the likelier one with frozen coefficients.
    """
    empty = objective(search.system, [])
    fits = [f for f in fits if _visible(search, f) and gain_of(search, f, empty) > settings.LEAST_GAIN]
    if not fits:
        return False
    gains = [gain_of(search, f, empty) for f in fits]
    doubted = None
    for fit in _one_each(_in_order(search, fits, gains))[:4]:
        ok, gates = accepted(search if search.fit.names else beside(search, fit), fit)
        search.log.append(
            "gates: "
            + "; ".join(
                f"{g.name} gain {g.gain:.1f} loose {g.loose:.1f} frozen {g.frozen:.1f} p "
                f"{g.p_value:.1g} share {g.share:.3f}" + ("" if g.in_bounds else " bound")
                for g in gates
            )
        )
        search.refused.update(reasons(search, gates))
        if not ok and len(gates) == 1 and gates[0].explains_most:
            search.nearly.add(fit.names[0])
        if ok and removed_unseen(search, fit) <= 0.0:
            search.log.append("held-out sweeps are predicted no better")
            search.refused[fit.names[-1]] = _NO_BETTER
            continue
        if ok:
            search.fit, search.gates = fit, gates
            search.doubted.pop(len(fit.names), None)
            if doubted is not None and of_coefficients(fit.names[-1]):
                search.doubted[len(fit.names)] = doubted
            return True
        if doubted is None and open_but_loose(search, gates):
            doubted = fit
    if doubted is not None:
        search.doubted[len(doubted.names)] = doubted
    return False


def _one_each(fits: list[Fit]) -> list[Fit]:
    """Return the first set of each names: a second form of one effect takes no turn of another."""
    seen: set[tuple[str, ...]] = set()
    out = []
    for fit in fits:
        if tuple(fit.names) not in seen:
            seen.add(tuple(fit.names))
            out.append(fit)
    return out


def _prefer(search: Search) -> bool:
    """Take what coefficients nearly free explain as well before what they explain altogether.

    If the latter is all that was found in its place and less likely by ``TIE`` and more than its own form may
    get wrong, or if nothing was found and no candidate like it comes near: temperature without its channel
    differs little from a friction factor.
    """
    fit, other = search.fit, search.doubted.get(max(len(search.fit.names), 1))
    if other is None or fit.names != [*other.names[:-1], *fit.names[-1:]]:
        return False
    other, empty = _again(search, other), objective(search.system, [])
    if not fit.names:
        alike = [gain for name, gain in search.screened.items() if of_coefficients(name)]
        least = max(0.0, *alike) + settings.LEAST_GAIN_ALONE
    else:
        if not of_coefficients(fit.names[-1]):
            return False
        own = gain_of(search, fit.judged_by(search.system), empty)
        least = own + max(settings.TIE, settings.SHAPE_SHARE**2 * own)
    if gain_of(search, other, empty) < least:
        return False
    search.likelier = frozenset({other.names[-1]})
    ok, gates = accepted(search, other)
    if not ok:
        search.likelier = frozenset()
        return False
    search.fit, search.gates = other, gates
    search.log.append(f"likelier than what the coefficients can do: {other.names[-1]}")
    renoise(search)
    return True


def _in_order(search: Search, fits: list[Fit], gains: list[float]) -> list[Fit]:
    """Order the likely ones of ever less likely sets; put first what can leave plainly less.

    Among effects that scale the force alone: the flexible form can take up what a poorer form leaves, at a
    price that its size makes small. By what each can leave at least, not where the flexible form helps.
    """
    within = settings.USUAL_FIRST if hollow(search, fits[0], len(fits[0].names) - 1) else settings.EQUAL
    equal = sum(gain > gains[0] - within for gain in gains)
    first = sorted(fits[:equal], key=lambda f: (rank(search, f), frozen_cost(search, f)))
    later = list(zip(fits, gains, strict=True))[equal:]
    near = [f for f, gain in later if _scales(f) and gain >= settings.LESS_LIKELY * gains[0]]
    before = leaving_less(search, near, first[0]) if _scales(first[0]) else []
    leading = {id(f) for f in before}
    rest = [f for f, gain in later if gain >= 0.75 * gains[0] - settings.TIE and id(f) not in leading]
    return _steeper_first(search, [*before, *first, *rest])


def _steeper_first(search: Search, fits: list[Fit]) -> list[Fit]:
    """Order the sets that end with an effect of the slope alone by their worth with frozen coefficients.

    In 91 tuning cases of a stiffness or a compliance that told 86 apart, the likelihood 75.
    """
    others = fits[0].names[:-1]
    places = [i for i, f in enumerate(fits) if f.names[:-1] == others and catalogue()[f.names[-1]].steepens]
    if len(places) < 2:
        return fits
    out = list(fits)
    ordered = sorted((fits[i] for i in places), key=lambda f: frozen_cost(search, f))
    for place, fit in zip(places, ordered, strict=True):
        out[place] = fit
    return out


def _scales(fit: Fit) -> bool:
    """Whether the last effect of a set scales the force."""
    return catalogue()[fit.names[-1]].scales


def _visible(search: Search, fit: Fit) -> bool:
    """Whether a set removes some of the mismatch, each effect its least share, and no lag undoes another."""
    floors = floors_of(search, fit)

    def left_without(*which: int) -> float:
        return mismatch_of(residual(search.data, fit.others(*which)), floors)

    total, left = max(left_without(*range(len(fit.names))), 1e-12), left_without()
    if left >= total:
        return False
    each = [left_without(i) for i in range(len(fit.names))]
    for i, there in enumerate(each):
        if there - left >= settings.LEAST_SHARE * total * share_of_sweeps(search, fit, i):
            continue
        gain = gain_of(search, fit.judged_by(search.system), objective(search.system, fit.others(i)))
        if there - left < total * least_share(fit.names, i, gain, there / total):
            return False
    lags = [i for i, name in enumerate(fit.names) if catalogue()[name].dynamic]
    return len(lags) < 2 or max(each[i] for i in lags) < left_without(*lags)


def _eliminate(search: Search) -> None:
    """Backward: drop effects that no longer pass once the others are in."""
    while search.fit.names:
        ok, gates = accepted(search, search.fit)
        search.gates = gates
        if ok:
            return
        worst = int(np.argmin([g.gain if g.passed(settings.LEVEL) else g.gain - 1e6 for g in gates]))
        search.log.append(f"dropped {search.fit.names[worst]}")
        _drop(search, worst)
    search.gates = []


def _drop(search: Search, index: int) -> None:
    search.fit = without(search, search.fit, index, steps=5)
    renoise(search)


def _withdraw(search: Search) -> None:
    """Take back names that an unnamed form explains as well, or that other loads do not bear out."""
    while search.fit.names:
        worst_one = _of_some_loads(search)
        if worst_one is not None:
            _take_back(search, worst_one, _OF_SOME_LOADS, "left-out loads")
            continue
        gone = removed_unseen(search, search.fit)
        if gone <= 0.0:
            weakest = int(np.argmin([g.gain for g in search.gates]))
            _take_back(search, weakest, _NO_BETTER, "held-out sweeps")
            continue
        if len(search.fit.names) == 1 and gone < settings.HELD_SHARE:
            _take_back(search, 0, _SLIGHT, "slight on held-out sweeps")
            continue
        found = search.doubts = doubts(search)
        worst = max(found, key=lambda d: d.size)
        if worst.size <= 0.0:
            if worst.on_top < settings.LEAST_GAIN_MORE:
                search.unnamed = ""
            return
        search.unnamed = worst.label
        _take_back(search, worst.index, f"an unnamed form does as well: {worst.label}", worst.label)


def _take_back(search: Search, index: int, why: str, label: str) -> None:
    """Withdraw one name, and drop what no longer passes without it."""
    name = search.fit.names[index]
    search.withdrawn.append(name)
    search.refused[name] = why
    search.log.append(f"withdrawn {name}: {label}")
    _drop(search, index)
    _eliminate(search)


def _of_some_loads(search: Search) -> int | None:
    """Return an effect in the model's own inputs that makes left-out loads no better, or None."""
    group = groups(search)
    if group is None:
        return None
    left = left_out_error(search, search.fit, group)
    for i, name in enumerate(search.fit.names):
        if catalogue()[name].own_inputs and left >= left_out_error(
            search, without(search, search.fit, i), group
        ):
            return i
    return None
