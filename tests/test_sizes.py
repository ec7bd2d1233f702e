"""No folder in which a reader gets lost, no file and no function that is not seen at once."""

from __future__ import annotations

import ast
from collections import Counter
from pathlib import Path

import pytest

import tire_pipeline

pytestmark = pytest.mark.slow
ROOT = Path(tire_pipeline.__file__).parent
TESTS = Path(__file__).parent
MOST_MODULES, MOST_LINES, MOST_LINES_OF_A_FUNCTION = 12, 400, 60

CROWDED = {"concealed/second"}
"""A simulator sealed by its hash."""


def _sources(root: Path) -> list[Path]:
    return [path for path in root.rglob("*.py") if "__pycache__" not in path.parts]


def test_no_folder_is_crowded():
    modules = [path for path in _sources(ROOT) if path.stem not in ("__init__", "__main__")]
    counts = Counter(path.parent.relative_to(ROOT).as_posix() for path in modules)
    assert {folder for folder, count in counts.items() if count > MOST_MODULES} == CROWDED


def test_no_file_is_long():
    lines = {path: len(path.read_text("utf-8").splitlines()) for path in _sources(ROOT) + _sources(TESTS)}
    assert len(lines) > 900
    assert {str(path): count for path, count in lines.items() if count > MOST_LINES} == {}


def _code_lines(function: ast.FunctionDef) -> int:
    """From its first line to its last one, without the docstring."""
    end = function.end_lineno or function.lineno
    first = function.body[0]
    docstring = (first.end_lineno or 0) - first.lineno + 1 if ast.get_docstring(function) else 0
    return end - function.lineno + 1 - docstring


def test_no_function_is_long():
    """Those of ``mismatch`` and of the sealed simulator are another matter."""
    others = ("mismatch/", "concealed/second/")
    found = {
        f"{path}: {each.name}": _code_lines(each)
        for path in _sources(ROOT)
        if not path.relative_to(ROOT).as_posix().startswith(others)
        for each in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(each, ast.FunctionDef)
    }
    assert len(found) > 2000
    assert {name: lines for name, lines in found.items() if lines > MOST_LINES_OF_A_FUNCTION} == {}
