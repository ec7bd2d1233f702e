"""A chosen equation and what its search says beside it: drivers with evidence, alternatives, intervals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tire_pipeline.mismatch.model.channels import CHANCE, OF_INTERVAL, span
from tire_pipeline.mismatch.unnamed_physics.choose import ChosenModels
from tire_pipeline.mismatch.unnamed_physics.evidence import Model, driver_posterior, drivers_of, tolerance
from tire_pipeline.mismatch.unnamed_physics.found import Alternative, CoefficientInterval
from tire_pipeline.mismatch.unnamed_physics.language.grammar import number
from tire_pipeline.mismatch.unnamed_physics.language.symbols import CHANNEL, held_within
from tire_pipeline.mismatch.unnamed_physics.library import WAY, Factor, Term, now_factors
from tire_pipeline.mismatch.unnamed_physics.products import Columns
from tire_pipeline.mismatch.unnamed_physics.prove import Proven, fitted

LISTED = 3
"""Sets of drivers, and alternatives, that a report lists."""


@dataclass(frozen=True)
class ChosenEquation:
    """What was chosen for some forces, and how it does on sweeps that it has not seen."""

    columns: Columns
    choice: ChosenModels
    model: Model | None
    proof: Proven

    @property
    def terms(self) -> list[Term]:
        """Terms of the equation."""
        return [] if self.model is None else [self.choice.terms[i] for i in self.model.terms]

    @property
    def drivers(self) -> frozenset[str]:
        """What it depends on."""
        return frozenset[str]() if self.model is None else drivers_of(self.model, self.choice.terms)

    @property
    def coefficients(self) -> list[tuple[float, float]]:
        """Values and standard errors."""
        if self.model is None:
            return []
        values, errors = fitted(self.choice, self.model.terms)
        return [(float(v), float(e)) for v, e in zip(values, errors, strict=True)]

    @cached_property
    def posterior(self) -> dict[frozenset[str], float]:
        """Posterior of the sets of drivers, the likeliest first.

        A factor that is one number on the recording is no driver: ``abs(g)`` where camber is +c and -c.
        """
        drivers = [
            t.without(f for f in t.factors if is_constant(self.columns, f)).drivers for t in self.choice.terms
        ]
        return driver_posterior(self.choice.models, drivers)

    @property
    def outputs(self) -> tuple[str, ...]:
        """Forces that it acts on; without a proof, those that its search saw."""
        return self.proof.outputs if self.proof.holds else self.columns.problem.outputs


def is_constant(columns: Columns, factor: Factor) -> bool:
    """Whether an even factor of one channel does not move on the recording, although the channel does."""
    symbol = factor.text.removesuffix("^2").removeprefix("abs(").removesuffix(")")
    if symbol == factor.text or symbol not in CHANNEL:
        return False
    x = columns.part(symbol)
    if x is None:
        return False
    low, high = span(np.abs(x))
    return high - low <= held_within(symbol, x)


def drivers_with_evidence(parts: Sequence[ChosenEquation]) -> dict[str, float]:
    """Return the posterior probability of each driver: the largest of the searches, each by its own sets."""
    every = frozenset[str]().union(*(key for part in parts for key in part.posterior))
    found = {d: _probability(parts, frozenset({d})) for d in sorted(every)}
    return dict(sorted(found.items(), key=lambda item: -item[1]))


def ruled_out(parts: Sequence[ChosenEquation]) -> dict[str, float]:
    """Return recorded channels that the residual does not depend on, with their probability, least first.

    Channels that vary and that the library has; not camber of +c and -c, whose size nothing was compared
    with. A memory of a channel counts as the channel, and the way rolled as time.
    """
    columns, moves = parts[0].columns, parts[0].columns.problem.moves
    factors = now_factors(moves)
    known = frozenset[str]().union(*(f.drivers for f in factors)) | ({"time"} & moves)
    known = known.difference(*(f.drivers for f in factors if is_constant(columns, f)))
    found = {
        c: _probability(parts, frozenset({c, f"memory of {c}", *({"path"} if c == "time" else ())}))
        for c in sorted(known)
    }
    return dict(sorted(((c, p) for c, p in found.items() if p < CHANCE), key=lambda item: item[1]))


def _probability(parts: Sequence[ChosenEquation], drivers: frozenset[str]) -> float:
    """The probability that one of some drivers is in a set: the largest of the searches."""
    return max(min(sum((p for k, p in part.posterior.items() if k & drivers), 0.0), 1.0) for part in parts)


def intervals(part: ChosenEquation) -> dict[str, list[CoefficientInterval]]:
    """Return the coefficients of an equation's terms with 95% intervals, for each output."""
    out: dict[str, list[CoefficientInterval]] = {}
    for o in part.proof.outputs:
        for term, (value, error) in zip(part.terms, part.coefficients, strict=True):
            if term.text(o):
                reach = OF_INTERVAL * error
                out.setdefault(o, []).append(CoefficientInterval(value, value - reach, value + reach))
    return out


def equations(choice: ChosenModels, model: Model, outputs: tuple[str, ...]) -> dict[str, str]:
    """Return the text of a set of terms with its coefficients, for each output."""
    values, _ = fitted(choice, model.terms)
    out = {}
    for o in outputs:
        parts = [
            f"{number(float(value))}*{choice.terms[i].text(o)}"
            for i, value in zip(model.terms, values, strict=True)
            if choice.terms[i].text(o)
        ]
        if parts:
            out[o] = " + ".join(parts)
    return out


def alternatives(part: ChosenEquation) -> list[Alternative]:
    """Other equations within what forms get wrong, for the same forces, the likeliest first.

    None repeats the equation, or one before it, with other numbers or times a constant.
    """
    best, choice = part.model, part.choice
    if best is None:
        return []
    near = tolerance(choice.models)
    seen = {_form(part, best)}
    out = []
    for m in choice.models:
        if m.score < best.score - near or len(m.terms) > len(best.terms):
            continue
        form = _form(part, m)
        texts = equations(choice, m, part.outputs)
        if form in seen or not texts:
            continue
        seen.add(form)
        drivers = tuple(sorted(drivers_of(m, choice.terms)))
        out.append(Alternative(texts, drivers, m.evidence))
        if len(out) == LISTED:
            break
    return out


def _form(part: ChosenEquation, model: Model) -> frozenset[tuple[str, str, tuple[str, ...]]]:
    """What an equation is but for its numbers: output, base and the factors that move, of each term."""
    found = set()
    for i in model.terms:
        term = part.choice.terms[i]
        moving = tuple(sorted(f.text for f in term.factors if not is_constant(part.columns, f)))
        found |= {(o, base, moving) for o, base in WAY[term.way].base.items() if o in part.outputs}
    return frozenset(found)
