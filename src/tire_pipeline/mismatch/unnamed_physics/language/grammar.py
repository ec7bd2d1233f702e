"""Equations as text: a small grammar, read without running any code.

::

    sum     = product (("+" | "-") product)*
    product = power (("*" | "/") power)*
    power   = ["-"] part ["^" number]
    part    = number | symbol | function "(" sum ["," number] ")" | "(" sum ")"

Functions of one argument: ``abs sqrt sin cos exp tanh highest`` (``highest`` is the largest value so far).
Functions of an argument and a positive number: ``lag(x, seconds)`` and ``lagway(x, metres)`` follow ``x``
with a lag of first order, at rest at the first sample of each piece; ``play(x, width)`` follows it through a
gap of ``width`` to either side. A power of something negative has a whole exponent.
"""

from __future__ import annotations

import math
import re
import reprlib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numba import njit

from tire_pipeline.errors import DomainError
from tire_pipeline.mismatch.effects.shared import play

Array = np.ndarray
FUNCTIONS = ("abs", "sqrt", "sin", "cos", "exp", "tanh", "highest")
MEMORIES = ("lag", "lagway", "play")
LONGEST = 2000
"""Characters of an equation, and of the words that a sidecar has beside it."""
_TOKEN = re.compile(r"\s*(?:(\d+(?:\.\d*)?(?:[eE][+-]?\d{1,3})?)|([A-Za-z_][A-Za-z_0-9]{0,31})|([-+*/^(),]))")


class EquationError(DomainError):
    """An equation that is not of the grammar, or that has no finite value."""


@dataclass(frozen=True)
class Node:
    """A number, a symbol, or an operation on others.

    Parameters
    ----------
    kind : str
        ``number``, ``symbol``, an operator ``+ - * / ^ negative``, or a function.
    value : float
        The number, the exponent, or the second argument of a function.
    name : str
        Of the symbol.
    parts : tuple of Node
    """

    kind: str
    value: float = 0.0
    name: str = ""
    parts: tuple[Node, ...] = ()

    @property
    def size(self) -> int:
        """Number of nodes."""
        return 1 + sum(part.size for part in self.parts)

    @property
    def symbols(self) -> frozenset[str]:
        """Names of the symbols in it."""
        own = frozenset([self.name]) if self.kind == "symbol" else frozenset()
        return own.union(*(part.symbols for part in self.parts))


@lru_cache
def parse(text: str) -> Node:
    """Read an equation.

    Raises
    ------
    EquationError
        It is not of the grammar; the message says where.
    """
    if not isinstance(text, str) or len(text) > LONGEST:
        raise EquationError(
            f"an equation is text of at most {LONGEST} characters", todo="shorten or leave out the equation"
        )
    reader = _Reader(text)
    try:
        return reader.equation()
    except RecursionError as error:
        raise reader.error("too many brackets") from error


