"""An equation that was found: its text, range of validity, and what it adds to a force."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np

from tire_pipeline.channels import ALIGNING_MOMENT, PLANE_FORCES
from tire_pipeline.mismatch.unnamed_physics.language.grammar import (
    LONGEST,
    EquationError,
    SymbolTable,
    evaluate,
    parse,
)
from tire_pipeline.mismatch.unnamed_physics.language.symbols import (
    CHANNEL,
    MEANING,
    NominalValues,
)

Array = np.ndarray
FORMAT = "unnamed physics 4"
READABLE_FORMATS = ("unnamed physics 1", "unnamed physics 2", "unnamed physics 3", FORMAT)
"""Formats that are read: in the first one each range is of one symbol, and the second one has no moments. The
first three summed up the way otherwise, so no equation in it is read from them."""
FADE = 0.25
"""Outside of its range an equation goes to nothing over this part of the range's width; in time at once,
since what turns with the way has another phase in another recording."""


@dataclass(frozen=True)
class CoefficientInterval:
    """A coefficient of an equation and its 95% interval, without a unit: terms are in N, those of mz in N m.

    Parameters
    ----------
    value, low, high : float
    """

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class UnnamedPhysics:
    """Unnamed physics, as an equation.

    Parameters
    ----------
    equations : dict of str to str
        Output -> what it adds, N (``mz``: N m), in the grammar of :mod:`.language.grammar`.
    depends_on : tuple of str
    acts_on : str
    ranges : dict of str to (low, high)
        Symbol, or an expression of symbols -> the range in which the equation holds; it fades outside.
    nominal : NominalValues
    coefficients : dict of str to list of CoefficientInterval
        Output -> those of its terms in their order. The numbers inside of a term count as known.
    """

    equations: Mapping[str, str]
    depends_on: tuple[str, ...]
    acts_on: str
    ranges: Mapping[str, tuple[float, float]]
    nominal: NominalValues
    coefficients: Mapping[str, Sequence[CoefficientInterval]] = field(default_factory=dict)

    @property
    def title(self) -> str:
        """``unnamed: depends on ...``."""
        return f"unnamed: depends on {self.drivers_in_words}"

    @property
    def drivers_in_words(self) -> str:
        """What it depends on; where that is no channel, the forces."""
        itself = "nothing but the forces" if self.of_moment else "the force itself"
        return ", ".join(self.depends_on) or itself

    @property
    def channels(self) -> tuple[str, ...]:
        """Channels without which it cannot be added."""
        used = self._used
        needed = {CHANNEL[s] for s in used | self._of_ranges if s in CHANNEL}
        needed |= {"time", "speed"} & ({"time", "speed"} if "way" in used or self._by_way else set())
        return tuple(sorted(needed | ({"time"} if self._remembers else set())))

    @property
    def of_moment(self) -> bool:
        """Whether it needs or changes the model's aligning moment."""
        return ALIGNING_MOMENT in self.equations

    @property
    def _used(self) -> frozenset[str]:
        return frozenset[str]().union(*(parse(text).symbols for text in self.equations.values()))

    @property
    def _of_ranges(self) -> frozenset[str]:
        return frozenset[str]().union(*(parse(text).symbols for text in self.ranges))

    @property
    def _by_way(self) -> bool:
        return any("lagway(" in text for text in self.equations.values())

    @property
    def _remembers(self) -> bool:
        return any(name in text for text in self.equations.values() for name in ("lag(", "play(", "highest("))

    @property
    def of_one_recording(self) -> bool:
        """Whether it goes with the clock, or the way rolled, of the recording that was explained."""
        return "t" in self.ranges

    def weight(self, table: SymbolTable, known: Array | None = None) -> Array:
        """Return how much of the equation holds at each sample, 0 to 1, shape (n,).

        Parameters
        ----------
        table : SymbolTable
        known : ndarray of bool, shape (n,), optional
            Where the way since the start of the recording that was explained is known. Times do not matter
            there to what turns with the way alone.
        """
        out = np.ones(table.size)
        for symbol, (low, high) in self.ranges.items():
            x, width = evaluate(parse(symbol), table), max(_fade(symbol) * (high - low), 1e-12)
            outside = np.maximum(np.maximum(low - x, x - high), 0.0) / width
            if symbol == "t" and known is not None and "t" not in self._used:
                outside = np.where(known, 0.0, outside)
            out = out * np.maximum(1.0 - outside, 0.0)
        return out

    def unweighted(self, table: SymbolTable) -> dict[str, Array]:
        """Return what it would add to each output if it held everywhere, N (``mz``: N m)."""
        return {o: evaluate(parse(text), table) for o, text in self.equations.items()}

    def change(self, table: SymbolTable) -> dict[str, Array]:
        """Return what it adds to each output, N (``mz``: N m)."""
        weight = self.weight(table)
        return {o: added * weight for o, added in self.unweighted(table).items()}

    def joined(self, other: UnnamedPhysics) -> UnnamedPhysics:
        """Return these equations and those of other outputs; they hold where both do."""
        return replace(
            self,
            equations={**self.equations, **other.equations},
            depends_on=tuple(sorted({*self.depends_on, *other.depends_on})),
            acts_on=f"{self.acts_on}, {other.acts_on}",
            ranges={**self.ranges, **other.ranges},
            coefficients={**self.coefficients, **other.coefficients},
        )

    def to_sidecar(self) -> dict[str, Any]:
        """Return what a reader needs, as JSON can hold it."""
        used = self._used
        return {
            "format": FORMAT,
            "title": self.title,
            "equation": dict(self.equations),
            "unit": "N, or N m for mz, added to the force or moment of the same name",
            "symbols": {s: MEANING[s] for s in MEANING if s in used | self._of_ranges},
            "nominal": asdict(self.nominal),
            "coefficients": {o: [asdict(c) for c in each] for o, each in self.coefficients.items()},
            "range": {s: [float(low), float(high)] for s, (low, high) in self.ranges.items()},
            "outside": "goes to nothing in a straight line over this part of the range's width",
            "fade": {s: _fade(s) for s in self.ranges},
            "depends_on": list(self.depends_on),
            "acts_on": self.acts_on,
            "of_one_recording": self.of_one_recording,
        }


