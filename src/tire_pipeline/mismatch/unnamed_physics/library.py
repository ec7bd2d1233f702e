"""Terms that an equation may be made of: ways to act, times factors of what it may depend on.

A tire is nearly its own mirror image across the wheel plane: slip angle, camber and side force change their
sign. What multiplies a force is even there, what turns a slip angle or adds a side force is odd. A term
that breaks this costs more (conicity and ply steer do).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import cache, cached_property, partial
from typing import Literal

from tire_pipeline.channels import TANGENTIAL_FORCES
from tire_pipeline.mismatch.unnamed_physics.language.grammar import number, parse
from tire_pipeline.mismatch.unnamed_physics.language.symbols import CHANNEL

LAGS = (0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0)
"""s; between them the search goes on from the best."""
WAYS = (0.1, 0.3, 1.0, 3.0)
"""m; the same."""
PLAYS = {"s": (0.0015, 0.004, 0.01), "fy/(F0*L)": (0.05, 0.15, 0.4)}
"""Half widths of a play in the slip angle (its tangent) and in the lateral force over the load."""
EACH_NODE = math.log(2.0)
"""Log evidence that a node costs: a shorter equation comes first. One bit."""
BREAKS_MIRROR = 3.0
"""Log evidence that a term costs which breaks the mirror symmetry."""
Alone = Literal["never", "too", "only"]


@dataclass(frozen=True)
class Way:
    """How a term reaches the forces.

    Parameters
    ----------
    name : str
    acts_on : str
        In words: friction, stiffness, slip, load, force.
    base : dict of str to str
        Output -> what the factors multiply there.
    odd : bool
        Whether the factors have to be odd in the mirror.
    drivers : frozenset of str
        What it depends on without any factor, beside the force that it is a part of.
    alone : {"never", "too", "only"}
        Whether it is a term without any factor. For a force this is an effect of the catalogue.
    """

    name: str
    acts_on: str
    base: dict[str, str] = field(hash=False)
    odd: bool
    drivers: frozenset[str] = frozenset()
    alone: Alone = "never"


_BY_LOAD = frozenset({"normal_load"})
WAYS_TO_ACT = (
    Way("force", "both forces, by a factor", {"fx": "fx", "fy": "fy"}, False),
    Way("fy", "the side force, by a factor", {"fy": "fy"}, False),
    Way("fx", "the longitudinal force, by a factor", {"fx": "fx"}, False),
    Way("friction", "friction", {"fx": "(fx - k*fx_slip)", "fy": "(fy - s*fy_slip)"}, False),
    Way("stiffness", "slip stiffness", {"fx": "k*fx_slip", "fy": "s*fy_slip"}, False),
    Way("load", "the load", {"fx": "fx_load", "fy": "fy_load"}, False),
    Way("slip angle", "the slip angle", {"fy": "fy_slip"}, True),
    Way("slip ratio", "the slip ratio", {"fx": "fx_slip"}, False),
    Way("added fy", "an added side force", {"fy": "F0*L"}, True, _BY_LOAD),
    Way("added fx", "an added longitudinal force", {"fx": "F0*L"}, False, _BY_LOAD),
    Way("fy into fx", "the side force, turned into the longitudinal one", {"fx": "fy"}, True),
    Way("fx into fy", "the longitudinal force, turned into the side force", {"fy": "fx"}, True),
    Way("late fy", "the side force, late", {"fy": "F0"}, True),
    Way("late fx", "the longitudinal force, late", {"fx": "F0"}, False),
    Way("mz", "the aligning moment, by a factor", {"mz": "mz"}, False, alone="too"),
    Way("trail", "the side force, with an arm", {"mz": "R0*fy"}, False, alone="too"),
    Way(
        "arm", "the longitudinal force, with an arm", {"mz": "R0*fx"}, True, frozenset({"slip_ratio"}), "too"
    ),
    Way("added mz", "an added aligning moment", {"mz": "F0*R0*L"}, True, _BY_LOAD, "too"),
    Way("offset mz", "a constant aligning moment", {"mz": "F0*R0"}, True, alone="only"),
)
WAY = {way.name: way for way in WAYS_TO_ACT}


@dataclass(frozen=True)
class Factor:
    """One factor of a term.

    Parameters
    ----------
    text : str
        In the grammar; ``{}`` where a number goes that is searched for.
    drivers : frozenset of str
        Channels, ``memory of <channel>``, ``path`` or ``time``.
    odd : bool
        In the mirror.
    value : float
        The number.
    kind : str
        ``now``, ``memory`` or ``path``.
    most : float
        The largest number that is looked for. A lag that is longer than a recording only seems to be one.
    """

    text: str
    drivers: frozenset[str]
    odd: bool = False
    value: float = 0.0
    kind: str = "now"
    most: float = math.inf

    @property
    def written(self) -> str:
        """The text with its number."""
        return self.text.replace("{}", number(self.value))

    def at(self, value: float) -> Factor:
        """Return the same with another number, ``most`` at the most."""
        return replace(self, value=min(value, self.most))


@cache
def _nodes(text: str) -> int:
    return parse(text.replace("{}", "1")).size


@dataclass(frozen=True)
class Term:
    """A way to act times some factors, with a coefficient that is fitted."""

    way: str
    factors: tuple[Factor, ...]

    @cached_property
    def drivers(self) -> frozenset[str]:
        """What it depends on beside the force that it is a part of."""
        return WAY[self.way].drivers.union(*(f.drivers for f in self.factors))

    def without(self, factors: Iterable[Factor]) -> Term:
        """Return the same without some factors."""
        left_out = set(factors)
        return Term(self.way, tuple(f for f in self.factors if f not in left_out))

    def text(self, output: str) -> str:
        """Its equation for one output, without coefficient; empty where it does nothing."""
        base = WAY[self.way].base.get(output)
        return "" if base is None else "*".join([base, *(f"({f.written})" for f in self.factors)])

    @cached_property
    def cost(self) -> float:
        """Minus log prior, drivers and library aside: its length, and whether it breaks the mirror."""
        nodes = sum(_nodes(f.text) for f in self.factors)
        return EACH_NODE * nodes + BREAKS_MIRROR * self.breaks_mirror

    @property
    def odd(self) -> bool:
        """Whether the product of its factors is odd in the mirror."""
        return sum(f.odd for f in self.factors) % 2 == 1

    @property
    def breaks_mirror(self) -> bool:
        """Whether a tire that is its own mirror image could not have it."""
        return self.odd != WAY[self.way].odd and not any(f.kind == "path" for f in self.factors)


def _one(
    text: str,
    *drivers: str,
    odd: bool = False,
    value: float = 0.0,
    kind: str = "now",
    most: float = math.inf,
) -> Factor:
    return Factor(text, frozenset(drivers), odd, value, kind, most)


_NOW = (
    _one("abs(s)", "slip_angle"),
    _one("s^2", "slip_angle"),
    _one("s", "slip_angle", odd=True),
    _one("k", "slip_ratio"),
    _one("abs(k)", "slip_ratio"),
    _one("k^2", "slip_ratio"),
    _one("g", "camber", odd=True),
    _one("abs(g)", "camber"),
    _one("g^2", "camber"),
    _one("L", "normal_load"),
    _one("L^2", "normal_load"),
    _one("1/L", "normal_load"),
    _one("L - 1", "normal_load"),
    _one("v", "speed"),
    _one("v^2", "speed"),
    _one("1/v", "speed"),
    _one("v - 1", "speed"),
    _one("p", "pressure"),
    _one("p - 1", "pressure"),
    _one("1/p", "pressure"),
    _one("h", "tread_temperature"),
    _one("h^2", "tread_temperature"),
    _one("fy/F0", odd=True),
    _one("fx/F0"),
)
_OF_MOMENT = {"fy/F0": frozenset({"slip_angle"}), "fx/F0": frozenset({"slip_ratio"})}
"""What a force stands for in the aligning moment, which it is no factor of by itself."""


def now_factors(moves: frozenset[str]) -> list[Factor]:
    """Factors of what the channels are at the same moment."""
    return [f for f in _NOW if f.drivers <= moves]


def time_factors(first: float, last: float) -> list[Factor]:
    """Factors of time, over the span of the recording."""
    return [_one(f"(t - {number(first)})/{number(last - first)}", "time")]


def memory_factors(moves: frozenset[str]) -> Iterator[Factor]:
    """Factors of what channels and forces were; a memory of the way rolled where that is known."""
    if "time" not in moves:
        return
    of = [
        ("s", ("slip_angle",), True),
        ("abs(s)", ("slip_angle",), False),
        ("abs(k)", ("slip_ratio",), False),
        ("k", ("slip_ratio",), False),
        ("L", ("normal_load",), False),
        ("g", ("camber",), True),
        ("fy/F0", ("fy",), True),
        ("fx/F0", ("fx",), False),
        ("v*(abs(s*fy) + abs(k*fx))/F0", ("slip_angle", "slip_ratio", "speed"), False),
    ]
    always = set(TANGENTIAL_FORCES)
    for text, channels, odd in of:
        live = [c for c in channels if c in moves | always]
        if not live or (len(channels) == 1 and live != list(channels)):
            continue
        drivers = [c if c == "speed" else f"memory of {c}" for c in live]
        lagged = partial(_one, odd=odd, kind="memory", most=LAGS[-1])
        for value in LAGS:
            yield lagged(f"lag({text}, {{}}) - {text}", *drivers, value=value)
            if value in LAGS[2:] and text not in CHANNEL:  # a slow one drives by itself, too
                yield lagged(f"lag({text}, {{}})", *drivers, value=value)
        if "way" in moves and ("speed" in moves or text in ("s", "k", "L", "g")):
            for value in WAYS if text in CHANNEL else ():
                yield lagged(f"lagway({text}, {{}}) - {text}", *drivers, value=value, most=WAYS[-1])
        if text.startswith("abs("):
            yield _one(f"highest({text})", *drivers, odd=odd, kind="memory")
    for text, widths in PLAYS.items():
        name = "slip_angle" if text == "s" else "fy"
        if name in moves | always:
            for value in widths:
                yield _one(
                    f"play({text}, {{}}) - {text}", f"memory of {name}", odd=True, value=value, kind="memory"
                )


def path_factors(radius: float) -> tuple[Factor, Factor]:
    """Sine and cosine of the angle of something that rolls along, of a radius in m."""
    return (
        _one("sin(way/{})", "path", value=radius, kind="path"),
        _one("cos(way/{})", "path", value=radius, kind="path"),
    )


def single_terms(moves: frozenset[str], outputs: tuple[str, ...], span: tuple[float, float]) -> list[Term]:
    """Terms of one factor, for the screen."""
    now = now_factors(moves) + (time_factors(*span) if "time" in moves else [])
    memory = list(memory_factors(moves))
    return [t for way in WAYS_TO_ACT for t in _of_way(way, now, memory, outputs)]


def _of_way(way: Way, now: list[Factor], memory: list[Factor], outputs: tuple[str, ...]) -> Iterator[Term]:
    acts = [o for o in way.base if o in outputs]
    if not acts or (way.name == "force" and len(outputs) == 1):
        return
    late = way.name.startswith("late")
    if way.alone != "never":
        yield Term(way.name, ())
    if way.alone == "only":
        return
    if "mz" in way.base:
        now = [replace(f, drivers=_OF_MOMENT.get(f.text, f.drivers)) for f in now]
    for factor in memory if late else [*now, *memory]:
        own_force = "fy" if "fy" in way.base else "fx"
        if late and f"memory of {own_force}" not in factor.drivers:
            continue
        if late and factor.text.startswith("lag(") and " - " not in factor.text:
            continue
        if factor.kind == "memory" and factor.odd != way.odd:
            continue
        if not factor.drivers and way.name not in ("slip angle", "slip ratio"):
            continue
        if (way.name, factor.text) in (("slip angle", "fx/F0"), ("trail", "fx/F0")):
            continue  # no slip angle comes from fx, and the other arm says the same
        yield Term(way.name, (factor,))


def products(terms: list[Term], factors: list[Factor]) -> list[Term]:
    """Return terms times one more factor of another driver."""
    out = []
    for term in terms:
        for factor in factors:
            own = frozenset[str]().union(*(f.drivers for f in term.factors))
            if not factor.drivers or factor.drivers & own:
                continue
            out.append(Term(term.way, tuple(sorted((*term.factors, factor), key=lambda f: f.text))))
    return out
