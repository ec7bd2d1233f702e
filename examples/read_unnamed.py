"""Evaluate an unnamed equation: python read_unnamed.py tire.tir.sidecar.json table_of_symbols.csv."""

import csv
import json
import math
import re
import sys
from itertools import accumulate, chain, pairwise
from pathlib import Path
from statistics import median

_TOKEN = re.compile(r"\d{1,99}(?:\.\d*)?(?:[eE](?:-\d|[+-]?)\d\d?)?|(?![iInN])[A-Za-z_]\w*|[-+*/^(),]", re.A)
_PAIRS = {"+": float.__add__, "-": float.__sub__, "*": float.__mul__, "/": float.__truediv__}
_PLAIN = {"abs": abs, "sqrt": math.sqrt, "sin": math.sin, "cos": math.cos, "exp": math.exp, "tanh": math.tanh}
_OF, _MEMORIES = ("fx", "fy", "mz"), ("lag", "lagway", "play", "highest")


def _value(text, table, clock):
    tokens = [*_TOKEN.findall(text), ""]
    if "".join(tokens) != re.sub(r"\s", "", text) or len(text) > 2000:
        raise ValueError(f"not of the grammar: {text[:60]}")

    def taken(*signs):
        return tokens.pop(0) if tokens[0] in signs else ""

    def joined(signs, lower):
        left = lower()
        while sign := taken(*signs):
            left = [_PAIRS[sign](a, b) for a, b in zip(left, lower(), strict=True)]
        return left

    def power():
        factor, x = (-1.0 if taken("-") else 1.0), part()
        exponent = ((-1.0 if taken("-") else 1.0) * float(tokens.pop(0))) if taken("^") else 1.0
        return [factor * v**exponent for v in x]

    def part():
        word = tokens.pop(0)
        if word[:1].isdigit() or (word != "(" and not taken("(")):
            return [float(word)] * len(clock) if word[:1].isdigit() else table[word]
        x = joined("+-", lambda: joined("*/", power))
        number = float(tokens.pop(0)) if word in _MEMORIES[:3] and taken(",") else 0.0
        x = [*past(word, x, number)] if word in _MEMORIES else x if word == "(" else [*map(_PLAIN[word], x)]
        return x if taken(")") and (number > 0) == (word in _MEMORIES[:3]) else sys.exit(f"wrong in {word}(")

    def past(name, x, number):
        y = x[0]
        for v, (step, way, start) in zip(x, clock, strict=True):
            if name in ("lag", "lagway"):
                y = v if start else y - math.expm1(-(step if name == "lag" else way) / number) * (v - y)
            else:
                y = max(y, v) if name == "highest" else min(max(v if start else y, v - number), v + number)
            yield y

    out = joined("+-", lambda: joined("*/", power))
    return out if tokens == [""] else sys.exit(f"{tokens[0]} was not expected: {text[:60]}")


def _added(entry, table):
    known = re.match(r"unnamed physics (4|[123](?!.*\bway\b)) ", "{format} {equation}".format(**entry))
    none = [math.nan] * (size := len(next(iter(table.values()))) if known else sys.exit("no format"))
    usual, v = median(gaps := [b - a for a, b in pairwise(table.get("time", none))]), table.get("speed", none)
    steps = [0.0, *(d if 0.0 < d <= 3.5 * usual else 0.0 for d in gaps)]
    ways = [d * abs(a) for d, a in zip(steps, v, strict=True)]
    rolled = accumulate(0.5 * d * (abs(a) + abs(b)) for d, (a, b) in zip(gaps, pairwise(v), strict=True))
    table = {n: [float(v)] * size for n, v in entry["nominal"].items()} | {"way": [0.0, *rolled]} | table
    clock = [(d, w, not d) for d, w in zip(steps, ways, strict=True)] if "time" in table else [()] * size
    out = {o: _value(entry["equation"][o], table, clock) for o in sorted(entry["equation"], key=_OF.index)}
    for symbol, (low, high) in entry["range"].items():
        width = max(entry["fade"][symbol] * (high - low), 1e-12)
        fade = [max(1.0 - max(low - x, x - high, 0.0) / width, 0.0) for x in _value(symbol, table, clock)]
        out = {o: [f * w for f, w in zip(force, fade, strict=True)] for o, force in out.items()}
    return out if all(map(math.isfinite, chain(*out.values()))) else sys.exit("it is not finite")


if __name__ == "__main__":
    entry = json.loads(Path(sys.argv[1]).read_text("utf-8"))["effects"]["unnamed"]
    rows = list(csv.DictReader(Path(sys.argv[2]).read_text("utf-8").splitlines()))
    found = _added(entry, {name: [float(row[name]) for row in rows] for name in rows[0]})
    print(",".join(found), *(",".join(map(repr, row)) for row in zip(*found.values(), strict=True)), sep="\n")