def _fade(symbol: str) -> float:
    return 0.0 if symbol == "t" else FADE


def from_sidecar(content: object) -> UnnamedPhysics:
    """Read an equation from a sidecar; everything in it is checked first.

    Raises
    ------
    EquationError
        It is not of the format; nothing in it is run.
    """
    try:
        if not isinstance(content, Mapping):
            raise ValueError("it is not a mapping")
        if content.get("format") not in READABLE_FORMATS:
            raise ValueError(f"its format is none of {', '.join(READABLE_FORMATS)}")
        equations = {str(o): str(text) for o, text in content["equation"].items()}
        if not equations or set(equations) - set(PLANE_FORCES):
            raise ValueError(f"its equations are of others than {', '.join(PLANE_FORCES)}")
        for text in equations.values():
            used = parse(text).symbols
            if used - set(MEANING):
                raise ValueError(f"it uses {', '.join(sorted(used - set(MEANING)))}")
            if "way" in used and content["format"] != FORMAT:
                raise ValueError("its way rolled is that of an earlier format")
        ranges = {str(s): (float(r[0]), float(r[1])) for s, r in content["range"].items()}
        if any(
            parse(s).symbols - set(MEANING) or not (np.isfinite([a, b]).all() and a <= b)
            for s, (a, b) in ranges.items()
        ):
            raise ValueError("its ranges are not ranges of known symbols")
        if content["fade"] != {s: _fade(s) for s in ranges}:
            raise ValueError("it fades differently from this version")
        nominal = NominalValues(**{k: float(v) for k, v in content["nominal"].items()})
        if not all(np.isfinite(v) for v in asdict(nominal).values()) or min(nominal.F0, nominal.V0) <= 0.0:
            raise ValueError("its nominal values are not numbers above zero")
        coefficients = _coefficients(content.get("coefficients", {}), equations)
        depends_on, acts_on = tuple(map(str, content["depends_on"])), str(content["acts_on"])
        if len("".join([*depends_on, acts_on])) > LONGEST:
            raise ValueError(f"its words are over {LONGEST} characters long")
        return UnnamedPhysics(equations, depends_on, acts_on, ranges, nominal, coefficients)
    except EquationError:
        raise
    except (ValueError, TypeError, KeyError, IndexError, AttributeError, RecursionError) as error:
        raise EquationError(
            f"the sidecar's unnamed physics is refused: {error}",
            where="sidecar, unnamed",
            todo="write the file again with this version, or take that entry out",
        ) from error


def _coefficients(
    content: Mapping[str, Any], equations: Mapping[str, str]
) -> dict[str, list[CoefficientInterval]]:
    """Read the intervals of the coefficients; files of earlier versions have none."""
    found = {
        str(o): [CoefficientInterval(**{k: float(v) for k, v in c.items()}) for c in each]
        for o, each in content.items()
    }
    every = [c for each in found.values() for c in each]
    if set(found) - set(equations) or len(every) > LONGEST:
        raise ValueError("its coefficients are not those of its equations")
    if not all(np.isfinite([c.low, c.high]).all() and c.low <= c.value <= c.high for c in every):
        raise ValueError("an interval of its coefficients is none")
    return found


