"""Writes the code of the derivatives from the equations; :mod:`.gradients` keeps it.

The equations are traced once with symbols in place of numbers. Going backwards through what they did (reverse
differentiation) yields the derivatives with respect to all coefficients for little more than the cost of the
value itself. The result is straight-line code that the interpreter runs on arrays and the compiler on points.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from typing import Any

import numpy as np

from tire_pipeline.channels import FORCE_CHANNELS
from tire_pipeline.magic_formula.equations.equations_52 import evaluate_52
from tire_pipeline.magic_formula.equations.equations_61 import NO_TURN_SLIP, evaluate_61, rolling_load_factor
from tire_pipeline.magic_formula.equations.jit import checksum_with_equations
from tire_pipeline.magic_formula.parameters.coefficients import (
    COEFFICIENT_NAMES,
    EXTENSIONS_6,
    NAMES_BY_FAMILY,
    Coefficients,
)

_UFUNCS = {
    np.add: "+",
    np.subtract: "-",
    np.multiply: "*",
    np.divide: "/",
    np.sin: "sin",
    np.cos: "cos",
    np.arctan: "arctan",
    np.exp: "exp",
    np.sqrt: "sqrt",
    np.power: "power",
    np.minimum: "minimum",
    np.maximum: "maximum",
    np.absolute: "absolute",
}
_known: dict[tuple[Any, ...], Symbol] = {}


class Symbol:
    """One intermediate value: an operation and what it was applied to. Equal ones are the same object."""

    __slots__ = ("arguments", "number", "operation")
    operation: str
    arguments: tuple[Any, ...]
    number: int

    def __new__(cls, operation: str, *arguments: Any) -> Symbol:
        """Return the symbol, made only if there is none like it."""
        key = (operation, *(a.number if isinstance(a, Symbol) else ("c", a) for a in arguments))
        found = _known.get(key)
        if found is None:
            found = super().__new__(cls)
            found.operation, found.arguments, found.number = operation, arguments, len(_known)
            _known[key] = found
        return found

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Symbol:
        """Note a NumPy function that is applied to the symbol."""
        return _make(_UFUNCS[ufunc], *inputs)

    def __array_function__(self, function: Any, types: Any, inputs: Any, options: Any) -> Symbol:
        """Note ``np.where``."""
        if function is not np.where:
            return NotImplemented
        return _make("select", *inputs)

    def __add__(self, other: Any) -> Symbol:
        return _make("+", self, other)

    def __radd__(self, other: Any) -> Symbol:
        return _make("+", other, self)

    def __sub__(self, other: Any) -> Symbol:
        return _make("-", self, other)

    def __rsub__(self, other: Any) -> Symbol:
        return _make("-", other, self)

    def __mul__(self, other: Any) -> Symbol:
        return _make("*", self, other)

    def __rmul__(self, other: Any) -> Symbol:
        return _make("*", other, self)

    def __truediv__(self, other: Any) -> Symbol:
        return _make("/", self, other)

    def __rtruediv__(self, other: Any) -> Symbol:
        return _make("/", other, self)

    def __neg__(self) -> Symbol:
        return _make("-", 0.0, self)

    def __lt__(self, other: Any) -> Symbol:
        return Symbol("<", self, other)

    def __gt__(self, other: Any) -> Symbol:
        return Symbol(">", self, other)

    def __eq__(self, other: Any) -> Symbol:  # type: ignore[override]
        return Symbol("==", self, other)

    def __and__(self, other: Any) -> Symbol:
        return Symbol("&", self, other)

    def __hash__(self) -> int:
        return self.number


def _is(x: Any, value: float) -> bool:
    return not isinstance(x, Symbol) and x == value


def _make(operation: str, *arguments: Any) -> Any:
    """Return a symbol, or what is simpler and the same."""
    a, b = (*arguments, None)[:2]
    if operation == "+" and (_is(a, 0.0) or _is(b, 0.0)):
        return b if _is(a, 0.0) else a
    if operation == "-" and _is(b, 0.0):
        return a
    if operation == "*" and (_is(a, 0.0) or _is(b, 0.0)):
        return 0.0
    if operation == "*" and (_is(a, 1.0) or _is(b, 1.0)):
        return b if _is(a, 1.0) else a
    if operation == "/" and (_is(a, 0.0) or _is(b, 1.0)):
        return a
    if operation == "select" and a is not None and arguments[1] is arguments[2]:
        return arguments[1]
    if not any(isinstance(x, Symbol) for x in arguments):
        return _constant(operation, arguments)
    return Symbol(operation, *arguments)


def _constant(operation: str, arguments: tuple[Any, ...]) -> float:
    for ufunc, name in _UFUNCS.items():
        if name == operation:
            return float(ufunc(*arguments))
    return float(np.where(*arguments))


def _pulled_back(y: Symbol, bar: Any) -> Iterable[tuple[Any, Any]]:
    """Yield, for each argument of y, the argument and its share of y's derivative ``bar``."""
    name, arguments = y.operation, y.arguments
    a, b = (*arguments, None)[:2]
    if name == "+":
        return [(a, bar), (b, bar)]
    if name == "-":
        return [(a, bar), (b, _make("-", 0.0, bar))]
    if name == "*":
        return [(a, _make("*", bar, b)), (b, _make("*", bar, a))]
    if name == "/":
        share = _make("/", bar, b)
        return [(a, share), (b, _make("-", 0.0, _make("*", share, y)))]
    if name == "sin":
        return [(a, _make("*", bar, _make("cos", a)))]
    if name == "cos":
        return [(a, _make("-", 0.0, _make("*", bar, _make("sin", a))))]
    if name == "arctan":
        return [(a, _make("/", bar, _make("+", 1.0, _make("*", a, a))))]
    if name == "exp":
        return [(a, _make("*", bar, y))]
    if name == "sqrt":
        return [(a, _make("select", y == 0.0, 0.0, _make("/", _make("*", 0.5, bar), y)))]
    if name == "power":
        log = Symbol("log", a)
        return [
            (a, _make("*", bar, _make("*", b, _make("/", y, a)))),
            (b, _make("*", bar, _make("*", y, log))),
        ]
    if name in ("minimum", "maximum"):
        first = Symbol("<", a, b) if name == "minimum" else Symbol(">", a, b)
        return [(a, _make("select", first, bar, 0.0)), (b, _make("select", first, 0.0, bar))]
    if name == "absolute":
        return [(a, _make("select", Symbol("<", a, 0.0), _make("-", 0.0, bar), bar))]
    if name == "select":
        condition, yes, no = arguments
        return [
            (yes, _make("select", condition, bar, 0.0)),
            (no, _make("select", condition, 0.0, bar)),
        ]
    return []