class _Reader:
    """Recursive descent over the tokens of one equation."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.tokens: list[tuple[str, str]] = []
        at = 0
        while at < len(text.rstrip()):
            found = _TOKEN.match(text, at)
            if found is None:
                raise self.error(f"{text[at]!r} is not of the grammar")
            number, name, sign = found.groups()
            self.tokens.append(("number", number) if number else ("name", name) if name else ("sign", sign))
            at = found.end()
        self.at = 0

    def equation(self) -> Node:
        tree = self._sum()
        if self.at < len(self.tokens):
            raise self.error(f"{self.tokens[self.at][1]!r} was not expected")
        return tree

    def error(self, what: str) -> EquationError:
        return EquationError(
            f"{what} in the equation {reprlib.repr(self.text)}",
            todo="write it in the grammar of unnamed physics",
        )

    def _next(self, *signs: str) -> str:
        """Take the next sign if it is one of these; else nothing."""
        if self.at < len(self.tokens):
            kind, text = self.tokens[self.at]
            if kind == "sign" and text in signs:
                self.at += 1
                return text
        return ""

    def _need(self, sign: str) -> None:
        if not self._next(sign):
            raise self.error(f"{sign!r} is missing")

    def _sum(self) -> Node:
        left = self._product()
        while sign := self._next("+", "-"):
            left = Node(sign, parts=(left, self._product()))
        return left

    def _product(self) -> Node:
        left = self._power()
        while sign := self._next("*", "/"):
            left = Node(sign, parts=(left, self._power()))
        return left

    def _power(self) -> Node:
        negative = bool(self._next("-"))
        part = self._part()
        if self._next("^"):
            minus = -1.0 if self._next("-") else 1.0
            part = Node("^", value=minus * self._number(), parts=(part,))
        return Node("negative", parts=(part,)) if negative else part

    def _number(self) -> float:
        if self.at >= len(self.tokens) or self.tokens[self.at][0] != "number":
            raise self.error("a number is missing")
        value = float(self.tokens[self.at][1])
        self.at += 1
        if not math.isfinite(value):
            raise self.error("a number is too large")
        return value

    def _part(self) -> Node:
        if self.at >= len(self.tokens):
            raise self.error("something is missing at the end")
        kind, text = self.tokens[self.at]
        if kind == "number":
            return Node("number", value=self._number())
        self.at += 1
        if kind == "name" and text in FUNCTIONS + MEMORIES:
            return self._function(text)
        if kind == "name":
            return Node("symbol", name=text)
        if text != "(":
            raise self.error(f"{text!r} was not expected")
        inside = self._sum()
        self._need(")")
        return inside

    def _function(self, name: str) -> Node:
        self._need("(")
        inside, value = self._sum(), 0.0
        if name in MEMORIES:
            self._need(",")
            value = self._number()
            if not value > 0.0:
                raise self.error(f"the number in {name} has to be positive")
        self._need(")")
        return Node(name, value=value, parts=(inside,))


@dataclass(frozen=True)
class SymbolTable:
    """What an equation is evaluated on.

    Parameters
    ----------
    columns : mapping of str to ndarray, shape (n,)
        Symbol -> values.
    step : ndarray, shape (n,)
        Time step that ends at each sample, s.
    way : ndarray, shape (n,)
        Way rolled within that step, m.
    start : ndarray of bool, shape (n,)
        First samples of uninterrupted pieces.
    """

    columns: Mapping[str, Array]
    step: Array
    way: Array
    start: Array

    @property
    def size(self) -> int:
        """Number of samples."""
        return int(self.start.size)


def evaluate(tree: Node, table: SymbolTable) -> Array:
    """Return the value at each sample, shape (n,).

    Raises
    ------
    EquationError
        A symbol is unknown here, or the value is not finite.
    """
    unknown = sorted(tree.symbols - set(table.columns))
    if unknown:
        raise EquationError(f"the equation needs {', '.join(unknown)}", todo="add what it needs")
    with np.errstate(all="ignore"):
        out = np.broadcast_to(_value(tree, table), (table.size,)).astype(float)
    if not np.isfinite(out).all():
        raise EquationError(
            "the equation has no finite value at some samples", todo="leave it out, or those samples"
        )
    return out


def _value(node: Node, table: SymbolTable) -> Array:
    if node.kind == "number":
        return np.array(node.value)
    if node.kind == "symbol":
        return table.columns[node.name]
    x = _value(node.parts[0], table)
    if len(node.parts) == 2:
        y = _value(node.parts[1], table)
        return (
            x + y if node.kind == "+" else x - y if node.kind == "-" else x * y if node.kind == "*" else x / y
        )
    if node.kind == "negative":
        return -x
    if node.kind == "^":
        return np.power(x, node.value)
    if node.kind == "highest":
        return np.maximum.accumulate(np.broadcast_to(x, table.start.shape))
    if node.kind in MEMORIES:
        x = np.ascontiguousarray(np.broadcast_to(x, table.start.shape), float)
        if node.kind == "play":
            return play(x, node.value, table.start)
        over = table.step if node.kind == "lag" else table.way
        return lag(x, -np.expm1(-over / node.value), table.start)
    functions = {"abs": np.abs, "sqrt": np.sqrt, "sin": np.sin, "cos": np.cos, "exp": np.exp, "tanh": np.tanh}
    return functions[node.kind](x)


def number(value: float) -> str:
    """Return a number as the grammar writes it, exact to 1e-11 of itself, in brackets if negative."""
    text = f"{abs(value):.12g}"
    return f"(-{text})" if value < 0.0 and math.isfinite(value) else text


@njit(cache=True)
def lag(x: Array, gain: Array, start: Array) -> Array:
    """Follow ``x`` with a lag: ``y += gain (x - y)``, and ``y = x`` where a piece starts.

    Parameters
    ----------
    x, gain : ndarray, shape (n,)
        ``gain`` is ``1 - exp(-step / lag)``.
    start : ndarray of bool, shape (n,)
    """
    out = np.empty_like(x)
    y = 0.0
    for i in range(x.size):
        y = x[i] if start[i] else y + gain[i] * (x[i] - y)
        out[i] = y
    return out
