"""How large an effect would have to be to be seen in a recording, and what size is ruled out.

The engine's own linearisation, at what it has found: the column of a parameter is what the recording
would show of it, and its information is what is left of that column beside the noise, the misfit of the
formula, the coefficients and the effects that are named. A size is seen if, in 95% of repetitions, it is
worth the evidence that the gates ask for, and removes the share of the mismatch that they ask for.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.special import ndtri

from tire_pipeline.mismatch import settings
from tire_pipeline.mismatch.discrepancy.gram import Sums, System
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.amounts import amount
from tire_pipeline.mismatch.effects.base import Parameter
from tire_pipeline.mismatch.inference.gates import (
    asked_for,
    floors_of,
    mismatch_of,
    of_coefficients,
    part_of_samples,
)
from tire_pipeline.mismatch.inference.refit import finish, inverse
from tire_pipeline.mismatch.inference.search_state import Search
from tire_pipeline.mismatch.model.candidates import Variant, screening_columns
from tire_pipeline.mismatch.model.forces import Change, simulate
from tire_pipeline.mismatch.model.residual import residual
from tire_pipeline.mismatch.proof.intervals import roomy, standard_errors
from tire_pipeline.mismatch.proof.measured import Visible

Array = np.ndarray
_SEEN = float(ndtri(0.95))
_RULED_OUT = float(ndtri(0.975))
_ROUNDS = 4
_CLOSE = 0.05
_MOST_FORMS = 3
_SMALL, _SIZES, _HALVINGS = 1e-4, 97, 40
FALSE = 0.02
"""Level of the likelihood-ratio test over all of the catalogue: in so many recordings in which nothing is
missing something may be named (issue 24)."""


@dataclass(frozen=True)
class Sight:
    """What a recording shows of one parameter of an effect that is not named.

    Parameters
    ----------
    variant : Variant
        The effect's form.
    parameter : Parameter
    seen : float
        Smallest size that is named in 95% of repetitions; infinite if none within the bounds is.
    told : float
        The size that a likelihood-ratio test sees in 95% of the same repetitions which knows the form and the
        covariance of noise, misfit and coefficients, at the level ``FALSE`` over all of the catalogue; none
        that no tire has.
    value, error : float
        Estimate beside what is named, and its standard error with the room that an interval asks for.
    """

    variant: Variant
    parameter: Parameter
    seen: float
    told: float
    value: float
    error: float

    @property
    def form(self) -> dict[str, float]:
        """What says which form of the effect was looked at."""
        form = {p.name for p in self.variant.effect.parameters if p.form}
        return {k: float(v) for k, v in self.variant.start.items() if k in form and v}

    @property
    def ruled_out(self) -> float:
        """Size beyond which the 95% interval does not reach; infinite beyond the bounds."""
        value = max(self.value, 0.0) if one_sided(self.parameter) else abs(self.value)
        size = value + _RULED_OUT * self.error
        return size if size < largest(self.parameter) else np.inf

    def values(self, data: object, size: float) -> dict[str, float]:
        """Return the effect's parameters where this one alone is off by some size."""
        zero = self.variant.effect.zeros(data)
        return {**zero, **self.form, self.parameter.name: zero[self.parameter.name] + size}


def one_sided(parameter: Parameter) -> bool:
    """Whether a parameter is never smaller than where its effect is absent."""
    return parameter.low == parameter.zero


def largest(parameter: Parameter) -> float:
    """Return the largest size that is possible in both directions."""
    return min(abs(b - parameter.zero) for b in (parameter.low, parameter.high) if b != parameter.zero)