def gradient(output: Symbol) -> dict[str, Any]:
    """Return the derivative of an output with respect to each coefficient that it depends on."""
    order = needed([output])
    depends: set[int] = set()
    for y in order:
        is_coefficient = y.operation == "coefficient"
        if is_coefficient or any(isinstance(a, Symbol) and a.number in depends for a in y.arguments):
            depends.add(y.number)
    bars: dict[int, Any] = {output.number: 1.0}
    found: dict[str, Any] = {}
    for y in sorted(order, key=lambda each: -each.number):
        bar = bars.get(y.number)
        if bar is None or y.number not in depends:
            continue
        if y.operation == "coefficient":
            found[y.arguments[0]] = bar
            continue
        for argument, share in _pulled_back(y, bar):
            if isinstance(argument, Symbol) and argument.number in depends:
                bars[argument.number] = _make("+", bars.get(argument.number, 0.0), share)
    return {name: found[name] for name in COEFFICIENT_NAMES if name in found and not _is(found[name], 0)}


def needed(outputs: Iterable[Any]) -> list[Symbol]:
    """Return the symbols that the outputs need, each after what it needs."""
    seen: dict[int, Symbol] = {}
    stack = [y for y in outputs if isinstance(y, Symbol)]
    while stack:
        y = stack.pop()
        if y.number not in seen:
            seen[y.number] = y
            stack += [a for a in y.arguments if isinstance(a, Symbol)]
    return sorted(seen.values(), key=lambda y: y.number)


