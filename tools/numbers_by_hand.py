"""List the numbers that are set by hand in the explanation engine: python tools/numbers_by_hand.py

Every numeric literal in ``src/tire_pipeline/mismatch`` counts, defaults of functions included, but for

- the files of the effects, which hold equations and priors with their sources,
- 0, 1, 2, 3 and a half, which count, take means and square,
- numbers up to 1e-6, which keep a division from zero,
- factors between units, and what only draws or prints (``report/figures``, ``words``, ``sentences``).
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "src" / "tire_pipeline" / "mismatch"
COUNTING = {0, 1, 2, 3, 0.5}
GUARD = 1e-6
UNITS = {100, 1000, 60, 180, 273.15, 3.6}
DRAWN = ("report/figures.py", "report/words.py", "report/sentences.py", "report/report_page.py")


@dataclass(frozen=True)
class Number:
    """One literal: where it stands, what it is called, and what is said of it."""

    file: str
    line: int
    name: str
    value: str
    why: str


def numbers() -> list[Number]:
    """Return every number by hand, file by file."""
    found: list[Number] = []
    for path in sorted(FOLDER.rglob("*.py")):
        name = path.relative_to(FOLDER).as_posix()
        if not name.startswith("effects/") and name not in DRAWN:
            found += _in_file(path, name)
    return found


def _in_file(path: Path, name: str) -> Iterator[Number]:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    named = set()
    for here, after in zip(tree.body, [*tree.body[1:], None], strict=True):
        if isinstance(here, ast.Assign | ast.AnnAssign) and here.value is not None:
            target = here.targets[0] if isinstance(here, ast.Assign) else here.target
            literals = [n for n in _literals(here.value)]
            named |= {id(n) for n in literals}
            if literals:
                values = ", ".join(_text(n) for n in literals)
                yield Number(name, here.lineno, ast.unparse(target), values, _docstring(after))
    for node in _literals(tree):
        if id(node) not in named:
            yield Number(name, node.lineno, "", _text(node), "")


def _literals(tree: ast.AST) -> Iterator[ast.Constant]:
    exponents = {
        id(n.right) for n in ast.walk(tree) if isinstance(n, ast.BinOp) and isinstance(n.op, ast.Pow)
    }
    for node in ast.walk(tree):
        if not isinstance(node, ast.Constant) or isinstance(node.value, bool) or id(node) in exponents:
            continue
        if isinstance(node.value, int | float):
            size = abs(node.value)
            if size not in COUNTING and size not in UNITS and size > GUARD and size < 1e299:
                yield node


def _text(node: ast.Constant) -> str:
    return f"{node.value:g}"


def _docstring(node: ast.stmt | None) -> str:
    """Return the text under an assignment."""
    if (
        isinstance(node, ast.Expr)
        and isinstance(node.value, ast.Constant)
        and isinstance(node.value.value, str)
    ):
        return " ".join(node.value.value.split())
    return ""


if __name__ == "__main__":
    every = numbers()
    for each in every:
        print(f"{each.file}:{each.line}: {each.name or '-'} = {each.value}  {each.why}")
    print(
        f"{sum(bool(n.name) for n in every)} with a name, {sum(not n.name for n in every)} in an expression"
    )