def sights(search: Search) -> Iterator[Sight]:
    """Yield what a recording shows of each parameter of each effect that is not named.

    Of several forms of one effect (references of a temperature, moments of a change) the one in the middle of
    three. Without parameters that only refine others, that can't stand alone, or that say which form it is.

    Parameters
    ----------
    search : Search
        At its end.
    """
    scene = _Scene(search)
    for name in dict.fromkeys(v.name for v in search.variants):
        if name in search.fit.names:
            continue
        effect = catalogue()[name]
        for p in effect.parameters:
            alone = not effect.needed or p.name in effect.needed
            if p.form or p.further or p.ratio or not alone:
                continue
            forms = [v for v in search.variants if v.name == name and p.name in v.free]
            picks = np.unique(np.linspace(0, len(forms) - 1, _MOST_FORMS + 2).astype(int)[1:-1])
            seen = [s for s in (scene.sight(forms[i], p) for i in picks if forms) if s is not None]
            if seen:
                yield sorted(seen, key=lambda s: s.seen)[(len(seen) - 1) // 2]


class _Scene:
    """One recording at the end of its search."""

    def __init__(self, search: Search) -> None:
        self.search, self.data, self.changes = search, search.data, list(search.fit.changes)
        self.rest = residual(search.data, self.changes)
        fit = finish(search.system, self.changes, search.fit.free, search.fit.objective)
        self.own = fit.columns if fit.labels else None
        self.floors = floors_of(search, search.fit)
        self.total = mismatch_of(residual(search.data, []), self.floors)
        self.count = len({v.name for v in search.variants})
        self.roomy = roomy(search)
        self.alike: list[dict[str, Array]] | None = None

    def sight(self, variant: Variant, parameter: Parameter) -> Sight | None:
        """Return what shows of one parameter, or None if nothing does.

        The column is that of a finite size, the size that is seen: some effects are far from linear.
        """
        size, most = parameter.step, largest(parameter)
        out = Sight(variant, parameter, np.inf, np.inf, 0.0, np.inf)
        before = self._simulated(out, 0.0)
        for _ in range(_ROUNDS):
            column = self._column(out, size, before)
            while not any(np.any(c) for c in column.values()) and size < most:
                size = min(4.0 * size, most)  # a lag of less than a sample does nothing
                column = self._column(out, size, before)
            sums = self._sums(column)
            info, score = self._profiled(self.search.system, sums)
            power = sum(float(np.sum((c / self.search.noise[o].sigma) ** 2)) for o, c in column.items())
            if not info > 1e-10 * power:
                return None
            error = self._error(info)
            spread = max(error, self._error(self._profiled(self.roomy, sums)[0]))
            loose = self._error(self._profiled(self.search.loose, sums)[0])
            seen = self._possible(out, self._seen(variant.name, column, (error, spread, loose)))
            told = self._possible(out, self._told(error, spread))
            out = Sight(variant, parameter, seen, told, score / info, spread)
            if abs(seen - size) < _CLOSE * size or (seen > most and size == most):
                break
            size = min(seen, most)
        return out

    def _column(self, sight: Sight, size: float, before: dict[str, Array]) -> dict[str, Array]:
        there = self._simulated(sight, size)
        return {o: (there[o] - before[o]) / size for o in self.data.outputs}

    def _simulated(self, sight: Sight, size: float) -> dict[str, Array]:
        changes: list[Change] = [*self.changes, (sight.variant.name, sight.values(self.data, size))]
        return simulate(self.data, changes)

    def _sums(self, column: dict[str, Array]) -> Sums:
        """Return the sums of a column and the named effects: the same whatever room nuisance has."""
        one = {o: c[:, None] for o, c in column.items()}
        joined = one if self.own is None else {o: np.hstack([self.own[o], one[o]]) for o in one}
        return self.search.system.sums(self.rest, joined)

    def _profiled(self, system: System, sums: Sums) -> tuple[float, float]:
        """Return information and score of a column beside nuisance and the named effects."""
        info, score, _ = system.reduce(sums)
        head = np.linalg.lstsq(info[:-1, :-1], np.column_stack([info[:-1, -1], score[:-1]]), rcond=1e-12)[0]
        left = np.array([info[-1, -1], score[-1]]) - info[-1, :-1] @ head
        return float(left[0]), float(left[1])

    def _error(self, info: float) -> float:
        return float(np.sqrt(self.search.inflation / max(info, 1e-300)))

    def _told(self, error: float, spread: float) -> float:
        """Return the size that a test sees which knows form and noise."""
        return _SEEN * spread - float(ndtri(0.5 * FALSE / max(self.count, 1))) * error

    def _seen(self, name: str, column: dict[str, Array], errors: tuple[float, float, float]) -> float:
        """Return the size that passes the gates of evidence and of share.

        Evidence goes by the first of three errors, the engine's own, or by the third, with coefficients
        nearly free; but repetitions differ by the second, the interval's.
        """
        error, spread, _ = errors
        power = sum(float(np.mean(c**2)) / self.floors[o] ** 2 for o, c in column.items())
        cross = sum(float(np.mean(self.rest[o] * c)) / self.floors[o] ** 2 for o, c in column.items())
        price, aside, part = self.search.price, abs(cross) / power, part_of_samples(self.search, column)
        size, by_loose = 0.0, 0.0
        for _ in range(2):  # what is asked for depends on the share
            share = power * size**2 / (self.total + power * size**2)
            log_evidence, loose, least = asked_for(self.search, name, share)
            least *= part
            size = _sure_at(log_evidence + price, error, spread)
            if not by_loose and not of_coefficients(name):
                by_loose = self._by_loose(column, loose, errors, size)
            size = max(size, by_loose)
            by_share = aside + np.sqrt(aside**2 + least / (1.0 - least) * self.total / power)
            if not self.changes:  # alone, and sure, it need not be a share of noise and misfit
                sure = _sure_at(settings.REMAINDER_LOG_EVIDENCE + price, error, spread)
                by_share = min(by_share, max(sure, 2.0 * aside))
            size = max(size, by_share)
        return float(size)

    def _by_loose(
        self, column: dict[str, Array], log_evidence: float, errors: tuple[float, float, float], enough: float
    ) -> float:
        """Return the size that coefficients nearly free do not explain, if more than a size is needed.

        Or, where nothing is named, the size at which it is likelier by ``LEAST_GAIN_ALONE`` than every effect
        that coefficients explain.
        """
        (error, spread, loose), price = errors, self.search.price
        size = _sure_at(log_evidence + price, loose, max(loose, spread))
        if self.changes or size <= enough:
            return size
        own = 1.0 - self._alike(column)
        gain = max(settings.LEAST_GAIN_ALONE + price, settings.LEAST_GAIN_ALONE / max(own, 1e-6))
        return min(size, _sure_at(gain, error, spread))

    def _alike(self, column: dict[str, Array]) -> float:
        """Return the largest part of a column's information that one effect of the coefficients takes up."""
        if self.alike is None:
            forms = [v for v in self.search.variants if of_coefficients(v.name)]
            self.alike = [screening_columns(self.data, self.changes, v) for v in forms]
        system, parts = self.search.system, [0.0]
        for form in self.alike:
            joined = {o: np.column_stack([form[o], c]) for o, c in column.items()}
            info, _, _ = system.reduce(system.sums(self.rest, joined))
            own, cross = inverse(info[:-1, :-1]), info[:-1, -1]
            parts.append(float(cross @ own @ cross / max(info[-1, -1], 1e-300)))
        return min(max(parts), 1.0)

    def _possible(self, sight: Sight, size: float) -> float:
        """Return the smallest size from this one on that a tire or a rig can have, or infinity."""
        size = max(size, self._least(sight))
        possible = size <= largest(sight.parameter) and not self._outside(sight, size)
        return size if possible else np.inf

    def _least(self, sight: Sight) -> float:
        """Return the smallest size that a tire or a rig can have, whatever the recording shows."""
        sizes = np.geomspace(_SMALL, 1.0, _SIZES) * largest(sight.parameter)
        k = next((k for k, size in enumerate(sizes) if not self._outside(sight, size)), None)
        if not k:
            return 0.0 if k == 0 else np.inf
        low, high = float(sizes[k - 1]), float(sizes[k])
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self._outside(sight, middle) else (low, middle)
        return high

    def _outside(self, sight: Sight, size: float) -> bool:
        return sight.variant.effect.outside(self.data, sight.values(self.data, size))


def _sure_at(log_evidence: float, error: float, spread: float) -> float:
    """Return the size that is worth some log evidence in 95% of repetitions, which differ by ``spread``."""
    return float(np.sqrt(2.0 * log_evidence)) * error + _SEEN * spread


def visible(search: Search, *, unexplained: bool) -> list[Visible]:
    """Return what a recording can say of each effect of the catalogue.

    Parameters
    ----------
    search : Search
        At its end.
    unexplained : bool
        Whether there is an unexplained residual: then nothing is ruled out.
    """
    named = [_named(name, dict(values), search, i) for i, (name, values) in enumerate(search.fit.changes)]
    found = list(sights(search))
    said = {s.variant.name for s in found}
    out = [row for rows in named for row in rows] + [_row(s, unexplained=unexplained) for s in found]
    for name, effect in catalogue().items():
        if name in said or name in search.fit.names:
            continue
        if not effect.parameters:
            text = "is looked for in the channels themselves, whatever its size"
        else:
            text = f"{search.absent.get(name, 'this recording does not show it')}, nothing can be said"
        out.append(Visible(name, "", "", np.nan, np.nan, f"{effect.title}: {text}"))
    order = list(catalogue())
    return sorted(out, key=lambda row: order.index(row.name))


def _named(name: str, values: dict[str, float], search: Search, index: int) -> list[Visible]:
    """Rows of an effect that is named."""
    effect, rows = catalogue()[name], []
    for (i, parameter), error in zip(search.fit.labels, standard_errors(search, search.fit), strict=True):
        if i != index:
            continue
        unit = effect.parameter(parameter).unit
        value = f"{amount(values[parameter], unit)} ± {amount(_RULED_OUT * error, unit)}"
        text = f"{effect.title}: named, {parameter} {value}"
        rows.append(Visible(name, parameter, unit, np.nan, np.nan, text))
    return rows


def _row(sight: Sight, *, unexplained: bool) -> Visible:
    """One row of an effect that is not named."""
    effect, parameter, unit = sight.variant.effect, sight.parameter.name, sight.parameter.unit
    seen, ruled_out = sight.seen, np.inf if unexplained else sight.ruled_out
    parts = []
    if np.isfinite(ruled_out):
        parts.append(f"changes above {amount(ruled_out, unit)} are ruled out")
    elif unexplained:
        parts.append("nothing is ruled out while there is an unexplained residual")
    else:
        parts.append("no size that is possible is ruled out")
    if np.isfinite(seen):
        parts.append(f"from {amount(seen, unit)} on it would be named")
    else:
        parts.append("no size that is possible would be named")
    text = f"{effect.title} ({parameter}): {'; '.join(parts)}"
    known = [x if np.isfinite(x) else np.nan for x in (seen, ruled_out)]
    return Visible(effect.name, parameter, unit, known[0], known[1], text, sight.form)