def traced(family: int) -> tuple[Any, ...]:
    """Return the symbols of the five forces and moments; they do not go with those of another call."""
    _known.clear()
    used = {*NAMES_BY_FAMILY[family], *(EXTENSIONS_6 if family == 6 else ())}
    p = Coefficients(*(Symbol("coefficient", n) if n in used else 0.0 for n in COEFFICIENT_NAMES))
    names = ("alpha", "kappa", "gamma", "fz", "speed", "dpi")
    alpha, kappa, gamma, fz, speed, dpi = (Symbol("input", name) for name in names)
    with np.errstate(all="ignore"):
        if family == 5:
            return evaluate_52(p, alpha, kappa, gamma, fz, speed)[:5]
        by_load = rolling_load_factor(p, fz, dpi)
        return evaluate_61(p, alpha, kappa, gamma, fz, speed, dpi, by_load, NO_TURN_SLIP)[:5]


def _text(y: Any, names: dict[int, str]) -> str:
    return names[y.number] if isinstance(y, Symbol) else repr(float(y))


def function_source(name: str, output: Symbol) -> tuple[str, list[str]]:
    """Return the source of a function that returns an output's gradient, and the coefficients it is over."""
    by_name = gradient(output)
    names: dict[int, str] = {}
    lines: list[str] = []
    for y in needed(by_name.values()):
        if y.operation == "input":
            names[y.number] = y.arguments[0]
            continue
        if y.operation == "coefficient":
            names[y.number] = f"p.{y.arguments[0]}"
            continue
        arguments = [_text(a, names) for a in y.arguments]
        names[y.number] = f"t{len(lines)}"
        infix = not y.operation[0].isalpha()
        value = f" {y.operation} ".join(arguments) if infix else f"{y.operation}({', '.join(arguments)})"
        if infix and arguments[0] == "0.0" and y.operation == "-":
            value = f"-{arguments[1]}"
        lines.append(f"    t{len(lines)} = {value}")
    results = ",\n".join(f"        {_text(value, names)}" for value in by_name.values())
    head = [
        "@jitable",
        f"def {name}(p, alpha, kappa, gamma, fz, speed, dpi):",
        f'    """Return the gradient of {name}."""',
    ]
    return "\n".join([*head, *lines, f"    return (\n{results},\n    )\n"]), list(by_name)


def kernel_source(name: str, count: int) -> str:
    """Return the source of the loop over points that stores the columns asked for."""
    inputs = ("alpha", "kappa", "gamma", "fz", "speed", "dpi")
    takes = "\n".join(f"            w[{k} * BLOCK + i] = {x}[start + i]" for k, x in enumerate(inputs))
    point = ", ".join(f"w[{k} * BLOCK + i]" for k in range(len(inputs)))
    stores = "\n".join(f"            w[{k + len(inputs)} * BLOCK + i] = g[{k}]" for k in range(count))
    return f'''
def loop_{name}(c, alpha, kappa, gamma, fz, speed, dpi, rows, out):
    """Store the gradient of {name}; ``rows`` has the row of ``out`` for each coefficient, or -1."""
    p = unpack(c)
    w = np.empty({count + len(inputs)} * BLOCK)
    for start in range(0, out.shape[1], BLOCK):
        m = min(BLOCK, out.shape[1] - start)
        for i in range(m):
{takes}
        for i in range(m):
            g = {name}(p, {point})
{stores}
        for k in range({count}):
            row = rows[k]
            if row >= 0:
                for i in range(m):
                    out[row, start + i] = w[(k + {len(inputs)}) * BLOCK + i]
'''


def module_source(family: int) -> str:
    """Return the source of a gradients module."""
    outputs = traced(family)
    parts, lists = [], []
    for name, output in zip(FORCE_CHANNELS, outputs, strict=True):
        source, over = function_source(name, output)
        parts.append(f"{source}\n{kernel_source(name, len(over))}\n")
        lists.append(f'    "{name}": (\n' + "".join(f'        "{n}",\n' for n in over) + "    ),\n")
    head = _HEAD.format(family=family)
    return head + "OVER = {\n" + "".join(lists) + "}\n\n\n" + "\n".join(parts).rstrip() + "\n"


@lru_cache(maxsize=1)
def source_stamp() -> str:
    """Return a mark of the sources that the gradients are made from and compiled with."""
    return checksum_with_equations(__name__)


_HEAD = '''"""Gradients over coefficients, family {family}, written by derive.py."""

import numpy as np

from tire_pipeline.magic_formula.equations.jit import jitable
from tire_pipeline.magic_formula.equations.ops import (
    absolute, arctan, cos, exp, log, maximum, minimum, power, select, sin, sqrt,
)
from tire_pipeline.magic_formula.compiled.unpacking import unpack

BLOCK = 64
'''