@dataclass(frozen=True)
class Alternative:
    """Another equation that is as good, within what forms get wrong."""

    equations: Mapping[str, str]
    depends_on: tuple[str, ...]
    evidence: float


@dataclass(frozen=True)
class Idea:
    """Physics that the drivers and the mechanism resemble: to be tested, not found."""

    name: str
    why: str
    experiment: str
    source: str


@dataclass(frozen=True)
class UnnamedReport:
    """What was found about the unnamed residual.

    Parameters
    ----------
    physics : UnnamedPhysics or None
        None if no equation made unseen sweeps better.
    why_not : str
        The reason if there is none.
    drivers : dict of str to float
        Driver -> posterior probability that the unexplained part depends on it. Where forces have
        equations of their own, the larger probability of their searches.
    independent_of : dict of str to float
        Recorded channel that varies and that the library has -> posterior probability, below 0.05, that a
        force with an equation depends on it or on what it was. Empty without a proved equation.
    sets : list of (drivers, probability)
        Of the first equation's search.
    where : str
        ``tire`` or ``rig``, and by what.
    coefficients : list of (value, standard error)
        Of the equation's terms, in their order.
    evidence : float
        Log evidence over no equation.
    alternatives : list of Alternative
        For the forces that the equation beside them was found for.
    unseen : dict of str to (before, after, ceiling)
        Output -> RMS error on sweeps that neither choice nor fit has seen, N (``mz``: N m): without it, with
        it, and with a Gaussian process in the same drivers.
    better, sweeps : int
        Sweeps that it makes better, of all.
    p_value : float
        Test over sweeps, of the force that is least sure.
    ideas : list of Idea
    instead_of : tuple of str
        Effects whose names it replaces: it leaves less on unseen sweeps than they do.
    later : float
        Part of an equation in the way rolled that is added after the recording, as far as earlier sweeps
        predicted later ones.
    looked_for : bool
        Whether an equation was looked for.
    curve : dict of list
        ``x`` (driver or term), ``left`` and ``fitted`` by bins, for the figure.
    """

    physics: UnnamedPhysics | None
    why_not: str = ""
    drivers: dict[str, float] = field(default_factory=dict)
    independent_of: dict[str, float] = field(default_factory=dict)
    sets: list[tuple[tuple[str, ...], float]] = field(default_factory=list)
    where: str = ""
    coefficients: list[tuple[float, float]] = field(default_factory=list)
    evidence: float = 0.0
    alternatives: list[Alternative] = field(default_factory=list)
    unseen: dict[str, tuple[float, float, float]] = field(default_factory=dict)
    better: int = 0
    sweeps: int = 0
    p_value: float = 1.0
    ideas: list[Idea] = field(default_factory=list)
    instead_of: tuple[str, ...] = ()
    later: float = 1.0
    looked_for: bool = True
    curve: dict[str, Any] = field(default_factory=dict)

    def refused(self, why: str) -> UnnamedReport:
        """Return the same without its equation, and without what rests on that."""
        return replace(self, physics=None, why_not=why, independent_of={})

    def joined(self, other: UnnamedReport) -> UnnamedReport:
        """Return this report of some outputs with another one of others, if each has an equation.

        The one that has an equation, if only one has; this one, if none has.
        """
        if self.physics is None or other.physics is None:
            return self if other.physics is None else other
        names = (*self.drivers, *other.drivers)
        every = {d: max(each.drivers.get(d, 0.0) for each in (self, other)) for d in names}
        neither = [c for c in self.independent_of if c in other.independent_of]
        return replace(
            self,
            physics=self.physics.joined(other.physics),
            drivers=dict(sorted(every.items(), key=lambda item: -item[1])),
            independent_of={c: max(self.independent_of[c], other.independent_of[c]) for c in neither},
            where="; ".join(dict.fromkeys((self.where, other.where))),
            coefficients=[*self.coefficients, *other.coefficients],
            evidence=self.evidence + other.evidence,
            alternatives=[*self.alternatives, *other.alternatives],
            unseen={**self.unseen, **other.unseen},
            better=min(self.better, other.better),
            p_value=max(self.p_value, other.p_value),
            ideas=list(dict.fromkeys((*self.ideas, *other.ideas))),
            later=min(self.later, other.later),
        )
